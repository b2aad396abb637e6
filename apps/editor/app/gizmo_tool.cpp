#include "editor/app/gizmo_tool.h"

#include "editor/app/objects.h"
#include "editor/app/property_tables.h"
#include "editor/ui/expression.h"
#include "editor/ui/widgets/field.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace weft::editor {
namespace {

bool is_within(GizmoHandle handle, GizmoHandle first, GizmoHandle last) {
    return handle >= first && handle <= last;
}

/// Along which axes the handle changes something: 0 is x.
std::vector<std::size_t> axes_of(GizmoHandle handle) {
    const auto since = [&](GizmoHandle first) {
        return static_cast<std::size_t>(handle) - static_cast<std::size_t>(first);
    };
    if (is_within(handle, GizmoHandle::move_x, GizmoHandle::move_z)) return {since(GizmoHandle::move_x)};
    if (is_within(handle, GizmoHandle::scale_x, GizmoHandle::scale_z)) return {since(GizmoHandle::scale_x)};
    if (is_within(handle, GizmoHandle::move_yz, GizmoHandle::move_xy)) {
        const std::size_t normal = since(GizmoHandle::move_yz);
        return {(normal + 1) % 3, (normal + 2) % 3};
    }
    if (handle == GizmoHandle::move_view) return {0, 1, 2};
    return {0};
}

std::string_view unit_of(GizmoHandle handle) {
    if (is_within(handle, GizmoHandle::move_x, GizmoHandle::move_view)) return "m";
    if (is_within(handle, GizmoHandle::turn_x, GizmoHandle::turn_view)) return "°";
    return "";
}

float part(Vec3 v, std::size_t axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec3 vector_in(const Document& document, const std::string& place) {
    const Json* value = find(document.json, place);
    if (!value || !value->is_array() || value->size() != 3) return {};
    return {(*value)[0].get<float>(), (*value)[1].get<float>(), (*value)[2].get<float>()};
}

/// With as many digits as a drag resolves.
Json stepped(Vec3 v, float step) {
    const auto one = [&](float x) { return number(std::round(x / step) * step); };
    return {one(v.x), one(v.y), one(v.z)};
}

/// Whether a number can begin with it.
bool begins_number(char32_t c) {
    return (c >= U'0' && c <= U'9') || c == U'.' || c == U',' || c == U'-' || c == U'+' || c == U'(' || c == U'\u2212';
}

void append_utf8(std::string& text, char32_t c) {
    if (c < 0x80) {
        text += static_cast<char>(c);
    } else if (c < 0x800) {
        text += static_cast<char>(0xC0 | (c >> 6));
        text += static_cast<char>(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        text += static_cast<char>(0xE0 | (c >> 12));
        text += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
        text += static_cast<char>(0x80 | (c & 0x3F));
    }
}

constexpr std::size_t longest_text = 60;

}  // namespace

std::vector<double> typed_numbers(const std::string& text, std::string_view unit, std::size_t count) {
    const char separator = text.find(';') != std::string::npos ? ';' : ',';
    std::vector<double> numbers;
    for (std::size_t from = 0; from <= text.size() && numbers.size() < count;) {
        const std::size_t end = count == 1 ? text.size() : std::min(text.find(separator, from), text.size());
        const auto value = evaluate(text.substr(from, end - from), unit);
        if (!value || !std::isfinite(*value)) return {};
        numbers.push_back(*value);
        from = end + 1;
        if (numbers.size() == count && end < text.size()) return {};
    }
    if (numbers.size() != count) numbers.clear();
    return numbers;
}

std::optional<GizmoPlace> GizmoTool::place_of_selected(const Session& session) const {
    if (!is_object(session.selected()) || session.selected().starts_with("/stitches")) return {};
    const std::string transform = session.selected() + "/transform";
    return GizmoPlace{vector_in(*session.document(), transform + "/position"),
                      vector_in(*session.document(), transform + "/rotation")};
}

std::optional<Gizmo> GizmoTool::handles(const Session& session, const Projection& view) const {
    const auto place = place_of_selected(session);
    if (!kind || !place) return {};
    return Gizmo(view, *place, *kind, axes);
}

GizmoChange GizmoTool::unchanged() const {
    return drag_->by(is_within(drag_->handle(), GizmoHandle::scale_x, GizmoHandle::scale_all) ? Vec3{1, 1, 1} : Vec3{});
}

void GizmoTool::start(const Gizmo& gizmo, GizmoHandle handle, Vec2 pointer, Session& session, bool held) {
    drag_ = gizmo.start_drag(handle, pointer);
    if (!drag_) return;
    gizmo_ = gizmo;
    place_ = session.selected();
    drag_place_ = drag_->start();
    held_ = held;
    pointer_ = pointer;
    text_.clear();
    touched_ = false;
    shown_ = unchanged();
}

bool GizmoTool::press(Session& session, const Projection& view, Vec2 pointer) {
    finish(session);
    const auto gizmo = handles(session, view);
    if (!gizmo) return false;
    const GizmoHandle handle = gizmo->handle_at(pointer);
    if (handle != GizmoHandle::none) start(*gizmo, handle, pointer, session, true);
    return active();
}

void GizmoTool::move(Session& session, Vec2 pointer, bool snap) {
    if (!dragged()) return;
    pointer_ = pointer, snap_ = snap;
    if (text_.empty())
        change(session, drag_->at(pointer, snap ? GizmoSnap{} : GizmoSnap{0, 0, 0}), Change::in_progress);
}

void GizmoTool::release(Session& session, Vec2 pointer, bool snap, bool clicked) {
    if (!dragged()) return;
    held_ = false;
    if (!text_.empty()) return;
    if (clicked) {
        if (touched_) change(session, unchanged(), Change::in_progress);
        return;
    }
    change(session, drag_->at(pointer, snap ? GizmoSnap{} : GizmoSnap{0, 0, 0}), Change::in_progress);
    finish(session);
}

bool GizmoTool::cancel(Session& session) {
    if (!drag_) return false;
    drag_.reset();
    text_.clear();
    session.change("", {}, Change::cancelled);
    return true;
}

void GizmoTool::finish(Session& session) {
    if (!drag_) return;
    if (touched_ && session.selected() == place_) change(session, shown_, Change::finished);
    drag_.reset();
    text_.clear();
}

void GizmoTool::choose(Session& session, const Projection& view) {
    finish(session);
    const auto gizmo = handles(session, view);
    const auto place = place_of_selected(session);
    if (!gizmo || !place) return;
    const auto center = view.project(place->position);
    if (!center) return session.say("The object is behind the eye: show it with F.");
    const GizmoHandle first = *kind == GizmoKind::move   ? GizmoHandle::move_x
                              : *kind == GizmoKind::turn ? GizmoHandle::turn_x
                                                         : GizmoHandle::scale_x;
    start(*gizmo, first, center->pixel, session, false);
}

bool GizmoTool::type(const Ui& ui, Session& session) {
    if (!drag_) return false;
    bool used = false;
    const std::string before = text_;
    if (text_.empty() && !ui.input().modifiers().control) {
        const GizmoHandle first = *kind == GizmoKind::move   ? GizmoHandle::move_x
                                  : *kind == GizmoKind::turn ? GizmoHandle::turn_x
                                                             : GizmoHandle::scale_x;
        for (const auto& [key, axis] : {std::pair{Key::x, 0}, {Key::y, 1}, {Key::z, 2}}) {
            if (held_ || !ui.pressed(key)) continue;
            const auto handle = static_cast<GizmoHandle>(static_cast<int>(first) + axis);
            start(Gizmo(*gizmo_), handle, pointer_, session, false);
            used = true;
        }
    }
    for (const char32_t c : ui.input().text) {
        if ((text_.empty() && !begins_number(c)) || c < U' ' || text_.size() > longest_text) continue;
        append_utf8(text_, c);
    }
    if (ui.pressed(Key::backspace, true) && !text_.empty()) {
        while (text_.size() > 1 && (static_cast<unsigned char>(text_.back()) & 0xC0) == 0x80) text_.pop_back();
        text_.pop_back();
    }
    if (text_ != before) {
        follow_text(session);
        used = true;
    }
    if (ui.pressed(Key::enter) || ui.pressed(Key::pad_enter)) {
        if (text_.empty() || understood_) finish(session);
        used = true;
    }
    return used || !text_.empty();
}

void GizmoTool::follow_text(Session& session) {
    if (text_.empty()) {
        change(session, held_ ? drag_->at(pointer_, snap_ ? GizmoSnap{} : GizmoSnap{0, 0, 0}) : unchanged(),
               Change::in_progress);
        return;
    }
    const std::vector<std::size_t> along = axes_of(drag_->handle());
    const std::vector<double> numbers = typed_numbers(text_, unit_of(drag_->handle()), along.size());
    understood_ = !numbers.empty();
    if (!understood_) return;
    const bool scales = is_within(drag_->handle(), GizmoHandle::scale_x, GizmoHandle::scale_all);
    float amount[3] = {0, 0, 0};
    if (scales) std::fill_n(amount, 3, 1.0f);
    for (std::size_t i = 0; i < along.size(); ++i) amount[along[i]] = static_cast<float>(numbers[i]);
    if (drag_->handle() == GizmoHandle::scale_all) std::fill_n(amount, 3, static_cast<float>(numbers[0]));
    change(session, drag_->by({amount[0], amount[1], amount[2]}), Change::in_progress);
}

// Scaling changes the values that give the object its size.
void GizmoTool::add_scales(const Session& session, const GizmoChange& change, std::vector<Edit>& edits) const {
    const Vec3 by{change.scale.x / shown_.scale.x, change.scale.y / shown_.scale.y, change.scale.z / shown_.scale.z};
    for (const auto& [key, count] : {std::pair{"/sphere/radius", 1},
                                     {"/capsule/radius", 1},
                                     {"/capsule/half_height", 1},
                                     {"/box/half_extents", 3},
                                     {"/mesh/scale", 1},
                                     {"/mesh/grid/size", 2}}) {
        const std::string whole = place_ + key;
        const std::string owner = whole.substr(0, whole.rfind('/'));
        if (!find(session.document()->json, owner)) continue;
        if (std::string_view(key) == "/mesh/scale" && !find(session.document()->json, place_ + "/mesh/file")) continue;
        for (const Property& property : properties_of(*session.document(), owner).values) {
            if (property.key() != std::string_view(key).substr(std::string_view(key).rfind('/') + 1)) continue;
            Json value = *value_of(*session.document(), owner, property);
            const float factors[3] = {by.x, count == 2 ? by.z : by.y, by.z};
            if (value.is_array())
                for (std::size_t i = 0; i < value.size() && i < 3; ++i)
                    value[i] = number(std::max(1e-4f, value[i].get<float>() * factors[i]));
            else
                value = number(std::max(1e-4f, value.get<float>() * std::cbrt(by.x * by.y * by.z)));
            edits.push_back({whole, value});
        }
    }
}

void GizmoTool::change(Session& session, const GizmoChange& change, Change phase) {
    std::vector<Edit> edits;
    const std::string transform = place_ + "/transform";
    const GizmoHandle handle = drag_->handle();
    const bool moves = is_within(handle, GizmoHandle::move_x, GizmoHandle::move_view);
    const bool turns = is_within(handle, GizmoHandle::turn_x, GizmoHandle::turn_view);
    if (moves)
        edits.push_back({transform + "/position", stepped(change.place.position, 1e-4f)});
    else if (turns)
        edits.push_back({transform + "/rotation", stepped(change.place.rotation_degrees, 0.01f)});
    else
        add_scales(session, change, edits);
    shown_ = change;
    touched_ = true;
    const char* what = moves ? "Move " : turns ? "Turn " : "Scale ";
    session.change(what + describe_object(*session.document(), place_), std::move(edits), phase);
}

// --- Drawing

std::string GizmoTool::label() const {
    constexpr const char* letters[] = {"x", "y", "z"};
    const GizmoHandle handle = drag_->handle();
    const std::string_view unit = unit_of(handle);
    const bool scales = is_within(handle, GizmoHandle::scale_x, GizmoHandle::scale_all);
    std::string axis, numbers;
    for (const std::size_t i : axes_of(handle)) {
        const bool about = is_within(handle, GizmoHandle::turn_x, GizmoHandle::turn_z);
        const std::size_t letter =
            about ? static_cast<std::size_t>(handle) - static_cast<std::size_t>(GizmoHandle::turn_x) : i;
        const bool named = handle != GizmoHandle::turn_view && handle != GizmoHandle::scale_all;
        if (named) axis += (axis.empty() ? "" : ", ") + std::string(letters[letter]);
        const float value = scales ? part(shown_.scale, i) : part(shown_.amount, i);
        numbers += (numbers.empty() ? "" : ", ") + format_number(static_cast<double>(value), 4);
    }
    std::string line = axis + (axis.empty() ? "" : "  ") + (scales ? "× " : "");
    if (!text_.empty()) return line + text_ + "|" + (understood_ || unit.empty() ? "" : " ?");
    line += numbers + (unit == "m" ? " m" : std::string(unit));
    if (!held_) line += "   type an amount";
    return line;
}

void GizmoTool::draw_label(Ui& ui, ImVec2 at) const {
    const Theme& theme = ui.theme();
    const std::string text = label();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = theme.px(6);
    // Within the view, so that it can be read wherever the object goes.
    const ImVec2 corner = ImGui::GetWindowPos(), all = ImGui::GetWindowSize();
    at.x = std::clamp(at.x, corner.x + pad, corner.x + std::max(pad, all.x - size.x - pad));
    at.y = std::clamp(at.y, corner.y + pad, corner.y + std::max(pad, all.y - size.y - pad));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(ImVec2(at.x - pad, at.y - pad / 2), ImVec2(at.x + size.x + pad, at.y + size.y + pad / 2),
                       IM_COL32(20, 22, 26, 215), pad / 2);
    const bool wrong = !text_.empty() && !understood_;
    draw.AddText(at, wrong ? IM_COL32(255, 160, 140, 255) : IM_COL32(255, 240, 180, 255), text.c_str());
    ui.note("amount", ImRect(at, ImVec2(at.x + size.x, at.y + size.y)), text);
}

void GizmoTool::draw(Ui& ui, const Session& session, const Projection& view, Vec2 origin, std::optional<Vec2> pointer) {
    const auto gizmo = handles(session, view);
    const auto place = place_of_selected(session);
    // Another object or tool, or an undo, ends the wait for a number.
    const bool same = gizmo && session.selected() == place_ && (held_ || touched_ || place == drag_place_);
    if (drag_ && !same) drag_.reset(), text_.clear();
    if (!gizmo) return;
    const Theme& theme = ui.theme();
    GizmoHandle highlighted = drag_ ? drag_->handle() : GizmoHandle::none;
    if (!drag_ && pointer) highlighted = gizmo->handle_at(*pointer);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    constexpr ImU32 colors[] = {IM_COL32(230, 72, 72, 255), IM_COL32(96, 190, 80, 255), IM_COL32(80, 140, 245, 255),
                                IM_COL32(240, 240, 240, 255)};
    constexpr const char* letters[] = {"x", "y", "z"};
    for (const GizmoShape& shape : gizmo->shapes(highlighted)) {
        std::vector<ImVec2> points;
        for (const Vec2 p : shape.points) points.emplace_back(origin.x + p.x, origin.y + p.y);
        ImU32 color = colors[shape.axis];
        if (shape.faint) color = (color & 0x00FFFFFF) | 0x50000000;
        const float width = theme.px(shape.highlighted ? 4 : 2.5f);
        if (shape.filled)
            draw.AddConvexPolyFilled(points.data(), static_cast<int>(points.size()), color);
        else
            draw.AddPolyline(points.data(), static_cast<int>(points.size()), color,
                             shape.closed ? ImDrawFlags_Closed : ImDrawFlags_None, width);
        // The axes have letters, so that they are not told by color alone.
        const bool arrow = is_within(shape.handle, GizmoHandle::move_x, GizmoHandle::move_z);
        if (arrow && !shape.filled && shape.axis < 3 && !points.empty())
            draw.AddText(ImVec2(points.back().x + theme.px(8), points.back().y - theme.px(8)), color,
                         letters[shape.axis]);
    }
    // A place on each handle, for tests that drag it.
    constexpr std::pair<GizmoHandle, const char*> named[] = {
        {GizmoHandle::move_x, "move_x"},       {GizmoHandle::move_y, "move_y"},   {GizmoHandle::move_z, "move_z"},
        {GizmoHandle::move_yz, "move_yz"},     {GizmoHandle::move_zx, "move_zx"}, {GizmoHandle::move_xy, "move_xy"},
        {GizmoHandle::turn_x, "turn_x"},       {GizmoHandle::turn_y, "turn_y"},   {GizmoHandle::turn_z, "turn_z"},
        {GizmoHandle::scale_x, "scale_x"},     {GizmoHandle::scale_y, "scale_y"}, {GizmoHandle::scale_z, "scale_z"},
        {GizmoHandle::scale_all, "scale_all"},
    };
    const Ui::Scope scope(ui, "gizmo");
    const auto note = [&](const char* name, Vec2 p) {
        const ImVec2 at(origin.x + p.x, origin.y + p.y);
        ui.note(name, ImRect(at, ImVec2(at.x + 1, at.y + 1)));
    };
    const auto center = view.project(place->position);
    if (center) note("center", center->pixel);
    for (const auto& [handle, name] : named) {
        const bool line = is_within(handle, GizmoHandle::turn_x, GizmoHandle::turn_z);
        for (const GizmoShape& shape : gizmo->shapes(GizmoHandle::none)) {
            if (shape.handle != handle || shape.faint || shape.filled == line) continue;
            // The tip of an arrow, the middle of a square, a point beside the middle of a ring's near half.
            const std::vector<Vec2>& p = shape.points;
            if (p.size() == 4)
                note(name, {(p[0].x + p[1].x + p[2].x + p[3].x) / 4, (p[0].y + p[1].y + p[2].y + p[3].y) / 4});
            else
                note(name, line ? p[p.size() * 2 / 3] : p.front());
        }
    }
    if (!drag_) return;
    const Vec2 at = held_ && pointer ? *pointer : center ? center->pixel : Vec2{view.size().x / 2, view.size().y};
    draw_label(ui, ImVec2(origin.x + at.x + theme.px(18), origin.y + at.y + theme.px(14)));
}

}  // namespace weft::editor
