#include "gpu/image.h"

#include "gpu/borrowed_functions.h"
#include "gpu/device.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace weft::gpu {

bool is_depth(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_X8_D24_UNORM_PACK32;
}

VkImageAspectFlags Image::aspect() const {
    return is_depth(desc_.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

Result<Image> Image::create(Device& device, const ImageDesc& desc, const std::string& name) {
    Image self;
    self.device_ = &device;
    self.desc_ = desc;
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = desc.format;
    info.extent = {desc.width, desc.height, 1};
    info.mipLevels = desc.levels;
    info.arrayLayers = 1;
    info.samples = static_cast<VkSampleCountFlagBits>(desc.samples);
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = desc.usage;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    const std::string what = "the image '" + name + "' of " + std::to_string(desc.width) + "x" +
                             std::to_string(desc.height) +
                             (desc.samples > 1 ? " with " + std::to_string(desc.samples) + " samples" : "");
    VkImageFormatProperties most{};
    VkResult result = VK_SUCCESS;
    {
        const BorrowedFunctions functions(device);
        result = vkGetPhysicalDeviceImageFormatProperties(device.physical(), info.format, info.imageType, info.tiling,
                                                          info.usage, 0, &most);
    }
    if (result == VK_SUCCESS && (desc.width > most.maxExtent.width || desc.height > most.maxExtent.height))
        return Error::of_machine(device.info().name, "cannot make " + what + ": at most " +
                                                         std::to_string(most.maxExtent.width) + "x" +
                                                         std::to_string(most.maxExtent.height));
    if (result == VK_SUCCESS && !(most.sampleCounts & desc.samples)) result = VK_ERROR_FORMAT_NOT_SUPPORTED;
    const auto& vk = device.vk();
    if (result == VK_SUCCESS) result = vk.vkCreateImage(device.handle(), &info, nullptr, &self.image_);
    if (result != VK_SUCCESS) return device.error("to make " + what, result);
    if (auto placed = self.place(what); !placed) return placed.errors();
    device.name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(self.image_), name);

    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = self.image_;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = desc.format;
    view.subresourceRange = {self.aspect(), 0, desc.levels, 0, 1};
    result = vk.vkCreateImageView(device.handle(), &view, nullptr, &self.view_);
    if (result != VK_SUCCESS) return device.error("to make " + what, result);
    return self;
}

// Images are few and large, so each gets its own allocation.
Result<void> Image::place(const std::string& what) {
    const auto& vk = device_->vk();
    VkMemoryRequirements needs{};
    vk.vkGetImageMemoryRequirements(device_->handle(), image_, &needs);
    auto memory = device_->memory().allocate_dedicated(needs, what);
    if (!memory) return memory.errors();
    memory_ = *memory;
    bytes_ = needs.size;
    const VkResult result = vk.vkBindImageMemory(device_->handle(), image_, memory_, 0);
    if (result != VK_SUCCESS) return device_->error("to make " + what, result);
    return {};
}

Image::~Image() {
    if (!device_) return;
    const auto& vk = device_->vk();
    if (view_ != VK_NULL_HANDLE) vk.vkDestroyImageView(device_->handle(), view_, nullptr);
    if (image_ != VK_NULL_HANDLE) vk.vkDestroyImage(device_->handle(), image_, nullptr);
    if (memory_ != VK_NULL_HANDLE) device_->memory().free_dedicated(memory_, bytes_);
}

void Image::swap(Image& other) {
    std::swap(device_, other.device_);
    std::swap(desc_, other.desc_);
    std::swap(image_, other.image_);
    std::swap(view_, other.view_);
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
}

Result<Sampler> Sampler::create(const Device& device, const SamplerDesc& desc) {
    Sampler self;
    self.device_ = &device;
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = desc.filter;
    info.mipmapMode = desc.filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = desc.address_u;
    info.addressModeV = desc.address_v;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    info.anisotropyEnable = desc.anisotropic && device.most_anisotropy() > 1;
    info.maxAnisotropy = std::min(8.0f, std::max(1.0f, device.most_anisotropy()));
    info.compareEnable = desc.compare;
    info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;
    const VkResult result = device.vk().vkCreateSampler(device.handle(), &info, nullptr, &self.sampler_);
    if (result != VK_SUCCESS) return device.error("to make a sampler", result);
    return self;
}

Sampler::~Sampler() {
    if (sampler_ != VK_NULL_HANDLE) device_->vk().vkDestroySampler(device_->handle(), sampler_, nullptr);
}

void Sampler::swap(Sampler& other) {
    std::swap(device_, other.device_);
    std::swap(sampler_, other.sampler_);
}

std::uint32_t supported_samples(const Device& device, std::uint32_t wanted) {
    VkPhysicalDeviceProperties properties{};
    {
        const BorrowedFunctions functions(device);
        vkGetPhysicalDeviceProperties(device.physical(), &properties);
    }
    const VkSampleCountFlags both = properties.limits.framebufferColorSampleCounts &
                                    properties.limits.framebufferDepthSampleCounts &
                                    properties.limits.sampledImageColorSampleCounts;
    for (std::uint32_t samples = std::bit_floor(std::max(1u, wanted)); samples > 1; samples /= 2)
        if (both & samples) return samples;
    return 1;
}

}  // namespace weft::gpu
