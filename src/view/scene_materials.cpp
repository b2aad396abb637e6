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

Result<render::MaterialId> SceneMaterials::add(render::Renderer& renderer, const std::string& name,
                                               const Material& material, std::vector<std::string>& notes) {
    const Image8* color = picture(material.color_map, name, "; it is checkered instead", notes);
    const Image8* normal = picture(material.normal_map, name, "; its weave is drawn instead", notes);
    const Image8 checker = checkered();
    if (!material.color_map.empty() && color == nullptr) color = &checker;
    return renderer.add(material, color, normal);
}

Result<void> SceneMaterials::set(render::Renderer& renderer, std::optional<render::MaterialId>& of,
                                 const std::string& name, const Material& material, std::vector<std::string>& notes) {
    if (of && used_.at(*of).material == material) return {};
    const auto equal =
        std::ranges::find_if(used_, [&](const auto& entry) { return entry.second.material == material; });
    if (of) {
        gpu::Device& device = *renderer.device();
        if (auto idle = device.wait(device.submitted()); !idle) return idle;
        // While a slider moves, the material changes with each image, and its images stay on the device.
        Used& mine = used_.at(*of);
        if (mine.objects == 1 && equal == used_.end() && mine.material.weave == material.weave &&
            mine.material.color_map == material.color_map && mine.material.normal_map == material.normal_map) {
            mine.material = material;
            return renderer.change(*of, material);
        }
    }
    if (equal != used_.end()) {
        ++equal->second.objects;
        const render::MaterialId id = equal->first;
        release(renderer, of);
        of = id;
        return {};
    }
    release(renderer, of);
    const auto id = add(renderer, name, material, notes);
    if (!id) return id.errors();
    used_[*id] = {material, 1};
    of = *id;
    return {};
}

void SceneMaterials::release(render::Renderer& renderer, std::optional<render::MaterialId>& of) {
    if (!of) return;
    const auto used = used_.find(*of);
    if (--used->second.objects == 0) {
        renderer.remove(*of);
        used_.erase(used);
    }
    of.reset();
}

}  // namespace weft
