// What the user can do, by menu, button and key.
#include "editor/app/editor.h"
#include "editor/app/objects.h"
#include "editor/app/scene_files.h"
#include "io/images/picture_writer.h"
#include "view/flat_text.h"

#include <weft/files.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace weft::editor {

void Editor::make_commands() {
    const Modifiers plain{}, control{.control = true}, shift{.shift = true}, both{.shift = true, .control = true};
    const auto on_view = [this](ViewFrom side) { return [this, side] { view_.look_from(side), window_->redraw(); }; };
    const auto tool = [this](Tool one) { return [this, one] { view_.settings.tool = one; }; };
    const auto radius = [this](float by) { return [this, by] { view_.brush.scale_radius(by); }; };
    const auto choice = [this](std::string_view name, Icon icon, Key key, Modifiers modifiers) {
        const SelectionChange& one = *std::ranges::find(selection_changes(), name, &SelectionChange::name);
        return Command{name,
                       one.label,
                       one.what,
                       icon,
                       key,
                       modifiers,
                       [this, &one] {
                           view_.selector.change(one, *session_,
                                                 *static_cast<const Picture*>(session_->now().picture.get()));
                       },
                       [this, &one] { return !one.needs_chosen || !view_.selector.chosen().empty(); }};
    };
    const auto has_object = [this] { return is_object(session_->selected()); };
    const auto has_chosen = [this] { return !view_.selector.chosen().empty(); };
    const auto picture = [this] { return static_cast<const Picture*>(session_->now().picture.get()); };
    commands_ = {
        {"new", "New", "An empty scene with a floor", Icon::file, Key::n, control,
         [this] { unless_changed([this] { open_later({}, new_document()); }); }},
        {"open", "Open …", "A scene or a mesh", Icon::folder, Key::o, control, [this] { ask_open(); }},
        {"import", "Add mesh …", "A cloth from a mesh file", Icon::mesh, Key::none, plain,
         [this] { add_object("mesh"); }},
        {"gallery", "Gallery …", "Scenes that come with weft", Icon::grid, Key::g, control,
         [this] { panel_ = Panel::gallery; }},
        {"save", "Save", "Write the scene to its file", Icon::save, Key::s, control, [this] { save(false); }},
        {"save_as", "Save as …", "Write the scene to another file", Icon::save, Key::s, both, [this] { save(true); }},
        {"recover", "Recover …", "Sessions that have ended unexpectedly", Icon::to_default, Key::none, plain,
         [this] { panel_ = Panel::recovery; }, [this] { return !abandoned_.empty(); }},
        {"export", "Export …", "Animation, video, images or meshes", Icon::export_file, Key::e, control,
         [this] { ask_export(); }},
        {"screenshot", "Save image", "Write the view's image beside the scene", Icon::camera, Key::f12, plain,
         [this] { screenshot(); }},
        {"quit", "Quit", "Close the window", Icon::cross, Key::q, control, [this] { close(); }},
        {"undo", "Undo", "Bring back document and cloth as they were", Icon::undo, Key::z, control,
         [this] { session_->undo(); }, [this] { return !session_->now().done.empty(); }},
        {"redo", "Redo", "Do it again", Icon::redo, Key::z, both, [this] { session_->redo(); },
         [this] { return !session_->now().undone.empty(); }},
        {"history", "History", "Show or hide the list of steps", Icon::menu, Key::h, control,
         [this] { show_history_ = !show_history_; }},
        {"duplicate", "Duplicate", "A copy of the object", Icon::duplicate, Key::d, control,
         [this] { duplicate_selected(); }, has_object},
        {"rename", "Rename", "Give the object another name", Icon::rename, Key::f2, plain,
         [this] { cards_.rename_selected(); }, has_object},
        {"delete", "Delete", "Remove the object", Icon::trash, Key::delete_key, plain, [this] { remove_selected(); },
         has_object},
        {"key", "Set key", "Keep the pose of the collider at the present time", Icon::key, Key::k, plain,
         [this] { key_selected(); }, [this] { return session_->selected().starts_with("/colliders/"); }},
        {"pin", "Pin", "Hold the chosen vertices", Icon::pin, Key::p, plain, [this] { view_.selector.pin(*session_); },
         has_chosen},
        {"unpin", "Unpin", "Let go of the chosen vertices", Icon::unpin, Key::p, shift,
         [this] { view_.selector.unpin(*session_); }, has_chosen},
        {"play", "Play or pause", "Run the simulation", Icon::play, Key::space, plain, [this] { toggle_play(); }},
        {"step", "Step", "One frame", Icon::step, Key::period, plain, [this] { step_once(); }},
        {"reset", "Reset", "Back to the first frame", Icon::reset, Key::r, plain, [this] { session_->post(Reset{}); }},
        {"hand", "Hand", "Pull cloth, move colliders, orbit beside them", Icon::hand, Key::digit_1, plain,
         tool(Tool::hand)},
        {"select", "Select", "Choose vertices of a cloth by click or box", Icon::box_select, Key::digit_2, plain,
         tool(Tool::select)},
        {"move", "Move", "Arrows and planes that move the object", Icon::move, Key::digit_3, plain, tool(Tool::move)},
        {"turn", "Turn", "Rings that turn the object", Icon::rotate, Key::digit_4, plain, tool(Tool::turn)},
        {"scale", "Scale", "Handles that scale the object", Icon::scale, Key::digit_5, plain, tool(Tool::scale)},
        {"cut", "Cut", "Draw a stroke across a cloth", Icon::cut, Key::digit_6, plain, tool(Tool::cut)},
        {"lasso", "Lasso", "Choose vertices of a cloth by a line around them", Icon::lasso, Key::digit_7, plain,
         tool(Tool::lasso)},
        {"brush", "Brush", "Paint pins, resistance, density, stiffness, thickness or groups on a cloth", Icon::brush,
         Key::digit_8, plain, tool(Tool::brush)},
        {"anchors", "Anchors", "Choose vertices to pin, and apply them together", Icon::pin, Key::digit_9, plain,
         tool(Tool::anchors)},
        {"smaller", "Smaller brush", "Also the key [", Icon::remove, Key::left_bracket, plain, radius(1 / 1.2f)},
        {"larger", "Larger brush", "Also the key ]", Icon::add, Key::right_bracket, plain, radius(1.2f)},
        {"apply_anchors", "Apply anchors", "Pin and unpin what is pending", Icon::check, Key::enter, plain,
         [this] { view_.anchors.apply(*session_); },
         [this] { return view_.settings.tool == Tool::anchors && view_.anchors.pending(); }},
        choice("all", Icon::box_select, Key::a, control),
        choice("none", Icon::cross, Key::a, both),
        choice("invert", Icon::repeat, Key::i, control),
        choice("grow", Icon::add, Key::equal, control),
        choice("shrink", Icon::remove, Key::minus, control),
        choice("boundary", Icon::frame_all, Key::b, control),
        {"axes", "Local axes", "Handles along the axes of the object or of the world", Icon::move, Key::x, plain,
         [this] {
             GizmoAxes& axes = view_.settings.axes;
             axes = axes == GizmoAxes::world ? GizmoAxes::local : GizmoAxes::world;
         }},
        {"amount", "Type an amount", "Choose a handle of the object, then type how far it goes", Icon::move, Key::g,
         plain, [this] { view_.choose_handle(*session_); }, has_object},
        {"through", "Choose through cloth", "Hidden vertices can be chosen too", Icon::eye, Key::t, plain,
         [this] { view_.selector.through = !view_.selector.through; }},
        {"frame", "Frame selected", "Show the object as a whole", Icon::frame_all, Key::f, plain,
         [this, picture] { view_.frame_selected(*picture(), *session_), window_->redraw(); }},
        {"frame_all", "Frame all", "Show the whole scene", Icon::frame_all, Key::home, plain,
         [this, picture] { view_.frame_all(*picture()), window_->redraw(); }},
        {"from_right", "From the right", "Along −x", Icon::camera, Key::pad_3, plain, on_view(ViewFrom::right)},
        {"from_left", "From the left", "Along x", Icon::camera, Key::pad_3, control, on_view(ViewFrom::left)},
        {"from_top", "From above", "Along −y", Icon::camera, Key::pad_7, plain, on_view(ViewFrom::top)},
        {"from_bottom", "From below", "Along y", Icon::camera, Key::pad_7, control, on_view(ViewFrom::bottom)},
        {"from_front", "From the front", "Along −z", Icon::camera, Key::pad_1, plain, on_view(ViewFrom::front)},
        {"from_back", "From behind", "Along z", Icon::camera, Key::pad_1, control, on_view(ViewFrom::back)},
        {"use_camera", "Use view as the scene's camera", "For images and videos", Icon::video, Key::none, plain,
         [this] {
             const Camera& c = view_.camera;
             const auto json = [](Vec3 v) { return Json{number(v.x), number(v.y), number(v.z)}; };
             session_->change(
                 "Camera",
                 {{"/camera",
                   Json{{"position", json(c.position)}, {"target", json(c.target)}, {"fov", number(c.fov)}}}});
         }},
        {"go_to_camera", "View from the scene's camera", "As images and videos show it", Icon::video, Key::pad_0, plain,
         [this] { view_.camera = *session_->document()->scene.camera; },
         [this] { return session_->document()->scene.camera.has_value(); }},
        {"preferences", "Preferences …", "Appearance, scale, keys, backend", Icon::settings, Key::comma, control,
         [this] { panel_ = Panel::preferences; }},
        {"help", "Keys and mouse", "What the keys and buttons do", Icon::help, Key::h, plain,
         [this] { panel_ = Panel::help, did("help"); }},
    };
}

const Command* Editor::command(std::string_view name) const {
    const auto found = std::ranges::find(commands_, name, &Command::name);
    return found == commands_.end() ? nullptr : &*found;
}

void Editor::run_command(const Command& one) {
    if (!one.enabled || one.enabled()) one.run();
}

void Editor::keys(Ui& ui) {
    const bool dialog = panel_ != Panel::none || file_dialog_.is_open();
    if (ui.shortcut(Key::escape)) {
        if (ui.had_popup()) return;  // it closes
        if (panel_ != Panel::none && panel_ != Panel::unsaved)
            panel_ = Panel::none;
        else if (!file_dialog_.is_open() && !view_.cancel(*session_))
            session_->select({});
        return;
    }
    if (dialog || view_.type(ui, *session_)) return;
    for (std::size_t i = 0; i < commands_.size(); ++i)
        if (commands_[i].key != Key::none && ui.shortcut(commands_[i].key, commands_[i].modifiers))
            return run_command(commands_[i]);
    if (ui.shortcut(Key::y, {.control = true})) session_->redo();
}

// --- Objects

void Editor::add_object(std::string_view name) {
    const auto add = [this](std::string_view kind, const std::string& file) {
        const auto added = addition(*session_->document(), kind, file);
        if (!added) return session_->say("Add", added.errors());
        session_->change("Add " + std::string(kind), added->edits);
        session_->select(added->place);
    };
    if (name != "mesh" && name != "solid") return add(name, {});
    file_dialog_.ask({.title = name == "mesh" ? "Add a cloth from a mesh" : "Add a solid mesh",
                      .action = "Add",
                      .endings = {".obj", ".ply", ".glb", ".gltf", ".fbx", ".stl", ".3ds"},
                      .start = session_->document()->folder / "",
                      .chosen = [this, add, kind = std::string(name)](const std::filesystem::path& file) {
                          kind == "mesh" ? add_cloth_from(file.string()) : add(kind, file.string());
                      }});
}

// The mesh is read in the background, for its size: the cloth begins above what is there, so that it falls on it.
void Editor::add_cloth_from(const std::string& file) {
    adding_.push_back(std::async(std::launch::async, [file, folder = session_->document()->folder, this] {
        Added added{.file = file, .bounds = {}, .errors = {}, .has_colors = false};
        const auto mesh = read_mesh_file(file, folder);
        if (!mesh) added.errors = mesh.errors();
        if (mesh)
            for (const Vec3 p : mesh->positions) added.bounds.include(p);
        added.has_colors = mesh && !mesh->colors.empty();
        window_->redraw();
        return added;
    }));
}

void Editor::take_added() {
    while (!adding_.empty() && adding_.front().wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        const Added one = adding_.front().get();
        adding_.erase(adding_.begin());
        const std::string label = "Add " + std::filesystem::path(one.file).filename().string();
        if (!one.errors.empty()) {
            session_->say(label, one.errors);
            continue;
        }
        const auto* picture = static_cast<const Picture*>(session_->now().picture.get());
        const Room room = picture ? room_of(*picture->world) : Room{};
        const auto added =
            addition(*session_->document(), "mesh", one.file, place_above(one.bounds, room), one.has_colors);
        if (!added) {
            session_->say(label, added.errors());
            continue;
        }
        session_->change(label, added->edits);
        session_->select(added->place);
    }
}

void Editor::remove_selected() {
    const std::string place = session_->selected();
    if (!is_object(place)) return;
    const std::string label = describe_object(*session_->document(), place);
    session_->change("Delete " + label, removal(*session_->document(), place));
    session_->select({});
}

void Editor::duplicate_selected() {
    const auto copy = duplication(*session_->document(), session_->selected());
    if (!copy) return session_->say("Duplicate", copy.errors());
    session_->change("Duplicate " + describe_object(*session_->document(), session_->selected()), copy->edits);
    session_->select(copy->place);
}

void Editor::toggle_play() {
    simulator_->play(!session_->now().playing);
    did("space");
}

void Editor::step_once() {
    simulator_->play(false);
    session_->post(Advance{1});
}

// Keeps the pose that the collider has in the document as a key at the present time.
void Editor::key_selected() {
    const std::string place = session_->selected();
    const Json* object = find(session_->document()->json, place);
    if (!object) return;
    const Json transform = object->value("transform", Json::object());
    const Json zero = Json{0, 0, 0};
    const float time = static_cast<float>(session_->now().time);
    Json keys = Json::array();
    if (object->contains("motion") && (*object)["motion"].is_object()) keys = (*object)["motion"].value("keys", keys);
    Json fresh{{"time", number(time)},
               {"position", transform.value("position", zero)},
               {"rotation", transform.value("rotation", zero)}};
    const auto at = std::ranges::find_if(keys, [&](const Json& key) { return key.value("time", 0.0f) >= time; });
    if (at != keys.end() && at->value("time", 0.0f) == time)
        *at = fresh;
    else
        keys.insert(at, fresh);
    session_->change("Key of " + session_->selected_name(), {{place + "/motion", Json{{"keys", keys}}}});
}

// --- Files

void Editor::ask_open() {
    file_dialog_.ask({.title = "Open a scene",
                      .endings = {".json", ".obj", ".ply", ".glb", ".gltf", ".fbx", ".stl", ".3ds"},
                      .recent = settings_.recent,
                      .start = session_->document()->folder / "",
                      .chosen = [this](const std::filesystem::path& file) { drop({file.string()}); }});
}

void Editor::save(bool as, std::function<void()> after) {
    const std::filesystem::path known = session_->document()->file;
    if (!as && !known.empty()) return save_to(known, after);
    file_dialog_.ask({.title = "Save the scene",
                      .action = "Save",
                      .endings = {".json"},
                      .for_writing = true,
                      .start = known.empty() ? std::filesystem::path("scene.json") : known,
                      .chosen = [this, after](const std::filesystem::path& file) { save_to(file, after); }});
}

void Editor::save_to(std::filesystem::path file, std::function<void()> after, bool overwrite_changed) {
    if (!overwrite_changed && changed_on_disk(*session_->document(), file)) {
        panel_ = Panel::changed_file;
        after_unsaved_ = std::move(after);
        return;
    }
    auto saved = save_document(*session_->document(), file, overwrite_changed);
    if (!saved) return session_->say("Save " + file.filename().string(), saved.errors());
    session_->post(Saved{std::filesystem::absolute(file).lexically_normal().string(), (*saved)->text});
    session_->mark_saved(file, *saved);
    add_recent(settings_, file);
    const bool has_cloth = !session_->document()->scene.cloths.empty();
    session_->say("Saved " + file.string() +
                  (has_cloth ? "" : ". It has no cloth: weft run and weft render need one."));
    if (after) after();
}

void Editor::unless_changed(std::function<void()> what) {
    if (!session_->has_changes()) return what();
    after_unsaved_ = std::move(what);
    panel_ = Panel::unsaved;
}

void Editor::close() {
    unless_changed([this] {
        closing_ = true;
        window_->close();
    });
}

void Editor::ask_export() {
    if (export_ && export_->running()) return session_->say("An export runs already.");
    begin_export(export_choices_, session_->now());
    panel_ = Panel::export_file;
}

void Editor::screenshot() {
    if (!view_image_ || view_image_->image.rgba.empty()) return;
    const std::filesystem::path folder = session_->document()->file.parent_path();
    std::filesystem::path file;
    std::error_code ignored;
    for (int i = 1; file.empty() || std::filesystem::exists(file, ignored); ++i)
        file = folder / ("weft-" + std::to_string(i) + ".png");
    Image8 image = view_image_->image;
    std::vector<render::FlatVertex> legends;
    draw_legends(view_image_->legends, image.width, image.height, legends);
    draw_onto(image, legends);
    auto writer = make_picture_writer(file);
    Result<void> written = writer ? (*writer)->begin({.width = image.width, .height = image.height, .picture_count = 1})
                                  : Result<void>(writer.errors());
    if (written) written = (*writer)->write(image);
    if (written) written = (*writer)->finish();
    if (!written) return session_->say("Save image", written.errors());
    session_->say("Saved " + file.string());
}

void Editor::toggle_overlay(const Overlay* overlay) {
    if (std::erase(overlays_, overlay) == 0) overlays_.push_back(overlay);
    const auto need = [&](OverlayNeeds what) {
        return std::ranges::find(overlays_, what, &Overlay::needs) != overlays_.end();
    };
    simulator_->run(
        [forces = need(OverlayNeeds::contact_forces), marks = need(OverlayNeeds::contact_marks)](Stage& stage) {
            stage.world().set_contact_forces(forces);
            stage.world().set_contact_marks(marks);
        });
}

}  // namespace weft::editor
