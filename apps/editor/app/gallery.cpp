#include "editor/app/gallery.h"

#include "base/cache_file.h"
#include "editor/app/popups.h"
#include "editor/app/property_tables.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/field.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace weft::editor {
namespace {

constexpr float tile_width = 168, tile_ratio = 150.0f / 240;

}  // namespace

void Gallery::start() {
    scenes_ = gallery();
    images_.resize(scenes_.size(), UiImage::none);
    std::vector<std::filesystem::path> files;
    for (const GalleryScene& scene : scenes_) files.push_back(scene.file);
    const std::filesystem::path cache = cache_folder();
    thumbnails_ = std::make_unique<Thumbnails>(
        std::move(files), Thumbnails::Options{.folder = cache.empty() ? cache : cache / "thumbnails"});
}

/// An image with the name of the scene below it. Whether it was pressed.
bool Gallery::tile(Ui& ui, std::size_t scene, float width) const {
    const Theme& theme = ui.theme();
    const GalleryScene& one = scenes_[scene];
    const float pad = theme.px(4), high = std::round((width - 2 * pad) * tile_ratio);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, high + ImGui::GetFontSize() + 3 * pad);
    const bool pressed = area_button(ui, one.file.stem().string(), size, one.name, one.file.string());
    const ImRect frame(ImVec2(corner.x + pad, corner.y + pad), ImVec2(corner.x + width - pad, corner.y + pad + high));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const bool is_visible = ImGui::IsRectVisible(frame.Min, frame.Max);
    if (is_visible && images_[scene] != UiImage::none) {
        draw.AddImage(texture_id(images_[scene]), frame.Min, frame.Max);
    } else if (is_visible) {
        draw.AddRectFilled(frame.Min, frame.Max, theme.color(theme.colors.background), theme.px(3));
        draw_icon(theme, Icon::cloth, frame, theme.color(theme.colors.muted));
    }
    const ImRect text(ImVec2(frame.Min.x, frame.Max.y + pad), ImVec2(frame.Max.x, corner.y + size.y - pad));
    clipped_text(text, one.name, theme.color(theme.colors.text));
    constexpr const char* states[] = {"waiting", "rendering", "ready", "failed"};
    ui.note(one.file.stem().string() + ".image", frame, states[static_cast<std::size_t>(thumbnails_->state(scene))]);
    return pressed;
}

std::optional<std::filesystem::path> Gallery::show(Ui& ui, UiRenderer& renderer, bool& open) {
    if (!thumbnails_) start();
    if (thumbnails_->update()) ui.redraw_in(0.1);
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
        if (images_[i] != UiImage::none || thumbnails_->state(i) != Thumbnails::State::ready) continue;
        images_[i] = renderer.add_image();
        (void)renderer.update(images_[i], thumbnails_->image(i));  // without it the tile is empty
        ui.redraw();
    }
    std::optional<std::filesystem::path> chosen;
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "gallery", "Gallery", ImVec2(theme.px(780), theme.px(560)));
    const float least = theme.px(tile_width) * tile_ratio;
    const float height = ImGui::GetContentRegionAvail().y - ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("scenes", ImVec2(0, std::max(height, least)), false);
    const float gap = ImGui::GetStyle().ItemSpacing.x, room = ImGui::GetContentRegionAvail().x;
    const int columns = std::max(1, static_cast<int>((room + gap) / (theme.px(tile_width) + gap)));
    const float width = std::floor((room - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
    int column = 0;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
        const bool first_of_group = i > 0 && scenes_[i].group != scenes_[i - 1].group;
        if (first_of_group) {
            ImGui::Dummy(ImVec2(0, theme.px(4)));
            ImGui::PushFont(theme.strong);
            ImGui::TextUnformatted(label_of_key(scenes_[i].group).c_str());
            ImGui::PopFont();
            column = 0;
        }
        if (column++ % columns != 0) ImGui::SameLine();
        if (tile(ui, i, width)) chosen = scenes_[i].file;
    }
    ImGui::EndChild();
    if (button(ui, "close", {.text = "Close"}) || chosen) open = false;
    return chosen;
}

}  // namespace weft::editor
