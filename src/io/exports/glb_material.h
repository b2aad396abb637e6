// Materials as glTF 2.0 says them, with the extensions that Khronos has ratified for cloth.
#pragma once

#include "io/exports/exporter.h"
#include "look/material.h"

#include <weft/result.h>

#include <tiny_gltf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace weft {

/// Adds materials to a model, and to its buffer the pictures that they use, each once.
///
/// Color, roughness and `specular` become the metallic-roughness model with KHR_materials_specular; a highlight that is
/// longer one way, KHR_materials_anisotropy; fuzz and pile, KHR_materials_sheen; coverage, alpha. The weave is a normal
/// map that repeats (KHR_texture_transform) as often as its threads go into the mesh, where that has UVs; what it makes
/// rougher from afar is part of the roughness. Light that goes through has no ratified extension.
class GltfMaterials {
  public:
    /// Appends bytes to the buffer and gives the number of a view of them.
    using AddBytes = std::function<Result<int>(std::span<const std::byte>)>;

    GltfMaterials(tinygltf::Model& model, AddBytes add_bytes) : model_(model), add_bytes_(std::move(add_bytes)) {}

    /// The folder that pictures are looked for beside.
    void look_in(std::filesystem::path folder) { folder_ = std::move(folder); }

    /// At the end of the model's materials. A picture that cannot be read is left out.
    Result<Done> add(const std::string& name, const Material& material, const ExportSurface& surface);

    /// What pictures of these surfaces take together; rather too much than too little.
    static std::uint64_t most_picture_bytes(std::span<const ExportSurface> surfaces,
                                            const std::filesystem::path& folder);

  private:
    /// What makes the surface uneven, as a whole.
    struct Tile {
        float slopes[2] = {0, 0};   ///< mean squares, along u and v
        float light = 1, warp = 1;  ///< mean shares
        float threads[2] = {1, 1};  ///< spacings a side
        int texture = -1;           ///< of its normals; -1: it has none
    };
    enum class Textures { without, with };

    Result<Tile> tile_of(const Material& material, Textures textures);
    Result<Done> add_color(const Material& material, const Tile& tile, std::array<double, 2> tile_repeat,
                           Textures textures, tinygltf::Material& to);
    void add_highlight(const Material& material, const Tile& tile, tinygltf::Material& to);
    void add_fuzz(const Material& material, tinygltf::Material& to);
    Result<int> add_texture(const std::string& mime_type, std::span<const std::byte> bytes);
    /// The names of extensions in use stand in the model too.
    void extend(tinygltf::ExtensionMap& extensions, const std::string& name, tinygltf::Value::Object members);

    tinygltf::Model& model_;
    AddBytes add_bytes_;
    std::filesystem::path folder_;
    std::map<std::string, Tile> tiles_;       // by weave or file
    std::map<std::string, int> color_files_;  // -1: cannot be read
};

}  // namespace weft
