#include "view/scene_materials.h"

#include <algorithm>

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

const Image8* SceneMaterials::picture(const std::string& file, const std::string& name, const std::string& instead,
                                      std::vector<std::string>& notes) {
    if (file.empty()) return nullptr;
    const auto [entry, fresh] = pictures_.try_emplace(file);
    if (fresh) {
        auto read =
            read_ ? read_(file) : Result<Image8>(Error{file, "cannot be read: this program sets no image reader"});
        if (read) {
            entry->second = std::move(*read);
        } else {
            notes.push_back("look of '" + name + "': " + read.error().message() + instead);
        }
    }
    return entry->second ? &*entry->second : nullptr;
}

Result<render::MaterialId> SceneMaterials::find(render::Renderer& renderer, const std::string& name,
                                                const Material& material, std::vector<std::string>& notes) {
    if (const auto known = ids_.find(name); known != ids_.end()) return known->second;
    const Image8* color = picture(material.color_map, name, "; it is checkered instead", notes);
    const Image8* normal = picture(material.normal_map, name, "; its weave is drawn instead", notes);
    const Image8 checker = checkered();
    if (!material.color_map.empty() && color == nullptr) color = &checker;
    auto id = renderer.add(material, color, normal);
    if (!id) return id;
    ids_.emplace(name, *id);
    return id;
}

void SceneMaterials::keep(render::Renderer& renderer, std::span<const render::MaterialId> used) {
    std::erase_if(ids_, [&](const auto& entry) {
        if (std::ranges::find(used, entry.second) != used.end()) return false;
        renderer.remove(entry.second);
        return true;
    });
}

}  // namespace weft
