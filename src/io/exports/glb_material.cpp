#include "io/exports/glb_material.h"

#include "io/files/whole_file.h"
#include "io/images/image_file.h"
#include "io/meshes/mesh_file.h"
#include "look/weave.h"
#include "mesh/uv_scale.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace weft {
namespace {

using tinygltf::Value;

// Largest PNG of a tile: 256 by 256 pixels of three bytes, each of which the compression may expand to nine bits.
constexpr std::uint64_t most_tile_bytes = 225'000;

// Reflectance of dielectrics at normal incidence in glTF, which KHR_materials_specular multiplies.
constexpr float gltf_specular = 0.04f;

/// An image in a form that a .glb can hold.
struct Embedded {
    Image8 image;
    std::string mime_type;
    std::vector<std::byte> bytes;
};

/// Nothing if the file cannot be read.
std::optional<Embedded> embedded(const std::string& name, const std::filesystem::path& folder) {
    const auto path = find_asset(name, folder);
    if (!path) return {};
    const auto content = read_whole_file(*path);
    if (!content) return {};
    const auto bytes = std::as_bytes(std::span(*content));
    auto image = decode_image(bytes, name);
    if (!image) return {};
    const bool is_png = content->starts_with("\x89PNG"), is_jpeg = content->starts_with("\xff\xd8");
    if (is_png || is_jpeg) {
        return Embedded{*std::move(image), is_png ? "image/png" : "image/jpeg", {bytes.begin(), bytes.end()}};
    }
    auto png = png_bytes(*image);
    if (!png) return {};
    return Embedded{*std::move(image), "image/png", *std::move(png)};
}

Vec3 between(Vec3 weft, Vec3 warp, float share) {
    return weft + (warp - weft) * share;
}

/// sRGB encoding, IEC 61966-2-1.
std::uint8_t srgb_byte(float linear) {
    const float c = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

/// A color map of the warp and weft colors, darkened in the gaps between the threads.
Image8 colors_of(const Material& material) {
    const Relief relief = make_weave(material.weave);
    const ReliefLevel& level = relief.levels.front();
    Image8 image{level.side, level.side, std::vector<std::uint8_t>(std::size_t{level.side} * level.side * 4)};
    for (std::uint32_t y = 0; y < level.side; ++y) {
        for (std::uint32_t x = 0; x < level.side; ++x) {
            const float* first = &level.first[(std::size_t{y} * level.side + x) * 4];
            const Vec3 color = first[2] * between(material.weft_color, material.color, first[3]);
            std::uint8_t* to = image.at(x, level.side - 1 - y);
            to[0] = srgb_byte(color.x), to[1] = srgb_byte(color.y), to[2] = srgb_byte(color.z), to[3] = 255;
        }
    }
    return image;
}

bool has_two_colors(const Material& material) {
    const bool woven =
        material.weave == Weave::plain || material.weave == Weave::twill || material.weave == Weave::satin;
    return woven && material.color != material.weft_color;
}

bool shows_weave_colors(const Material& material) {
    return material.color_map.empty() && material.normal_map.empty() && has_two_colors(material);
}

Value number(double value) {
    return Value(value);
}

Value numbers(std::initializer_list<double> values) {
    Value::Array array;
    for (const double value : values) array.push_back(Value(value));
    return Value(std::move(array));
}

/// The UVs of a .glb run downward, but the repeats are counted from the bottom.
Value::Object transform_of(std::array<double, 2> repeat) {
    const double offset = 1 - repeat[1];
    return {{"scale", numbers({repeat[0], repeat[1]})}, {"offset", numbers({0, offset - std::floor(offset)})}};
}

constexpr const char* texture_transform = "KHR_texture_transform";

}  // namespace

tinygltf::Material plain_material(const std::string& name, bool vertex_colors) {
    tinygltf::Material material;
    material.name = name;
    material.doubleSided = true;
    // Vertex colors are multiplied by the base color, so it must be white to keep them unchanged.
    const double base = vertex_colors ? 1.0 : 0.8;
    material.pbrMetallicRoughness.baseColorFactor = {base, base, base, 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
    return material;
}

void GltfMaterials::extend(tinygltf::ExtensionMap& extensions, const std::string& name, Value::Object members) {
    extensions[name] = Value(std::move(members));
    std::vector<std::string>& used = model_.extensionsUsed;
    if (std::ranges::find(used, name) == used.end()) used.push_back(name);
}

Result<int> GltfMaterials::add_texture(const std::string& mime_type, std::span<const std::byte> bytes) {
    if (model_.samplers.empty()) {
        tinygltf::Sampler& sampler = model_.samplers.emplace_back();
        sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_REPEAT;
    }
    const Result<int> view = add_bytes_(bytes);
    if (!view) return view;
    tinygltf::Image& image = model_.images.emplace_back();
    image.bufferView = *view;
    image.mimeType = mime_type;
    tinygltf::Texture& texture = model_.textures.emplace_back();
    texture.source = static_cast<int>(model_.images.size()) - 1;
    texture.sampler = 0;
    return static_cast<int>(model_.textures.size()) - 1;
}

Result<GltfMaterials::Tile> GltfMaterials::tile_of(const Material& material, Textures textures) {
    std::optional<Embedded> file;
    if (!material.normal_map.empty()) file = embedded(material.normal_map, folder_);
    const std::string key =
        file ? "file " + material.normal_map : "weave " + std::to_string(static_cast<int>(material.weave));
    const auto known = tiles_.find(key);
    if (known != tiles_.end() && (known->second.texture >= 0 || textures == Textures::without)) return known->second;

    const Relief relief = file ? relief_of_normals(file->image) : make_weave(material.weave);
    const ReliefLevel& whole = relief.levels.back();
    Tile tile{.slopes = {whole.second[0], whole.second[1]},
              .light = whole.first[2],
              .warp = whole.first[3],
              .threads = {relief.threads[0], relief.threads[1]}};
    if (textures == Textures::with && (file || material.weave != Weave::smooth)) {
        Embedded picture;
        if (file) {
            picture = *std::move(file);
        } else {
            auto png = png_bytes(normal_map_of(relief, 1));
            if (!png) return png.errors();
            picture.mime_type = "image/png";
            picture.bytes = *std::move(png);
        }
        const Result<int> texture = add_texture(picture.mime_type, picture.bytes);
        if (!texture) return texture.errors();
        tile.texture = *texture;
    }
    tiles_[key] = tile;
    return tile;
}

Result<void> GltfMaterials::add_color(const Material& material, const Tile& tile, std::array<double, 2> tile_repeat,
                                      Textures textures, tinygltf::Material& to) {
    Vec3 color = tile.light * between(material.weft_color, material.color, tile.warp);
    std::array<double, 2> repeat = tile_repeat;
    int texture = -1;
    if (textures == Textures::with && !material.color_map.empty()) {
        repeat = {material.uv_tiling[0], material.uv_tiling[1]};
        if (!color_files_.contains(material.color_map)) {
            int& number = color_files_[material.color_map] = -1;
            if (const auto file = embedded(material.color_map, folder_)) {
                const Result<int> added = add_texture(file->mime_type, file->bytes);
                if (!added) return added.errors();
                number = *added;
            }
        }
        texture = color_files_[material.color_map];
    } else if (textures == Textures::with && shows_weave_colors(material)) {
        const auto png = png_bytes(colors_of(material));
        if (!png) return png.errors();
        const Result<int> added = add_texture("image/png", *png);
        if (!added) return added.errors();
        texture = *added;
        color = {1, 1, 1};
    }
    tinygltf::PbrMetallicRoughness& pbr = to.pbrMetallicRoughness;
    pbr.baseColorFactor = {color.x, color.y, color.z, material.coverage};
    if (material.coverage < 1) to.alphaMode = "BLEND";
    if (texture >= 0) {
        pbr.baseColorTexture.index = texture;
        extend(pbr.baseColorTexture.extensions, texture_transform, transform_of(repeat));
    }
    return {};
}

/// A reader that shows the weave as a normal map loses its roughness at a distance. At common viewing distances the
/// slopes contribute only roughness (Olano and Baker 2010).
void GltfMaterials::add_highlight(const Material& material, const Tile& tile, tinygltf::Material& to) {
    double alpha[2];
    for (int i = 0; i < 2; ++i) {
        const double own = double{material.roughness[i]} * material.roughness[i];
        const double slopes = double{material.weave_depth} * material.weave_depth * tile.slopes[i];
        alpha[i] = std::min(1.0, std::sqrt(own * own + 2 * slopes));
    }
    const bool rougher_along_v = alpha[1] > alpha[0];
    const double least = std::min(alpha[0], alpha[1]), most = std::max(alpha[0], alpha[1]);
    to.pbrMetallicRoughness.metallicFactor = 0;
    to.pbrMetallicRoughness.roughnessFactor = std::sqrt(least);

    // The extension defines alpha along its direction as mix(alpha, 1, strength²).
    constexpr double seen = 0.05;  // smaller differences are not visible
    if (most - least > seen) {
        extend(to.extensions, "KHR_materials_anisotropy",
               {{"anisotropyStrength", number(std::sqrt((most - least) / (1 - least)))},
                {"anisotropyRotation", number(rougher_along_v ? std::acos(-1.0) / 2 : 0)}});
    }
    if (material.velvet > 0) {
        extend(to.extensions, "KHR_materials_specular", {{"specularFactor", number(0)}});
    } else if (material.specular != gltf_specular) {
        const double times = material.specular / gltf_specular;
        extend(to.extensions, "KHR_materials_specular", {{"specularColorFactor", numbers({times, times, times})}});
    }
}

void GltfMaterials::add_fuzz(const Material& material, tinygltf::Material& to) {
    const Vec3 color = material.sheen_color;
    float roughness = material.sheen_roughness;
    if (material.velvet > 0) roughness = material.velvet_alpha;  // the sheen color is that of the hairs
    if (color == Vec3{}) return;
    extend(to.extensions, "KHR_materials_sheen",
           {{"sheenColorFactor", numbers({color.x, color.y, color.z})}, {"sheenRoughnessFactor", number(roughness)}});
}

Result<void> GltfMaterials::add(const std::string& name, const Material& material, const ExportSurface& surface) {
    const Textures textures = surface.uvs.empty() ? Textures::without : Textures::with;
    const Result<Tile> tile = tile_of(material, textures);
    if (!tile) return tile.errors();
    const std::array<float, 2> meters = uv_meters(
        surface.rest_positions.empty() ? surface.positions : surface.rest_positions, surface.uvs, surface.triangles);
    std::array<double, 2> repeat;
    for (std::size_t i = 0; i < 2; ++i) repeat[i] = meters[i] / (tile->threads[i] * (material.thread_spacing * 1e-3));

    tinygltf::Material to;
    to.name = name;
    to.doubleSided = true;
    if (Result<void> r = add_color(material, *tile, repeat, textures, to); !r) return r;
    add_highlight(material, *tile, to);
    add_fuzz(material, to);
    if (textures == Textures::with && tile->texture >= 0 && material.weave_depth > 0) {
        const bool of_file = !material.normal_map.empty() && tiles_.contains("file " + material.normal_map);
        if (of_file) repeat = {material.uv_tiling[0], material.uv_tiling[1]};
        to.normalTexture.index = tile->texture;
        to.normalTexture.scale = material.weave_depth;
        extend(to.normalTexture.extensions, texture_transform, transform_of(repeat));
    }
    model_.materials.push_back(std::move(to));
    return {};
}

std::uint64_t GltfMaterials::most_picture_bytes(std::span<const ExportSurface> surfaces,
                                                const std::filesystem::path& folder) {
    std::uint64_t bytes = 0;
    for (const ExportSurface& surface : surfaces) {
        if (!surface.material || surface.uvs.empty()) continue;
        bytes += (surface.material->weave != Weave::smooth) * most_tile_bytes;
        bytes += shows_weave_colors(*surface.material) * most_tile_bytes;
        for (const std::string& file : {surface.material->color_map, surface.material->normal_map}) {
            if (file.empty()) continue;
            if (const auto picture = embedded(file, folder)) bytes += picture->bytes.size();
        }
    }
    return bytes;
}

}  // namespace weft
