#include "gpu/swapchain.h"

#include <algorithm>
#include <utility>

namespace weft::gpu {
namespace {

// Timeout of acquire. Some systems give no image while a window is hidden, and the caller must keep handling events.
constexpr std::uint64_t patience = 100'000'000;  // ns
// After so many resizes without a reacquired image, recreate() waits for the queue instead of keeping more old chains.
constexpr std::size_t most_retired = 4;

// A function of the instance that made the surface. volk holds those of the last instance made.
template <class Function>
Function surface_function(const Device& device, const char* name) {
    return reinterpret_cast<Function>(device.instance().functions()(device.instance().handle(), name));
}

Result<VkSurfaceCapabilitiesKHR> capabilities(const Device& device, VkSurfaceKHR surface, bool& lost) {
    const auto get = surface_function<PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR>(
        device, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    VkSurfaceCapabilitiesKHR can{};
    const VkResult result = get(device.physical(), surface, &can);
    lost = result == VK_ERROR_SURFACE_LOST_KHR;
    if (result != VK_SUCCESS) return device.error("to look at a window's surface", result);
    return can;
}

template <class Value, class Function>
std::vector<Value> list_of(const Device& device, VkSurfaceKHR surface, Function get) {
    std::uint32_t count = 0;
    get(device.physical(), surface, &count, nullptr);
    std::vector<Value> list(count);
    if (get(device.physical(), surface, &count, list.data()) < 0) count = 0;
    list.resize(count);
    return list;
}

bool is_srgb(VkFormat format) {
    return format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_R8G8B8A8_SRGB;
}

VkExtent2D fitting(const VkSurfaceCapabilitiesKHR& can, VkExtent2D size) {
    if (can.currentExtent.width != ~0u) return can.currentExtent;
    return {std::clamp(size.width, can.minImageExtent.width, can.maxImageExtent.width),
            std::clamp(size.height, can.minImageExtent.height, can.maxImageExtent.height)};
}

bool same(VkExtent2D a, VkExtent2D b) {
    return a.width == b.width && a.height == b.height;
}

}  // namespace

Result<Swapchain> Swapchain::create(Device& device, VkSurfaceKHR surface, const SwapchainOptions& options) {
    Swapchain self;
    self.device_ = &device;
    self.surface_ = surface;
    if (auto chosen = self.choose(options); !chosen) return chosen.errors();
    for (Slot& slot : self.slots_)
        if (auto made = self.make_semaphore(slot.acquired); !made) return made.errors();
    return self;
}

Swapchain::~Swapchain() {
    if (!device_) return;
    wait_for_queue();
    retire();
    for (Chain& chain : retired_) destroy(chain);
    for (Slot& slot : slots_)
        if (slot.acquired != VK_NULL_HANDLE)
            device_->vk().vkDestroySemaphore(device_->handle(), slot.acquired, nullptr);
}

void Swapchain::swap(Swapchain& other) {
    std::swap(device_, other.device_);
    std::swap(surface_, other.surface_);
    std::swap(format_, other.format_);
    std::swap(mode_, other.mode_);
    std::swap(usage_, other.usage_);
    std::swap(alpha_, other.alpha_);
    std::swap(chain_, other.chain_);
    std::swap(extent_, other.extent_);
    std::swap(wanted_, other.wanted_);
    std::swap(generation_, other.generation_);
    std::swap(stale_, other.stale_);
    std::swap(suboptimal_, other.suboptimal_);
    std::swap(lost_, other.lost_);
    std::swap(taken_, other.taken_);
    std::swap(retired_, other.retired_);
    std::swap(retired_until_, other.retired_until_);
    std::swap(slots_, other.slots_);
    std::swap(slot_, other.slot_);
}

bool Swapchain::encodes_srgb() const {
    return is_srgb(format_.format);
}

// Chooses everything that does not depend on the window's size.
Result<void> Swapchain::choose(const SwapchainOptions& options) {
    const Device& device = *device_;
    VkBool32 supported = VK_FALSE;
    if (device.presents() && device.draws()) {
        const auto get =
            surface_function<PFN_vkGetPhysicalDeviceSurfaceSupportKHR>(device, "vkGetPhysicalDeviceSurfaceSupportKHR");
        const VkResult result = get(device.physical(), device.queue_family(), surface_, &supported);
        if (result != VK_SUCCESS) return device.error("to look at a window's surface", result);
    }
    if (!supported) {
        return Error::of_machine(device.info().name,
                                 "cannot show images in a window of this display; take another device, or write them "
                                 "to files");
    }
    const auto formats = list_of<VkSurfaceFormatKHR>(
        device, surface_,
        surface_function<PFN_vkGetPhysicalDeviceSurfaceFormatsKHR>(device, "vkGetPhysicalDeviceSurfaceFormatsKHR"));
    format_.format = VK_FORMAT_UNDEFINED;
    std::array candidates = {VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_UNORM,
                             VK_FORMAT_R8G8B8A8_UNORM};
    if (options.plain) std::ranges::rotate(candidates, candidates.begin() + 2);
    for (const VkFormat wanted : candidates) {
        const auto it = std::ranges::find_if(formats, [&](const VkSurfaceFormatKHR& one) {
            return one.format == wanted && one.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
        });
        if (it == formats.end()) continue;
        format_ = *it;
        break;
    }
    if (format_.format == VK_FORMAT_UNDEFINED)
        return Error::of_machine(device.info().name, "has no 8-bit color format for windows on this display");
    if (options.mailbox) {
        const auto modes = list_of<VkPresentModeKHR>(device, surface_,
                                                     surface_function<PFN_vkGetPhysicalDeviceSurfacePresentModesKHR>(
                                                         device, "vkGetPhysicalDeviceSurfacePresentModesKHR"));
        if (std::ranges::count(modes, VK_PRESENT_MODE_MAILBOX_KHR) > 0) mode_ = VK_PRESENT_MODE_MAILBOX_KHR;
    }
    bool lost = false;
    const auto can = capabilities(device, surface_, lost);
    if (!can) return can.errors();
    usage_ = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | (options.also & can->supportedUsageFlags);
    for (const auto alpha : {VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
                             VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR, VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR}) {
        if (!(can->supportedCompositeAlpha & alpha)) continue;
        alpha_ = alpha;
        break;
    }
    return {};
}

Result<void> Swapchain::make_semaphore(VkSemaphore& semaphore) const {
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore made = VK_NULL_HANDLE;
    const VkResult result = device_->vk().vkCreateSemaphore(device_->handle(), &info, nullptr, &made);
    if (result != VK_SUCCESS) return device_->error("to make a semaphore", result);
    semaphore = made;
    return {};
}

Result<SwapchainImage> Swapchain::acquire(VkExtent2D size) {
    if (lost_) return SwapchainImage{.state = Acquired::surface_lost};
    if (size.width == 0 || size.height == 0) return SwapchainImage{};
    if (taken_) {
        if (auto given = give_back(); !given) return given.errors();
    }
    Slot& slot = slots_[slot_];
    if (slot.done > 0) {
        if (auto waited = device_->wait(slot.done); !waited) return waited.errors();
    }
    if (retired_until_ > 0 && slot.done >= retired_until_) free_retired();

    for (int attempt = 0; attempt < 2; ++attempt) {
        const auto grown = outgrown(size);
        if (!grown) return grown.errors();
        if (*grown) {
            if (auto made = recreate(size); !made) return made.errors();
        }
        if (lost_) break;
        if (chain_.handle == VK_NULL_HANDLE) return SwapchainImage{};
        std::uint32_t index = 0;
        const VkResult result = device_->vk().vkAcquireNextImageKHR(device_->handle(), chain_.handle, patience,
                                                                    slot.acquired, VK_NULL_HANDLE, &index);
        if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR) {
            suboptimal_ = suboptimal_ || result == VK_SUBOPTIMAL_KHR;
            taken_ = true;
            return SwapchainImage{Acquired::image,
                                  index,
                                  generation_,
                                  chain_.images[index],
                                  chain_.views[index],
                                  extent_,
                                  {slot.acquired, chain_.drawn[index]}};
        }
        if (result == VK_TIMEOUT || result == VK_NOT_READY) return SwapchainImage{};
        lost_ = result == VK_ERROR_SURFACE_LOST_KHR;
        if (lost_) break;
        stale_ = result == VK_ERROR_OUT_OF_DATE_KHR;
        if (!stale_) return device_->error("to get a window's next image", result);
    }
    return SwapchainImage{.state = lost_ ? Acquired::surface_lost : Acquired::nothing};
}

Result<void> Swapchain::present(const SwapchainImage& image, std::uint64_t done) {
    Slot& slot = slots_[slot_];
    slot.done = done;
    slot_ = (slot_ + 1) % slots_.size();
    taken_ = false;
    // The image was presented before and acquired again. So all earlier presents are complete, those of older chains
    // too.
    if (!retired_.empty() && retired_until_ == 0 && chain_.presented[image.index]) retired_until_ = done;
    chain_.presented[image.index] = true;

    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &chain_.drawn[image.index];
    info.swapchainCount = 1;
    info.pSwapchains = &chain_.handle;
    info.pImageIndices = &image.index;
    if (device_->lock_queue()) device_->lock_queue()();
    const VkResult result = device_->vk().vkQueuePresentKHR(device_->queue(), &info);
    if (device_->unlock_queue()) device_->unlock_queue()();
    if (result == VK_SUBOPTIMAL_KHR) {
        suboptimal_ = true;
    } else if (result == VK_ERROR_OUT_OF_DATE_KHR) {
        stale_ = true;
    } else if (result == VK_ERROR_SURFACE_LOST_KHR) {
        lost_ = true;
    } else if (result != VK_SUCCESS) {
        return device_->error("to show an image in a window", result);
    }
    return {};
}

// It is unknown whether a submission waits for the acquired image's semaphore, so the semaphore is not used again.
Result<void> Swapchain::give_back() {
    taken_ = false;
    stale_ = true;
    chain_.left_over.push_back(std::exchange(slots_[slot_].acquired, VK_NULL_HANDLE));
    return make_semaphore(slots_[slot_].acquired);
}

// Some surfaces are always suboptimal, so VK_SUBOPTIMAL_KHR alone does not cause a recreation.
Result<bool> Swapchain::outgrown(VkExtent2D size) const {
    if (stale_ || chain_.handle == VK_NULL_HANDLE || !same(size, wanted_)) return true;
    if (!suboptimal_) return false;
    bool lost = false;
    const auto can = capabilities(*device_, surface_, lost);
    if (lost) return true;
    if (!can) return can.errors();
    return !same(fitting(*can, size), extent_);
}

Result<void> Swapchain::recreate(VkExtent2D size) {
    bool lost = false;
    const auto can = capabilities(*device_, surface_, lost);
    if (lost) {
        lost_ = true;
        return {};
    }
    if (!can) return can.errors();
    const VkExtent2D extent = fitting(*can, size);
    stale_ = true;
    suboptimal_ = false;
    if (retired_.size() >= most_retired) {
        wait_for_queue();
        free_retired();
    }
    if (extent.width == 0 || extent.height == 0) {
        retire();
        return {};
    }
    if (auto made = make_chain(*can, extent); !made) return made;
    if (lost_) return {};
    if (auto filled = fill_chain(); !filled) return filled;
    extent_ = extent;
    wanted_ = size;
    ++generation_;
    stale_ = false;
    return {};
}

Result<void> Swapchain::make_chain(const VkSurfaceCapabilitiesKHR& can, VkExtent2D size) {
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = surface_;
    info.minImageCount = can.minImageCount + 1;  // one more than the system needs, so that acquire does not wait
    if (can.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = size;
    info.imageArrayLayers = 1;
    info.imageUsage = usage_;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = (can.supportedTransforms & VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR)
                            ? VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR
                            : can.currentTransform;
    info.compositeAlpha = alpha_;
    info.presentMode = mode_;
    info.clipped = VK_TRUE;
    info.oldSwapchain = chain_.handle;
    VkSwapchainKHR made = VK_NULL_HANDLE;
    const VkResult result = device_->vk().vkCreateSwapchainKHR(device_->handle(), &info, nullptr, &made);
    retire();  // the old chain is retired even if the creation failed
    if (result == VK_ERROR_SURFACE_LOST_KHR) {
        lost_ = true;
        return {};
    }
    if (result != VK_SUCCESS) return device_->error("to make the images of a window", result);
    chain_.handle = made;
    return {};
}

Result<void> Swapchain::fill_chain() {
    const auto& vk = device_->vk();
    std::uint32_t count = 0;
    VkResult result = vk.vkGetSwapchainImagesKHR(device_->handle(), chain_.handle, &count, nullptr);
    chain_.images.resize(count);
    if (result == VK_SUCCESS)
        result = vk.vkGetSwapchainImagesKHR(device_->handle(), chain_.handle, &count, chain_.images.data());
    if (result != VK_SUCCESS) return device_->error("to get the images of a window", result);
    chain_.presented.assign(count, false);
    for (const VkImage image : chain_.images) {
        VkImageViewCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        info.image = image;
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = format_.format;
        info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        VkImageView view = VK_NULL_HANDLE;
        result = vk.vkCreateImageView(device_->handle(), &info, nullptr, &view);
        if (result != VK_SUCCESS) return device_->error("to draw into the images of a window", result);
        chain_.views.push_back(view);
        if (auto made = make_semaphore(chain_.drawn.emplace_back()); !made) return made;
    }
    return {};
}

void Swapchain::retire() {
    if (chain_.handle == VK_NULL_HANDLE) return;
    retired_.push_back(std::exchange(chain_, {}));
    retired_until_ = 0;
}

void Swapchain::free_retired() {
    for (Chain& chain : retired_) destroy(chain);
    retired_.clear();
    retired_until_ = 0;
}

void Swapchain::wait_for_queue() const {
    if (device_->lock_queue()) device_->lock_queue()();
    device_->vk().vkQueueWaitIdle(device_->queue());
    if (device_->unlock_queue()) device_->unlock_queue()();
}

void Swapchain::destroy(Chain& chain) const {
    const auto& vk = device_->vk();
    for (const VkImageView view : chain.views) vk.vkDestroyImageView(device_->handle(), view, nullptr);
    for (const auto* list : {&chain.drawn, &chain.left_over})
        for (const VkSemaphore semaphore : *list) vk.vkDestroySemaphore(device_->handle(), semaphore, nullptr);
    vk.vkDestroySwapchainKHR(device_->handle(), chain.handle, nullptr);
}

}  // namespace weft::gpu
