// Images on the device: render targets, and images that shaders sample.
#pragma once

#include "gpu/memory.h"

#include <string>

namespace weft::gpu {

struct ImageDesc {
    std::uint32_t width = 1, height = 1;
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    std::uint32_t samples = 1;  ///< a power of two that the device supports
    std::uint32_t levels = 1;   ///< each level has half the size of the one before
};

bool is_depth(VkFormat format);

/// An image with a view of all levels. The destructor frees its memory; the device must not use it any more then.
class Image {
  public:
    /// The content is undefined. Fails if the device does not support the format for that use, or lacks memory.
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
    Result<void> place(const std::string& name);

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
    bool anisotropic = false;  ///< if the device supports it
    bool compare = false;      ///< depth comparison: 1 if the reference is at most as deep
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

/// Largest number of samples per pixel that both color and depth support, up to `wanted`; a power of two.
std::uint32_t supported_samples(const Device& device, std::uint32_t wanted);

}  // namespace weft::gpu
