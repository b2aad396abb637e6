// Pictures on the device: what is drawn into, and what shaders sample.
#pragma once

#include "gpu/memory.h"

#include <string>

namespace weft::gpu {

struct ImageDesc {
    std::uint32_t width = 1, height = 1;
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    std::uint32_t samples = 1;  ///< a power of two that the device has
    std::uint32_t levels = 1;   ///< each half of the one before
};

bool is_depth(VkFormat format);

/// With a view of all of it. Its memory goes back when it does; the device must be done with it then.
class Image {
  public:
    /// Its content is anything. Fails where the device has not that format for that use, or no room.
    static Result<Image> create(Device& device, const ImageDesc& desc, const std::string& name);
    Image() = default;
    Image(Image&& other) noexcept { swap(other); }
    Image& operator=(Image&& other) noexcept {
        Image(std::move(other)).swap(*this);
        return *this;
    }
    ~Image();

    explicit operator bool() const { return image_ != VK_NULL_HANDLE; }
    VkImage handle() const { return image_; }
    VkImageView view() const { return view_; }
    const ImageDesc& desc() const { return desc_; }
    VkImageAspectFlags aspect() const;

  private:
    void swap(Image& other);
    Result<Done> place(const std::string& name);

    Device* device_ = nullptr;
    ImageDesc desc_;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::uint64_t bytes_ = 0;
};

struct SamplerDesc {
    VkFilter filter = VK_FILTER_LINEAR;
    VkSamplerAddressMode address_u = VK_SAMPLER_ADDRESS_MODE_REPEAT, address_v = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    bool anisotropic = false;  ///< where the device can
    bool compare = false;      ///< a depth: 1 where the reference is at most as deep
};

class Sampler {
  public:
    static Result<Sampler> create(const Device& device, const SamplerDesc& desc);
    Sampler() = default;
    Sampler(Sampler&& other) noexcept { swap(other); }
    Sampler& operator=(Sampler&& other) noexcept {
        Sampler(std::move(other)).swap(*this);
        return *this;
    }
    ~Sampler();
    VkSampler handle() const { return sampler_; }

  private:
    void swap(Sampler& other);

    const Device* device_ = nullptr;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

/// The samples a pixel that both colors and depths can have, up to `wanted`: a power of two.
std::uint32_t supported_samples(const Device& device, std::uint32_t wanted);

}  // namespace weft::gpu
