// Materials on the device: their parameters and the images of their threads.
#pragma once

#include "gpu/graphics_pipeline.h"
#include "look/material.h"
#include "look/weave.h"
#include "render/shading/frame.data.h"
#include "render/texture.h"

#include <array>
#include <deque>
#include <optional>
#include <vector>

namespace weft::render {

/// Images that a material names, read by the caller.
struct MaterialMaps {
    const Image8* color = nullptr;
    const Image8* normal = nullptr;
};

class MaterialSet {
  public:
    explicit MaterialSet(gpu::Device& device) : device_(device) {}

    /// `layout`: of the descriptor set with the material's images.
    Result<std::uint32_t> add(const Material& material, const MaterialMaps& maps, VkDescriptorSetLayout layout);
    /// Changes everything except weave and maps, which must be those of before.
    Result<void> change(std::uint32_t id, const Material& material);
    /// Frees the material. add() reuses its number.
    void remove(std::uint32_t id);
    const shading::MaterialData& data(std::uint32_t id) const { return entries_[id].data; }
    const gpu::DescriptorSet& images(std::uint32_t id) const { return entries_[id].images; }
    bool sheer(std::uint32_t id) const { return entries_[id].sheer; }
    std::size_t size() const { return entries_.size(); }

  private:
    struct ReliefImages {
        gpu::Image first, second;
    };
    struct Entry {
        shading::MaterialData data{};
        gpu::Image color;
        ReliefImages own;  // from the normal map
        gpu::DescriptorSet images;
        bool sheer = false;
    };
    struct Tile {
        ReliefImages images;
        float threads[2] = {1, 1}, warp = 1;
    };

    Result<void> prepare();
    Result<ReliefImages> upload(const Relief& relief, const std::string& name);
    Result<const Tile*> tile_of(Weave weave);
    static void write(const Material& material, const Tile& tile, Entry& entry);

    gpu::Device& device_;
    gpu::Sampler sampler_;
    gpu::Image white_;
    std::array<std::optional<Tile>, 8> tiles_;  // by weave
    std::deque<Entry> entries_;
    std::vector<std::uint32_t> free_;  // numbers of removed entries
};

}  // namespace weft::render
