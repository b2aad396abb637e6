#include "render/texture.h"

#include "gpu/commands.h"
#include "render/shading/tone.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace weft::render {
namespace {

std::vector<std::byte> bytes_of(std::span<const std::uint8_t> values) {
    const auto bytes = std::as_bytes(values);
    return {bytes.begin(), bytes.end()};
}

/// The image at half the size. Means are computed in linear light.
Image8 halved(const Image8& image) {
    Image8 half{std::max(1u, image.width / 2), std::max(1u, image.height / 2), {}};
    half.rgba.resize(std::size_t{half.width} * half.height * 4);
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 0; x < half.width; ++x) {
            const std::uint32_t x0 = std::min(2 * x, image.width - 1), x1 = std::min(2 * x + 1, image.width - 1),
                                y0 = std::min(2 * y, image.height - 1), y1 = std::min(2 * y + 1, image.height - 1);
            for (int channel = 0; channel < 4; ++channel) {
                float sum = 0;
                for (const std::uint8_t* p : {image.at(x0, y0), image.at(x1, y0), image.at(x0, y1), image.at(x1, y1)}) {
                    const float value = static_cast<float>(p[channel]) / 255;
                    sum += channel == 3 ? value : shading::srgb_decoded(value);
                }
                const float mean = sum / 4, value = channel == 3 ? mean : shading::srgb_encoded(mean);
                half.at(x, y)[channel] = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255));
            }
        }
    }
    return half;
}

}  // namespace

std::uint16_t half_float(float value) {
    constexpr float largest = 65504;
    if (std::isnan(value)) return 0x7e00;
    value = std::clamp(value, -largest, largest);
    const std::uint32_t sign = std::bit_cast<std::uint32_t>(value) >> 16 & 0x8000u;
    const float size = std::abs(value);
    if (size < 6.103515625e-5f)  // subnormal: multiples of 2^-24
        return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(std::lrint(size * 16777216.0f)));
    std::uint32_t bits = std::bit_cast<std::uint32_t>(size);
    bits += 0xfffu + (bits >> 13 & 1u);  // to the nearest, ties to even
    return static_cast<std::uint16_t>(sign | ((bits - (112u << 23)) >> 13));
}

Result<gpu::Image> make_texture(gpu::Device& device, std::uint32_t width, std::uint32_t height, VkFormat format,
                                std::span<const std::vector<std::byte>> levels, const std::string& name) {
    auto image = gpu::Image::create(device,
                                    {.width = width,
                                     .height = height,
                                     .format = format,
                                     .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                     .levels = static_cast<std::uint32_t>(levels.size())},
                                    name);
    if (!image) return image.errors();
    std::uint64_t bytes = 0;
    for (const auto& level : levels) bytes += (level.size() + 15) / 16 * 16;
    auto staging = device.memory().buffer(bytes, gpu::MemoryKind::upload, "upload of " + name);
    if (!staging) return staging.errors();
    const auto done = gpu::run_once(device, [&](gpu::Commands& commands) {
        commands.transition(*image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        std::uint64_t offset = 0;
        for (std::uint32_t level = 0; level < levels.size(); ++level) {
            std::memcpy(staging->mapped().data() + offset, levels[level].data(), levels[level].size());
            commands.copy_to_image(*staging, offset, *image, level);
            offset += (levels[level].size() + 15) / 16 * 16;
        }
        commands.transition(*image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
    if (!done) return done.errors();
    return image;
}

Result<gpu::Image> make_texture(gpu::Device& device, const Image8& image, const std::string& name) {
    std::vector<std::vector<std::byte>> levels = {bytes_of(image.rgba)};
    for (Image8 level = image; level.width > 1 || level.height > 1;) {
        level = halved(level);
        levels.push_back(bytes_of(level.rgba));
    }
    return make_texture(device, image.width, image.height, VK_FORMAT_R8G8B8A8_SRGB, levels, name);
}

Result<gpu::Image> make_texture(gpu::Device& device, std::span<const ImageF> levels, const std::string& name) {
    std::vector<std::vector<std::byte>> all;
    for (const ImageF& level : levels) {
        std::vector<std::byte>& bytes = all.emplace_back(level.rgba.size() * 2);
        for (std::size_t i = 0; i < level.rgba.size(); ++i) {
            const std::uint16_t half = half_float(level.rgba[i]);
            std::memcpy(&bytes[2 * i], &half, 2);
        }
    }
    return make_texture(device, levels[0].width, levels[0].height, VK_FORMAT_R16G16B16A16_SFLOAT, all, name);
}

}  // namespace weft::render
