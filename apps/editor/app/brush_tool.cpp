#include "editor/app/brush_tool.h"

#include "editor/app/vertex_selector.h"
#include "editor/ui/expression.h"
#include "weft/cloth_building.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::editor {
namespace {

constexpr float part_of_cloth = 0.08f, least_radius = 1e-4f, most_radius = 1e4f;

/// A circle on the surface, in pixels; empty where it is behind the eye.
std::vector<ImVec2> ring(const ViewCanvas& canvas, Vec3 center, Vec3 normal, float radius) {
    const Vec3 x = normalized(cross(std::abs(normal.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, normal));
    const Vec3 y = cross(normal, x);
    constexpr int corners = 48;
    std::vector<ImVec2> points;
    for (int i = 0; i < corners; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / corners;
        const auto p = canvas.at(center + (x * std::cos(angle) + y * std::sin(angle)) * radius);
        if (!p) return {};
        points.push_back(*p);
    }
    return points;
}

void draw_ring(const ViewCanvas& canvas, const std::vector<ImVec2>& points, float width) {
    const int count = static_cast<int>(points.size());
    canvas.draw.AddPolyline(points.data(), count, IM_COL32(20, 20, 20, 220), ImDrawFlags_Closed,
                            canvas.theme.px(width + 2));
    canvas.draw.AddPolyline(points.data(), count, IM_COL32(255, 255, 255, 255), ImDrawFlags_Closed,
                            canvas.theme.px(width));
}

std::string text_of_value(const PaintKind& kind, float value) {
    if (kind.on_off) return std::string(value >= 0.5f ? kind.scale_high : kind.scale_low);
    return format_number(static_cast<double>(value), 2);
}

}  // namespace

BrushTool::BrushTool() {
    for (const PaintKind& one : paint_kinds()) options.values.push_back(one.usual);
}

void BrushTool::scale_radius(float by) {
    options.radius = std::clamp(options.radius * by, least_radius, most_radius);
}

void BrushTool::work_on(const Picture& picture, std::size_t cloth) {
    const std::string name = PickTrees::name_of_cloth(picture, cloth);
    if (target_ && target_->name == name && target_->cloth.numbers == picture.numbers[cloth]) return;
    target_.emplace(Target{name, vertices_of(picture, cloth), nullptr, {}});
    target_->distance = std::make_unique<SurfaceDistance>(target_->cloth.mesh());
    if (options.radius > 0) return;
    // Two digits.
    const float radius = std::clamp(part_of_cloth * picture.world->model(cloth)->extent, least_radius, most_radius);
    const float unit = std::pow(10.0f, std::floor(std::log10(radius)) - 1);
    options.radius = std::round(radius / unit) * unit;
}

PaintTarget BrushTool::target_in(const Session& session, const Picture& picture, std::size_t cloth) const {
    return {*session.document(), place_of_cloth(*session.document(), target_->name), target_->cloth,
            picture.world->frame().cloths[cloth], options.group};
}

BrushSettings BrushTool::settings(const Modifiers& keys) const {
    const PaintKind& one = kind();
    PaintMode mode = options.mode;
    if (one.on_off && mode != PaintMode::erase && mode != PaintMode::subtract) mode = PaintMode::paint;
    if (keys.control) mode = mode == PaintMode::erase ? PaintMode::paint : PaintMode::erase;
    if (keys.shift && !one.on_off) mode = PaintMode::smooth;
    BrushSettings settings{.mode = BrushMode::set,
                           .radius = options.radius,
                           .strength = one.on_off ? 1 : options.strength,
                           .value = options.values[options.kind],
                           .min = one.least,
                           .max = one.most};
    if (one.on_off) settings.value = 1;
    const bool erases = mode == PaintMode::erase || (one.on_off && mode == PaintMode::subtract);
    if (erases)
        settings.value = one.neutral;
    else if (mode == PaintMode::add)
        settings.mode = BrushMode::add;
    else if (mode == PaintMode::subtract)
        settings.mode = BrushMode::subtract;
    else if (mode == PaintMode::smooth)
        settings.mode = BrushMode::smooth;
    return settings;
}

std::optional<MeshPlace> BrushTool::mirrored(const MeshPlace& place) {
    if (!options.mirror) return {};
    auto& mirror = target_->mirrors[static_cast<std::size_t>(*options.mirror)];
    if (!mirror) mirror = std::make_unique<RestMirror>(target_->cloth.rest, target_->cloth.triangles, *options.mirror);
    return mirror->of(place, options.radius / 2);
}

bool BrushTool::begin(const ToolInput& in) {
    const Pick pick = in.pick_at(in.input.pointer);
    if (pick.kind != PickKind::cloth) return false;
    work_on(in.picture, pick.index);
    const PaintTarget target = target_in(in.session, in.picture, pick.index);
    if (target.place.empty()) return false;
    in.session.select(target.place);
    stroke_.emplace(settings(in.input.modifiers), kind().read(target));
    // Dabs overlap, so that the stroke has straight sides.
    const double pixels = in.input.view.pixels_per_meter(static_cast<double>(pick.distance));
    sampler_.emplace(std::max(2.0, pixels * static_cast<double>(options.radius) / 4));
    drag(in);
    return true;
}

void BrushTool::drag(const ToolInput& in) {
    if (!stroke_) return;
    const PickScene scene = in.trees.scene(in.picture, in.marks);
    for (const Vec2 point : sampler_->add(in.input.pointer)) {
        const Pick pick = pick_at(in.input.view, point, scene);
        if (pick.kind != PickKind::cloth || PickTrees::name_of_cloth(in.picture, pick.index) != target_->name) continue;
        if (in.picture.numbers[pick.index] != target_->cloth.numbers) return cancel();  // it has been built again
        dab(in, pick);
    }
}

void BrushTool::dab(const ToolInput&, const Pick& pick) {
    const MeshPlace place{pick.triangle, pick.weights};
    stroke_->dab(
        brush_weights(*target_->distance, target_->cloth.mesh(), place, options.radius, mirrored(place), fall_off()),
        *target_->distance);
    ++dabs_;
}

void BrushTool::end(const ToolInput& in) {
    if (!stroke_) return;
    const BrushStroke stroke = std::move(*stroke_);
    cancel();
    const auto cloth = cloth_called(in.picture, target_->name);
    if (!cloth || stroke.changed().empty()) return;
    const PaintTarget target = target_in(in.session, in.picture, *cloth);
    if (target.place.empty()) return;
    std::vector<Edit> edits, prepared;
    if (kind().prepare) edits = prepared = kind().prepare(target);
    const std::vector<Edit> painted = kind().write(target, stroke.values(), stroke.changed());
    edits.insert(edits.end(), painted.begin(), painted.end());
    std::string what(kind().label);
    if (kind().name == "group") what += " " + options.group;
    const bool goes_on = gets_room_while_it_moves(described(target), *target.frame.model);
    in.session.change("Paint " + what + " of " + target_->name, std::move(edits));
    if (!prepared.empty())
        in.session.say(target_->name + (goes_on ? " can tear now." : " can tear now. It starts again."));
}

void BrushTool::cancel() {
    stroke_.reset();
    sampler_.reset();
    ++dabs_;
}

std::shared_ptr<const ClothPaint> BrushTool::colors(const Session& session, const Picture& picture) {
    auto cloth = cloth_called(picture, session.selected().starts_with("/cloths/") ? session.selected_name()
                                       : target_                                  ? target_->name
                                                                                  : "");
    if (!cloth && picture.world->cloth_count() == 1) cloth = 0;
    if (!cloth) return nullptr;
    if (!stroke_) work_on(picture, *cloth);
    const PaintTarget target = target_in(session, picture, *cloth);
    if (target.place.empty() || target_->name != PickTrees::name_of_cloth(picture, *cloth)) return nullptr;
    const Shown now{session.document(), picture.world->model(*cloth), options.group, options.kind, dabs_};
    if (colors_ && shown_ == now) return colors_;
    shown_ = now;
    values_ = stroke_ ? stroke_->values() : kind().read(target);
    colors_ = std::make_shared<const ClothPaint>(colors_of(kind(), target_->name, values_));
    return colors_;
}

void BrushTool::draw(Ui& ui, const ViewCanvas& canvas, const ToolInput& in) {
    if (!in.input.hovered) return;
    const Pick pick = in.pick_at(in.input.pointer);
    const ImVec2 at = canvas.at(in.input.pointer);
    if (pick.kind != PickKind::cloth || !(options.radius > 0)) {
        canvas.draw.AddCircle(at, canvas.theme.px(6), IM_COL32(255, 255, 255, 140), 0, canvas.theme.px(1.5f));
        return;
    }
    draw_ring(canvas, ring(canvas, pick.point, pick.normal, options.radius), 1.5f);
    std::string value;
    if (target_ && PickTrees::name_of_cloth(in.picture, pick.index) == target_->name) {
        const MeshPlace place{pick.triangle, pick.weights};
        const MeshView now = PickTrees::mesh_of_cloth(in.picture, pick.index);
        if (const auto other = mirrored(place); other && other->triangle < now.triangles()) {
            const auto [a, b, c] = now.triangle(other->triangle);
            const Vec3 normal = cross(now.position(b) - now.position(a), now.position(c) - now.position(a));
            if (dot(normal, normal) > 0)
                draw_ring(canvas, ring(canvas, point_of(now, *other), normalized(normal), options.radius), 0.5f);
        }
        const ClothFrame& frame = in.picture.world->frame().cloths[pick.index];
        const std::uint32_t particle = original_of(frame, *target_->cloth.numbers, pick.vertex);
        if (particle < values_.size()) value = text_of_value(kind(), values_[particle]);
    }
    if (value.empty()) return;
    const ImVec2 text(at.x + canvas.theme.px(16), at.y + canvas.theme.px(12)),
        size = ImGui::CalcTextSize(value.c_str());
    const float pad = canvas.theme.px(4);
    canvas.draw.AddRectFilled(ImVec2(text.x - pad, text.y - pad / 2),
                              ImVec2(text.x + size.x + pad, text.y + size.y + pad / 2), IM_COL32(20, 22, 26, 200), pad);
    canvas.draw.AddText(text, IM_COL32(255, 255, 255, 255), value.c_str());
    ui.note("brush", ImRect(at, ImVec2(at.x + 1, at.y + 1)), value);
}

}  // namespace weft::editor
