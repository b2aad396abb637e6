#include "editor/app/view_panel.h"

#include "editor/app/objects.h"
#include "editor/tools/stroke_cut.h"
#include "solver/world/collider_mesh.h"
#include "view/framing.h"
#include "weft/cloth_building.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::editor {
namespace {

constexpr float click_way = 4;  // pixels: a press that moves less is a click

const Picture* picture_of(const Session& session) {
    return static_cast<const Picture*>(session.now().picture.get());
}

bool was_pressed(int button) {
    return ImGui::IsMouseClicked(button);
}

Vec3 vector_at(const Document& document, const std::string& place, Vec3 otherwise) {
    const Json* value = find(document.json, place);
    if (!value || !value->is_array() || value->size() != 3) return otherwise;
    return {(*value)[0].get<float>(), (*value)[1].get<float>(), (*value)[2].get<float>()};
}

Json json_of(Vec3 v) {
    return {number(v.x), number(v.y), number(v.z)};
}

/// Digits that a drag in the view resolves.
float rounded(float value, float step) {
    return std::round(value / step) * step;
}
Vec3 rounded(Vec3 v, float step) {
    return {rounded(v.x, step), rounded(v.y, step), rounded(v.z, step)};
}

std::string place_of_named(const Document& document, const char* list, const std::string& name) {
    const Json* all = find(document.json, list);
    for (std::size_t i = 0; all && i < all->size(); ++i)
        if ((*all)[i].value("name", "") == name) return std::string(list) + "/" + std::to_string(i);
    return {};
}

std::string place_of_pick(const Session& session, const Pick& pick) {
    const Picture* picture = picture_of(session);
    if (pick.kind == PickKind::cloth)
        return place_of_named(*session.document(), "/cloths", PickTrees::name_of_cloth(*picture, pick.index));
    if (pick.kind == PickKind::collider)
        return place_of_named(*session.document(), "/colliders", PickTrees::name_of_collider(*picture, pick.index));
    return {};
}

}  // namespace

std::string_view name_of(Tool tool) {
    constexpr std::string_view names[] = {"hand", "select", "move",  "turn",   "scale",
                                          "cut",  "lasso",  "brush", "anchors"};
    return names[static_cast<std::size_t>(tool)];
}

void ViewPanel::show(Ui& ui, Session& session, const ViewMarks& marks, UiImage image, Vec2 image_size) {
    const ImVec2 room = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorScreenPos();
    origin_ = {corner.x, corner.y};
    size_ = {std::max(1.0f, room.x), std::max(1.0f, room.y)};
    const Item item = ui.place("view", room);
    if (image != UiImage::none && image_size.x > 0)
        ImGui::GetWindowDrawList()->AddImage(texture_id(image), item.box.Min, item.box.Max);
    const ImGuiIO& io = ImGui::GetIO();
    bool hovered = false, held = false;
    ImGui::ButtonBehavior(item.box, item.id, &hovered, &held,
                          ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                              ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_PressedOnClick);
    ui.release_space();
    const double now = ui.now();
    if (transition_) {
        const auto seconds = static_cast<float>(now - transition_since_);
        camera = transition_->at(seconds);
        if (transition_->done(seconds))
            transition_.reset();
        else
            ui.redraw();
    }
    Input input{.pointer = {io.MousePos.x - origin_.x, io.MousePos.y - origin_.y},
                .moved = {io.MouseDelta.x, io.MouseDelta.y},
                .hovered = hovered,
                .wheel = hovered ? io.MouseWheel : 0,
                .modifiers = ui.input().modifiers(),
                .view = Projection(camera, size_)};
    moving_ = transition_.has_value();
    set_gizmo();
    if (picture_of(session)) {
        if (hovered && gesture_ == Gesture::none) {
            const bool orbit = input.modifiers.alt;
            start_ = input.pointer;
            clicked_ = true;
            if (was_pressed(0))
                orbit ? (void)(gesture_ = Gesture::orbit) : begin_left(session, marks, input);
            else if (was_pressed(1))
                gesture_ = Gesture::look;
            else if (was_pressed(2))
                gesture_ = input.modifiers.shift ? Gesture::orbit : Gesture::pan;
        }
        if (length(Vec3{input.pointer.x - start_.x, input.pointer.y - start_.y, 0}) > click_way) clicked_ = false;
        move_camera(ui, *picture_of(session), marks, input);
        if (gesture_ != Gesture::none && !io.MouseDown[0] && !io.MouseDown[1] && !io.MouseDown[2]) {
            end(session, marks, input);
            gesture_ = Gesture::none;
        } else {
            drag(session, input);
            if (gesture_ == Gesture::paint) brush.drag({session, *picture_of(session), trees_, marks, input});
        }
        draw_marks(ui, session, input);
        draw_touch(ui, session, marks, input);
        std::optional<Vec2> over;
        if (hovered || gesture_ == Gesture::gizmo) over = input.pointer;
        gizmo_.draw(ui, session, input.view, origin_, over);
    }
    moving_ = moving_ || gesture_ != Gesture::none;
    note_camera(ui, item.box);
    last_ = input.pointer;
    time_ = now;
}

void ViewPanel::move_camera(Ui& ui, const Picture& picture, const ViewMarks& marks, const Input& input) {
    const bool moved = input.moved.x != 0 || input.moved.y != 0;
    // Hidden objects are not under the pointer. Locked ones are, because the camera changes none of them.
    const auto under_pointer = [&](Vec2 pointer) -> std::optional<Vec3> {
        const Pick pick = pick_at(input.view, pointer, trees_.scene(picture, {.hidden = marks.hidden, .locked = {}}));
        if (pick.kind == PickKind::nothing) return {};
        return pick.point;
    };
    if (moved && gesture_ == Gesture::orbit) camera = orbited_by(camera, input.moved, size_);
    if (moved && gesture_ == Gesture::look) camera = looked_by(camera, input.moved, size_);
    if (gesture_ != Gesture::pan) {
        pan_depth_.reset();
    } else if (moved) {
        if (const auto point = pan_depth_ ? std::nullopt : under_pointer(start_))
            pan_depth_ = static_cast<double>(input.view.project(*point)->depth);
        camera = panned_by(camera, input.moved, size_, pan_depth_);
    }
    if (input.wheel != 0 && gesture_ == Gesture::none) {
        camera = dollied(camera, input.wheel, input.pointer, size_, under_pointer(input.pointer));
        moving_ = true;
    }
    fly(ui, picture, input);
}

void ViewPanel::fly(Ui& ui, const Picture& picture, const Input& input) {
    // A key that was pressed as part of a shortcut does not fly once Control is let go of.
    for (const InputFrame::Press& press : ui.input().keys)
        if (const Modifiers& with = press.modifiers; !press.repeated)
            fly_keys_[static_cast<std::size_t>(press.key)] = press.down && !with.control && !with.alt && !with.super;
    const bool may = gesture_ == Gesture::look || (settings.fly_always && gesture_ == Gesture::none);
    if (!may || !has_keys || ui.wants_text() || input.modifiers.control || input.modifiers.alt) return;
    FlyInput fly{.map = settings.keys,
                 .held = {},
                 .fast = input.modifiers.shift,
                 .seconds = static_cast<float>(std::clamp(ui.now() - time_, 0.0, 0.1)),
                 .scene_radius = 0};
    for (const auto& [key, letter] :
         {std::pair{Key::w, 'W'}, {Key::a, 'A'}, {Key::s, 'S'}, {Key::d, 'D'}, {Key::q, 'Q'}, {Key::e, 'E'}})
        fly.held[static_cast<std::size_t>(letter)] =
            ui.input().down[static_cast<std::size_t>(key)] && fly_keys_[static_cast<std::size_t>(key)];
    if (!flies(fly)) return;
    fly.scene_radius = subject_of(*picture.world).all.radius;
    camera = flown(camera, fly);
    moving_ = true;
    ui.redraw();
}

// --- Gestures of the left button

void ViewPanel::begin_left(Session& session, const ViewMarks& marks, const Input& input) {
    const Picture& picture = *picture_of(session);
    if (gizmo_.press(session, input.view, input.pointer)) {
        gesture_ = Gesture::gizmo;
        return;
    }
    if (settings.tool == Tool::select) {
        gesture_ = Gesture::box;
        return;
    }
    if (settings.tool == Tool::cut || settings.tool == Tool::lasso) {
        stroke_ = {input.pointer};
        gesture_ = settings.tool == Tool::cut ? Gesture::stroke : Gesture::lasso;
        return;
    }
    if (settings.tool == Tool::brush && brush.begin({session, picture, trees_, marks, input})) {
        gesture_ = Gesture::paint;
        return;
    }
    pick_ = pick_at(input.view, input.pointer, trees_.scene(picture, marks));
    picked_place_ = place_of_pick(session, pick_);
    gesture_ = Gesture::orbit;
    const bool is_plane =
        pick_.kind == PickKind::collider && picture.world->colliders()[pick_.index].shape == ShapeKind::plane;
    if (settings.tool != Tool::hand || pick_.kind == PickKind::nothing || is_plane) return;
    plane_ = grab(input.view, pick_.point, input.pointer);
    if (!plane_) return;
    if (pick_.kind == PickKind::cloth) {
        gesture_ = Gesture::pull;
        session.post(Grab{PickTrees::name_of_cloth(picture, pick_.index),
                          {pick_.triangle, pick_.weights},
                          pick_.point,
                          settings.pull_force});
    } else {
        gesture_ = Gesture::carry;
        carried_from_ = vector_at(*session.document(), picked_place_ + "/transform/position", {});
    }
}

void ViewPanel::drag(Session& session, const Input& input) {
    const bool moved = input.moved.x != 0 || input.moved.y != 0 || input.wheel != 0;
    if ((gesture_ == Gesture::stroke || gesture_ == Gesture::lasso) && moved) stroke_.push_back(input.pointer);
    if (!moved) return;
    if (gesture_ == Gesture::gizmo && !clicked_) gizmo_.move(session, input.pointer, input.modifiers.control);
    if ((gesture_ != Gesture::pull && gesture_ != Gesture::carry) || !plane_) return;
    if (input.wheel != 0) plane_ = pushed(*plane_, input.view, input.wheel);
    const auto to = pulled_to(*plane_, input.view, input.pointer);
    if (!to) return;
    if (gesture_ == Gesture::pull) session.post(MoveGrab{*to});
    if (gesture_ == Gesture::carry && !clicked_) {
        const Vec3 position = rounded(carried_from_ + (*to - pick_.point), 1e-4f);
        session.change("Move " + describe_object(*session.document(), picked_place_),
                       {{picked_place_ + "/transform/position", json_of(position)}}, Change::in_progress);
    }
}

// Gestures that touch vertices. Returns false if it was another one.
bool ViewPanel::end_touch(const ToolInput& in) {
    const bool chooses = gesture_ == Gesture::box || gesture_ == Gesture::lasso;
    if (chooses && clicked_)
        selector.click(in);
    else if (gesture_ == Gesture::box)
        selector.box(in, start_);
    else if (gesture_ == Gesture::lasso)
        selector.lasso(in, stroke_);
    else if (gesture_ == Gesture::paint)
        brush.end(in);
    else if (gesture_ == Gesture::orbit && clicked_ && settings.tool == Tool::anchors)
        anchors.click(in, selector.through);
    else
        return false;
    stroke_.clear();
    return true;
}

void ViewPanel::end(Session& session, const ViewMarks& marks, const Input& input) {
    if (end_touch({session, *picture_of(session), trees_, marks, input})) return;
    switch (gesture_) {
        case Gesture::gizmo:
            return gizmo_.release(session, input.pointer, input.modifiers.control, clicked_);
        case Gesture::pull:
            session.post(Release{});
            break;
        case Gesture::carry:
            if (!clicked_)
                session.change("Move " + describe_object(*session.document(), picked_place_), {}, Change::finished);
            break;
        case Gesture::stroke:
            return cut(session, marks, input);
        case Gesture::box:
        case Gesture::lasso:
        case Gesture::paint:
        case Gesture::orbit:
        case Gesture::look:
        case Gesture::pan:
        case Gesture::none:
            break;
    }
    if (clicked_ && (gesture_ == Gesture::pull || gesture_ == Gesture::carry || gesture_ == Gesture::orbit)) {
        session.select(picked_place_);
        if (gesture_ == Gesture::pull) session.undo();  // a click pulls nothing
    }
}

bool ViewPanel::cancel(Session& session) {
    const Gesture ended = std::exchange(gesture_, Gesture::none);
    if (gizmo_.cancel(session)) return true;
    switch (ended) {
        case Gesture::carry:
            session.change("", {}, Change::cancelled);
            return true;
        case Gesture::pull:
            session.post(Release{});
            session.undo();
            return true;
        case Gesture::paint:
            brush.cancel();
            return true;
        case Gesture::box:
        case Gesture::lasso:
        case Gesture::stroke:
            stroke_.clear();
            return true;
        case Gesture::orbit:
        case Gesture::look:
        case Gesture::pan:
            return true;
        case Gesture::gizmo:
        case Gesture::none:
            break;
    }
    if (settings.tool == Tool::anchors && anchors.discard()) return true;
    if (selector.chosen().empty()) return false;
    selector.choose_none();
    return true;
}

void ViewPanel::cut(Session& session, const ViewMarks& marks, const Input& input) {
    const Picture& picture = *picture_of(session);
    const PickScene scene = trees_.scene(picture, marks);
    int parts = 0;
    for (std::size_t i = 0; i < picture.world->cloth_count(); ++i) {
        const TriangleTree* tree = trees_.tree_of_cloth(i);
        if (!tree) continue;
        const MeshView mesh = PickTrees::mesh_of_cloth(picture, i);
        SurfaceDistance distance(mesh);
        std::vector<PickSurface> others(scene.cloths.begin(), scene.cloths.end());
        others[i] = {};
        const std::string name = PickTrees::name_of_cloth(picture, i);
        const std::string place = place_of_named(*session.document(), "/cloths", name);
        if (place.empty()) continue;
        // On the cloth as it starts. A line from fold to fold leaves the cloth as it is now, and a cloth that cannot be
        // cut yet may start again.
        const CutCloth cloth{mesh, tree, &distance, picture.world->model(i)->start};
        const auto cuts = cuts_of_stroke(input.view, stroke_, cloth, {others, scene.colliders, {}});
        if (cuts.empty()) continue;
        const SceneCloth& described = session.document()->scene.cloths[std::stoul(place.substr(8))];
        if (described.tearing == Tearing::off) {
            const bool goes_on = gets_room_while_it_moves(described, *picture.world->model(i));
            session.change("Let " + name + " be cut", {{place + "/tearing", "cuts"}});
            if (!goes_on) session.say(name + " starts again: its tearing was off.");
        }
        for (const PathCut& path : cuts) session.post(Cut{name, path.points, true});
        parts += static_cast<int>(cuts.size());
    }
    if (parts == 0) session.say("The stroke meets no cloth: draw it across a cloth.");
    stroke_.clear();
}

// --- Vertices

std::optional<std::size_t> ViewPanel::selected_cloth(const Picture& picture, const Session& session) const {
    const std::string name = session.selected_name();
    for (std::size_t i = 0; i < picture.world->cloth_count(); ++i)
        if (session.selected().starts_with("/cloths/") && PickTrees::name_of_cloth(picture, i) == name) return i;
    return {};
}

// --- Gizmo

// A drag goes on with the handles with which it began.
void ViewPanel::set_gizmo() {
    if (gizmo_.dragged()) return;
    gizmo_.axes = settings.axes;
    gizmo_.kind = settings.tool == Tool::move    ? std::optional(GizmoKind::move)
                  : settings.tool == Tool::turn  ? std::optional(GizmoKind::turn)
                  : settings.tool == Tool::scale ? std::optional(GizmoKind::scale)
                                                 : std::nullopt;
}

void ViewPanel::choose_handle(Session& session) {
    if (settings.tool < Tool::move || settings.tool > Tool::scale) settings.tool = Tool::move;
    set_gizmo();
    gizmo_.choose(session, Projection(camera, size_));
    // Enter belongs to the amount and not to what had the keyboard before.
    GImGui->NavDisableHighlight = true;
}

bool ViewPanel::type(const Ui& ui, Session& session) {
    if (!gizmo_.active() || ui.wants_text()) return false;
    const bool used = gizmo_.type(ui, session);
    if (!gizmo_.active()) gesture_ = Gesture::none;  // Enter has ended it
    return used;
}

// --- Marks over the image

void ViewPanel::draw_marks(Ui& ui, const Session& session, const Input& input) {
    const Theme& theme = ui.theme();
    const Picture& picture = *picture_of(session);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const auto at = [&](Vec3 point) -> std::optional<ImVec2> {
        const auto seen = input.view.project(point);
        if (!seen) return {};
        return ImVec2(origin_.x + seen->pixel.x, origin_.y + seen->pixel.y);
    };
    for (const PulledPoint& pull : picture.pulls) {
        const auto from = at(pull.position), to = at(pull.target);
        if (!from || !to) continue;
        draw.AddLine(*from, *to, IM_COL32(20, 20, 20, 200), theme.px(4));
        draw.AddLine(*from, *to, IM_COL32(255, 230, 120, 255), theme.px(2));
        draw.AddCircleFilled(*from, theme.px(4), IM_COL32(255, 230, 120, 255));
        draw.AddCircle(*to, theme.px(6), IM_COL32(255, 230, 120, 255), 0, theme.px(2));
        const std::string force = std::to_string(static_cast<int>(std::lround(length(pull.force) * 100)));
        std::string label = force.size() > 2 ? force.substr(0, force.size() - 2) + "." + force.substr(force.size() - 2)
                                             : "0." + std::string(2 - force.size(), '0') + force;
        label += " N";
        if (length(pull.force) > 0.98f * pull.max_force) label += " (largest)";
        const ImVec2 text = ImGui::CalcTextSize(label.c_str());
        const float margin = theme.px(4);
        const ImVec2 corner(std::clamp(to->x + theme.px(9), origin_.x + margin,
                                       std::max(origin_.x + margin, origin_.x + size_.x - text.x - margin)),
                            std::clamp(to->y - theme.px(17), origin_.y + margin,
                                       std::max(origin_.y + margin, origin_.y + size_.y - text.y - margin)));
        const ImVec2 pad(theme.px(4), theme.px(1));
        draw.AddRectFilled(corner - pad, corner + text + pad, IM_COL32(20, 20, 20, 190), theme.px(4));
        draw.AddText(corner, IM_COL32(255, 240, 180, 255), label.c_str());
        ui.note("pull", ImRect(*from, ImVec2(from->x + 1, from->y + 1)), label);
        ui.note("pull.label", ImRect(corner, corner + text), label);
    }
    if (gesture_ == Gesture::box && !clicked_) {
        const ImVec2 a(origin_.x + start_.x, origin_.y + start_.y),
            b(origin_.x + input.pointer.x, origin_.y + input.pointer.y);
        draw.AddRectFilled(a, b, IM_COL32(255, 200, 80, 40));
        draw.AddRect(a, b, IM_COL32(255, 200, 80, 255));
    }
    if (gesture_ != Gesture::stroke && gesture_ != Gesture::lasso) return;
    std::vector<ImVec2> line;
    for (const Vec2 p : stroke_) line.emplace_back(origin_.x + p.x, origin_.y + p.y);
    const bool closed = gesture_ == Gesture::lasso;
    draw.AddPolyline(line.data(), static_cast<int>(line.size()),
                     closed ? IM_COL32(255, 200, 80, 255) : IM_COL32(255, 80, 80, 255),
                     closed ? ImDrawFlags_Closed : ImDrawFlags_None, theme.px(2));
}

void ViewPanel::draw_touch(Ui& ui, Session& session, const ViewMarks& marks, const Input& input) {
    const Picture& picture = *picture_of(session);
    const ViewCanvas canvas{*ImGui::GetWindowDrawList(), input.view, origin_, ui.theme()};
    const bool chooses = settings.tool == Tool::select || settings.tool == Tool::lasso;
    const bool paints_pins = settings.tool == Tool::brush && brush.kind().name == "pins";
    if (chooses || paints_pins || settings.tool == Tool::anchors || settings.tool == Tool::hand)
        for (std::size_t i = 0; i < picture.world->cloth_count(); ++i)
            if (!marks.hidden.contains(PickTrees::name_of_cloth(picture, i))) draw_pins(canvas, picture, i);
    if (settings.tool != Tool::brush) selector.draw(canvas, picture);
    if (settings.tool == Tool::anchors) anchors.draw(canvas, session, picture);
    if (settings.tool == Tool::brush && (gesture_ == Gesture::none || gesture_ == Gesture::paint))
        brush.draw(ui, canvas, {session, picture, trees_, marks, input});
}

// --- Camera

void ViewPanel::go_to(const Camera& to) {
    transition_ = CameraTransition{camera, to};
    transition_since_ = time_;
}

void ViewPanel::look_from(ViewFrom side) {
    go_to(seen_from(camera, side));
}

// For tests.
void ViewPanel::note_camera(Ui& ui, const ImRect& box) const {
    std::string text;
    for (const float one : {camera.position.x, camera.position.y, camera.position.z, camera.target.x, camera.target.y,
                            camera.target.z, camera.fov})
        text += (text.empty() ? "" : " ") + std::to_string(one);
    ui.note("camera", box, text);
}

void ViewPanel::frame_all(const Picture& picture) {
    const Ball ball = subject_of(*picture.world).all;
    const Vec3 half{ball.radius, ball.radius, ball.radius};
    go_to(framed(camera, {ball.center - half, ball.center + half}, size_));
}

Bounds ViewPanel::bounds_of_selected(const Picture& picture, const Session& session) const {
    Bounds bounds;
    const std::string name = session.selected_name();
    if (const auto cloth = selected_cloth(picture, session))
        for (const Vec4& p : picture.world->frame().cloths[*cloth].positions) bounds.include(p.xyz());
    if (session.selected().starts_with("/colliders/"))
        for (const Collider& collider : picture.world->colliders())
            if (collider.name == name)
                if (const Bounds solid = bounds_of(collider); !solid.empty()) bounds.include(solid);
    return bounds;
}

void ViewPanel::frame_selected(const Picture& picture, const Session& session) {
    const Bounds bounds = bounds_of_selected(picture, session);
    if (bounds.empty()) return frame_all(picture);
    go_to(framed(camera, bounds, size_));
}

}  // namespace weft::editor
