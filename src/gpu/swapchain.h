// The pictures of a window, one after another: drawn into here, shown by the system.
#pragma once

#include "gpu/device.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft::gpu {

struct SwapchainOptions {
    /// As many pictures as there are, the newest one shown, where the surface can; else one for each that the screen
    /// shows.
    bool mailbox = false;
    /// Uses of its images beside being drawn into, where the surface has them.
    VkImageUsageFlags also = 0;
};

enum class Acquired {
    image,         ///< to be drawn and presented
    nothing,       ///< nowhere to draw this time: no size, or it changes just now
    surface_lost,  ///< for good: swapchain and surface are to be made again
};

struct SwapchainImage {
    Acquired state = Acquired::nothing;  ///< unless it is `image`, the rest is empty
    std::uint32_t index = 0;
    std::uint64_t generation = 0;  ///< another one: other images
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkExtent2D extent{};
    /// For the submit of what draws it, which leaves it in VK_IMAGE_LAYOUT_PRESENT_SRC_KHR.
    BinarySemaphores semaphores = {};
};

/// Two frames are under way at most: one is drawn while the one before it is waiting to be shown.
class Swapchain {
  public:
    /// `surface` outlives it. Fails where the device cannot show anything there.
    static Result<Swapchain> create(Device& device, VkSurfaceKHR surface, const SwapchainOptions& options = {});
    Swapchain(Swapchain&& other) noexcept { swap(other); }
    Swapchain& operator=(Swapchain&& other) noexcept {
        Swapchain(std::move(other)).swap(*this);
        return *this;
    }
    /// Waits until nothing of it is in use.
    ~Swapchain();

    VkFormat format() const { return format_.format; }
    /// Linear values that are drawn become sRGB. If not, shaders must do that.
    bool encodes_srgb() const;
    VkImageUsageFlags usage() const { return usage_; }
    VkPresentModeKHR mode() const { return mode_; }

    /// The next image; waits for one, and for the frame before the last. `size`: of the window, in pixels. Images are
    /// made anew where it has another size, and where the system wants that. One that was acquired and not presented is
    /// given back.
    Result<SwapchainImage> acquire(VkExtent2D size);
    /// Shows the image when it is drawn. `done`: what the submit returned that draws it.
    Result<Done> present(const SwapchainImage& image, std::uint64_t done);

  private:
    // The images of one VkSwapchainKHR, and what belongs to them.
    struct Chain {
        VkSwapchainKHR handle = VK_NULL_HANDLE;
        std::vector<VkImage> images;
        std::vector<VkImageView> views;
        std::vector<VkSemaphore> drawn;      // of each image: one that is still waited for must not be signaled again
        std::vector<bool> presented;         // at least once
        std::vector<VkSemaphore> left_over;  // of images that were given back
    };
    // Of the frames that are under way.
    struct Slot {
        VkSemaphore acquired = VK_NULL_HANDLE;
        std::uint64_t done = 0;
    };

    Swapchain() = default;
    void swap(Swapchain& other);
    Result<Done> choose(const SwapchainOptions& options);
    Result<Done> recreate(VkExtent2D size);
    Result<Done> make_chain(const VkSurfaceCapabilitiesKHR& can, VkExtent2D size);
    Result<Done> fill_chain();
    Result<Done> make_semaphore(VkSemaphore& semaphore) const;
    Result<Done> give_back();
    Result<bool> outgrown(VkExtent2D size) const;
    void retire();
    void free_retired();
    void wait_for_queue() const;
    void destroy(Chain& chain) const;

    Device* device_ = nullptr;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_{};
    VkPresentModeKHR mode_ = VK_PRESENT_MODE_FIFO_KHR;
    VkImageUsageFlags usage_ = 0;
    VkCompositeAlphaFlagBitsKHR alpha_ = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;

    Chain chain_;
    VkExtent2D extent_{}, wanted_{};  // of its images; and what was asked for then
    std::uint64_t generation_ = 0;
    bool stale_ = true, suboptimal_ = false, lost_ = false;
    bool taken_ = false;  // an image is acquired and not presented

    // Nothing says when an image was shown for the last time, but that of a later chain comes back after it.
    std::vector<Chain> retired_;
    std::uint64_t retired_until_ = 0;  // 0: not known yet
    std::array<Slot, 2> slots_;
    std::uint32_t slot_ = 0;
};

}  // namespace weft::gpu
