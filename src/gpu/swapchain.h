// The images of a window, which the system presents.
#pragma once

#include "gpu/device.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft::gpu {

struct SwapchainOptions {
    /// Draws without waiting for the screen, which shows the newest image (VK_PRESENT_MODE_MAILBOX_KHR), if the surface
    /// supports it. Otherwise one image per refresh of the screen (FIFO).
    bool mailbox = false;
    /// Prefers images whose values are shown as they are written, so that shaders encode sRGB and blending mixes
    /// encoded colors. Otherwise images that encode sRGB come first.
    bool plain = false;
    /// Usage flags of the images in addition to drawing, if the surface supports them.
    VkImageUsageFlags also = 0;
};

enum class Acquired {
    image,         ///< an image to draw and present
    nothing,       ///< no image this time: the window has no size, or is being resized or hidden
    surface_lost,  ///< permanently: make the swapchain and the surface again
};

struct SwapchainImage {
    Acquired state = Acquired::nothing;  ///< the other members are set only for `image`
    std::uint32_t index = 0;
    std::uint64_t generation = 0;  ///< changes whenever the images are new
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkExtent2D extent{};
    /// For the submission that draws the image. It must leave the image in VK_IMAGE_LAYOUT_PRESENT_SRC_KHR.
    BinarySemaphores semaphores = {};
};

/// At most two frames are in flight: one is drawn while the previous one waits for presentation.
class Swapchain {
  public:
    /// `surface` must outlive the swapchain. Fails if the device cannot present to it.
    static Result<Swapchain> create(Device& device, VkSurfaceKHR surface, const SwapchainOptions& options = {});
    Swapchain(Swapchain&& other) noexcept { swap(other); }
    Swapchain& operator=(Swapchain&& other) noexcept {
        Swapchain(std::move(other)).swap(*this);
        return *this;
    }
    /// Waits until the device uses none of its images.
    ~Swapchain();

    VkFormat format() const { return format_.format; }
    /// Whether drawn linear values are encoded as sRGB. If not, shaders must encode them.
    bool encodes_srgb() const;
    VkImageUsageFlags usage() const { return usage_; }
    VkPresentModeKHR mode() const { return mode_; }

    /// Returns the next image. Waits for an image, and for the frame before the last. `size`: of the window, in
    /// pixels. Recreates the images if the size has changed or the system requires it. Releases an image that was
    /// acquired but not presented.
    Result<SwapchainImage> acquire(VkExtent2D size);
    /// Presents the image when it is drawn. `done`: result of the submission that draws it.
    Result<void> present(const SwapchainImage& image, std::uint64_t done);

  private:
    // One VkSwapchainKHR with its images.
    struct Chain {
        VkSwapchainKHR handle = VK_NULL_HANDLE;
        std::vector<VkImage> images;
        std::vector<VkImageView> views;
        std::vector<VkSemaphore> drawn;      // per image: must not be signaled while a wait is pending
        std::vector<bool> presented;         // at least once
        std::vector<VkSemaphore> left_over;  // of released images
    };
    // A frame in flight.
    struct Slot {
        VkSemaphore acquired = VK_NULL_HANDLE;
        std::uint64_t done = 0;
    };

    Swapchain() = default;
    void swap(Swapchain& other);
    Result<void> choose(const SwapchainOptions& options);
    Result<void> recreate(VkExtent2D size);
    Result<void> make_chain(const VkSurfaceCapabilitiesKHR& can, VkExtent2D size);
    Result<void> fill_chain();
    Result<void> make_semaphore(VkSemaphore& semaphore) const;
    Result<void> give_back();
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
    VkExtent2D extent_{}, wanted_{};  // of the images; as requested for them
    std::uint64_t generation_ = 0;
    bool stale_ = true, suboptimal_ = false, lost_ = false;
    bool taken_ = false;  // an image is acquired and not presented

    // Vulkan does not report the end of a presentation. An image of a later chain is reacquired only after it.
    std::vector<Chain> retired_;
    std::uint64_t retired_until_ = 0;  // 0: not known yet
    std::array<Slot, 2> slots_;
    std::uint32_t slot_ = 0;
};

}  // namespace weft::gpu
