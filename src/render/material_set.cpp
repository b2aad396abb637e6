#include "render/material_set.h"

#include "gpu/commands.h"
#include "render/albedo.h"

#include <algorithm>
#include <cstring>

namespace weft::render {
namespace {

/// The values as half floats.
std::vector<std::byte> halves_of(const std::vector<float>& values) {
    std::vector<std::byte> bytes(values.size() * 2);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::uint16_t half = half_float(values[i]);
        std::memcpy(&bytes[2 * i], &half, 2);
    }
    return bytes;
}

glm::vec4 packed(Vec3 v, float w) {
    return {v.x, v.y, v.z, w};
}

bool threads_cross(Weave weave) {
    return weave == Weave::plain || weave == Weave::twill || weave == Weave::satin;
}

shading::MaterialData data_of(const Material& material, const float threads[2], float warp, bool mapped, bool colored) {
    shading::MaterialData data{};
    data.color = packed(material.color, material.diffuse_roughness);
    data.weft_color = packed(material.weft_color, material.specular);
    data.sheen = packed(material.sheen_color, material.sheen_roughness * material.sheen_roughness);
    data.roughness = {material.roughness[0] * material.roughness[0], material.roughness[1] * material.roughness[1],
                      material.weave_depth, material.transmission};
    data.velvet = {material.velvet, material.velvet_alpha, material.coverage,
                   !mapped && threads_cross(material.weave) ? 1.0f : 0.0f};
    const float pitch = material.thread_spacing * 1e-3f;
    data.tile = mapped ? glm::vec4(material.uv_tiling[0], material.uv_tiling[1], 1, 0)
                       : glm::vec4(1 / (pitch * threads[0]), 1 / (pitch * threads[1]), 0, 0);
    data.map = {material.uv_tiling[0], material.uv_tiling[1], colored ? 1.0f : 0.0f,
                material.coverage < 1 ? 1.0f : 0.0f};
    std::ranges::copy(albedo_table(fiber_of(material, warp)), data.table);
    return data;
}

}  // namespace

Result<void> MaterialSet::prepare() {
    if (white_) return {};
    auto sampler = gpu::Sampler::create(device_, {.anisotropic = true});
    if (!sampler) return sampler.errors();
    auto white = make_texture(device_, Image8{1, 1, {255, 255, 255, 255}}, "white");
    if (!white) return white.errors();
    sampler_ = std::move(*sampler);
    white_ = std::move(*white);
    return {};
}

Result<MaterialSet::ReliefImages> MaterialSet::upload(const Relief& relief, const std::string& name) {
    std::vector<std::vector<std::byte>> first, second;
    for (const ReliefLevel& level : relief.levels) {
        first.push_back(halves_of(level.first));
        second.push_back(halves_of(level.second));
    }
    const std::uint32_t side = relief.levels.front().side;
    constexpr VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT;
    auto slopes = make_texture(device_, side, side, format, first, name);
    if (!slopes) return slopes.errors();
    auto squares = make_texture(device_, side, side, format, second, name + ", squared");
    if (!squares) return squares.errors();
    return ReliefImages{std::move(*slopes), std::move(*squares)};
}

Result<const MaterialSet::Tile*> MaterialSet::tile_of(Weave weave) {
    std::optional<Tile>& tile = tiles_.at(static_cast<std::size_t>(weave));
    if (tile) return &*tile;
    const Relief relief = make_weave(weave);
    auto images = upload(relief, "weave");
    if (!images) return images.errors();
    tile.emplace(Tile{std::move(*images), {relief.threads[0], relief.threads[1]}, relief.levels.back().first[3]});
    return &*tile;
}

void MaterialSet::write(const Material& material, const Tile& tile, Entry& entry) {
    const bool mapped = static_cast<bool>(entry.own.first), colored = static_cast<bool>(entry.color);
    entry.data = data_of(material, tile.threads, mapped ? 1.0f : tile.warp, mapped, colored);
    entry.sheer = material.coverage < 1;
}

Result<void> MaterialSet::change(std::uint32_t id, const Material& material) {
    const auto tile = tile_of(material.weave);
    if (!tile) return tile.errors();
    write(material, **tile, entries_[id]);
    return {};
}

Result<std::uint32_t> MaterialSet::add(const Material& material, const MaterialMaps& maps,
                                       VkDescriptorSetLayout layout) {
    if (auto prepared = prepare(); !prepared) return prepared.errors();
    const auto tile = tile_of(material.weave);
    if (!tile) return tile.errors();
    Entry entry;
    if (maps.color) {
        auto color = make_texture(device_, *maps.color, "color map");
        if (!color) return color.errors();
        entry.color = std::move(*color);
    }
    if (maps.normal) {
        auto own = upload(relief_of_normals(*maps.normal), "normal map");
        if (!own) return own.errors();
        entry.own = std::move(*own);
    }
    write(material, **tile, entry);

    const ReliefImages& relief = maps.normal ? entry.own : (*tile)->images;
    const VkImageView color = entry.color ? entry.color.view() : white_.view();
    const gpu::BoundImage images[] = {{0, color, sampler_.handle()},
                                      {1, relief.first.view(), sampler_.handle()},
                                      {2, relief.second.view(), sampler_.handle()}};
    auto set = gpu::DescriptorSet::create(device_, layout, images);
    if (!set) return set.errors();
    entry.images = std::move(*set);
    if (free_.empty()) {
        entries_.push_back(std::move(entry));
        return static_cast<std::uint32_t>(entries_.size() - 1);
    }
    const std::uint32_t id = free_.back();
    free_.pop_back();
    entries_[id] = std::move(entry);
    return id;
}

void MaterialSet::remove(std::uint32_t id) {
    entries_[id] = {};
    free_.push_back(id);
}

}  // namespace weft::render
