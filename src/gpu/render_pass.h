// Render passes, and the framebuffers they draw into.
#pragma once

#include "gpu/image.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::gpu {

enum class Keep {
    cleared,  ///< begins with the clear value
    loaded,   ///< begins with the content that another pass left
};

struct Attachment {
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    std::uint32_t samples = 1;
    Keep keep = Keep::cleared;
    VkImageLayout after = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;  ///< for the next use
    VkImageLayout before = VK_IMAGE_LAYOUT_UNDEFINED;                ///< only if loaded: the layout it was left in
};

/// One pass over colors and at most one depth attachment, which comes last. It begins after all earlier drawing, and
/// its results are visible to later commands.
class RenderPass {
  public:
    static Result<RenderPass> create(const Device& device, std::span<const Attachment> attachments,
                                     const std::string& name);
    RenderPass() = default;
    RenderPass(RenderPass&& other) noexcept { swap(other); }
    RenderPass& operator=(RenderPass&& other) noexcept {
        RenderPass(std::move(other)).swap(*this);
        return *this;
    }
    ~RenderPass();

    VkRenderPass handle() const { return pass_; }
    const std::vector<Attachment>& attachments() const { return attachments_; }
    std::uint32_t colors() const;

  private:
    void swap(RenderPass& other);

    const Device* device_ = nullptr;
    std::vector<Attachment> attachments_;
    VkRenderPass pass_ = VK_NULL_HANDLE;
};

/// The images that one pass draws into, in the order of its attachments.
class Framebuffer {
  public:
    static Result<Framebuffer> create(const Device& device, const RenderPass& pass, std::span<const VkImageView> views,
                                      std::uint32_t width, std::uint32_t height);
    Framebuffer() = default;
    Framebuffer(Framebuffer&& other) noexcept { swap(other); }
    Framebuffer& operator=(Framebuffer&& other) noexcept {
        Framebuffer(std::move(other)).swap(*this);
        return *this;
    }
    ~Framebuffer();

    VkFramebuffer handle() const { return framebuffer_; }
    VkExtent2D extent() const { return extent_; }

  private:
    void swap(Framebuffer& other);

    const Device* device_ = nullptr;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
};

}  // namespace weft::gpu
