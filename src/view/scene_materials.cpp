#include "view/scene_materials.h"

namespace weft {

Image8 checkered() {
    constexpr std::uint32_t side = 256, square = 32;
    Image8 image{side, side, {}};
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint8_t gray = (x / square + y / square) % 2 ? 235 : 110;
            image.rgba.insert(image.rgba.end(), {gray, gray, gray, 255});
        }
    }
    return image;
}

const Image8* SceneMaterials::picture(const std::string& file, const std::string& name,
                                      std::vector<std::string>& notes) {
    if (file.empty()) return nullptr;
    const auto [entry, fresh] = pictures_.try_emplace(file);
    if (fresh) {
        auto read = read_ ? read_(file) : Result<Image8>(Error{file, "there is nobody to read it"});
        if (read) {
            entry->second = std::move(*read);
        } else {
            notes.push_back("look of '" + name + "': " + read.error().message());
        }
    }
    return entry->second ? &*entry->second : nullptr;
}

Result<render::MaterialId> SceneMaterials::find(render::Renderer& renderer, const std::string& name,
                                                const Material& material, std::vector<std::string>& notes) {
    if (const auto known = ids_.find(name); known != ids_.end()) return known->second;
    const Image8* color = picture(material.color_map, name, notes);
    const Image8* normal = picture(material.normal_map, name, notes);
    const Image8 checker = checkered();
    if (!material.color_map.empty() && color == nullptr) {
        notes.back() += "; it is checkered instead";
        color = &checker;
    }
    if (!material.normal_map.empty() && normal == nullptr) notes.back() += "; its weave stands in for it";
    auto id = renderer.add(material, color, normal);
    if (!id) return id;
    ids_.emplace(name, *id);
    return id;
}

}  // namespace weft
