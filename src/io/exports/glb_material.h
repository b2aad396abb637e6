// Converts materials to glTF 2.0 with the extensions for cloth that Khronos has ratified.
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

/// Matte, for surfaces without a material: light gray, or the vertex colors.
tinygltf::Material plain_material(const std::string& name, bool vertex_colors);

/// Adds materials to a model, and each image that they use once to its buffer.
///
/// Color, roughness and `specular` become the metallic-roughness model with KHR_materials_specular, an anisotropic
/// highlight KHR_materials_anisotropy, fuzz and pile KHR_materials_sheen, coverage alpha. If the mesh has UVs, the
/// weave becomes a normal map (KHR_texture_transform) that repeats as often as its threads fit into the mesh; the
/// roughness includes the variance of its slopes. No ratified extension covers the transmitted light.
class GltfMaterials {
  public:
    /// Appends bytes to the buffer and returns the number of a view of them.
    using AddBytes = std::function<Result<int>(std::span<const std::byte>)>;

    GltfMaterials(tinygltf::Model& model, AddBytes add_bytes) : model_(model), add_bytes_(std::move(add_bytes)) {}

    /// Sets the folder beside which image files are searched.
    void look_in(std::filesystem::path folder) { folder_ = std::move(folder); }

    /// Appends to the model's materials. An image that cannot be read is left out.
    Result<void> add(const std::string& name, const Material& material, const ExportSurface& surface);

    /// Estimated bytes of all images of these surfaces; rather too many than too few.
    static std::uint64_t most_picture_bytes(std::span<const ExportSurface> surfaces,
                                            const std::filesystem::path& folder);

  private:
    /// Averages over the unevenness of a surface.
    struct Tile {
        float slopes[2] = {0, 0};   ///< means of the squared slopes along u and v
        float light = 1, warp = 1;  ///< means
        float threads[2] = {1, 1};  ///< thread spacings per side
        int texture = -1;           ///< of its normals; -1: none
    };
    enum class Textures { without, with };

    Result<Tile> tile_of(const Material& material, Textures textures);
    Result<void> add_color(const Material& material, const Tile& tile, std::array<double, 2> tile_repeat,
                           Textures textures, tinygltf::Material& to);
    void add_highlight(const Material& material, const Tile& tile, tinygltf::Material& to);
    void add_fuzz(const Material& material, tinygltf::Material& to);
    Result<int> add_texture(const std::string& mime_type, std::span<const std::byte> bytes);
    /// Also lists the extension among those that the model uses.
    void extend(tinygltf::ExtensionMap& extensions, const std::string& name, tinygltf::Value::Object members);

    tinygltf::Model& model_;
    AddBytes add_bytes_;
    std::filesystem::path folder_;
    std::map<std::string, Tile> tiles_;       // by weave or file
    std::map<std::string, int> color_files_;  // -1: cannot be read
};

}  // namespace weft
