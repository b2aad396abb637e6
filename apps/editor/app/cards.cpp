#include "editor/app/cards.h"

#include "editor/app/objects.h"
#include "editor/ui/widgets/controls.h"

namespace weft::editor {
namespace {

void toggle(std::set<std::string>& names, const std::string& name) {
    if (names.erase(name) == 0) names.insert(name);
}

void heading(const Ui& ui, const char* text) {
    ImGui::Dummy(ImVec2(0, ui.theme().px(2)));
    ImGui::PushFont(ui.theme().strong);
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
}

}  // namespace

void Cards::show(Ui& ui, Session& session, ViewMarks& marks, const std::function<void(std::string_view)>& add) {
    add_buttons(ui, add);
    group(ui, session, marks, "Cloths", "/cloths");
    group(ui, session, marks, "Colliders", "/colliders");
    group(ui, session, marks, "Wind", "/air/wind");
    group(ui, session, marks, "Stitches", "/stitches");
    heading(ui, "World");
    for (const char* place : {"/.", "/solver", "/air", "/light", "/camera"}) card(ui, session, nullptr, place);
}

void Cards::add_buttons(Ui& ui, const std::function<void(std::string_view)>& add) {
    const Ui::Scope scope(ui, "add");
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    int column = 0;
    for (const AddableObject& one : addable_objects()) {
        if (!one.primary && !more_) continue;
        if (column++ % 2 == 1) ImGui::SameLine();
        const std::string what = "Add " + std::string(one.what);
        if (button(ui, one.name, {.icon = one.icon, .text = one.label, .what = what, .left = true, .width = width}))
            add(one.name);
    }
    if (button(ui, "more",
               {.icon = more_ ? Icon::up : Icon::down,
                .text = more_ ? "Fewer" : "More",
                .what = "Show or hide further kinds of object",
                .flat = true}))
        more_ = !more_;
}

void Cards::group(Ui& ui, Session& session, ViewMarks& marks, const char* label, const std::string& list) {
    const Json* all = find(session.document()->json, list);
    if (!all || all->empty()) return;
    heading(ui, label);
    // The list may become shorter by what a card does.
    for (std::size_t i = 0; i < all->size(); ++i) {
        card(ui, session, &marks, list + "/" + std::to_string(i));
        all = find(session.document()->json, list);
        if (!all) return;
    }
}

void Cards::card(Ui& ui, Session& session, ViewMarks* marks, const std::string& place) {
    const DocumentPtr document = session.document();
    const std::string label = describe_object(*document, place);
    const bool chosen = session.selected() == place;
    const bool has_marks = marks && (place.starts_with("/cloths/") || place.starts_with("/colliders/"));
    const Ui::Scope scope(ui, place.substr(1));
    const float side = ImGui::GetFrameHeight(), gap = ImGui::GetStyle().ItemSpacing.x;
    const float room = ImGui::GetContentRegionAvail().x - (has_marks ? 2 * (side + gap) : 0);
    if (chosen && std::exchange(rename_, false) && marks) {
        renaming_ = place, name_ = label;
        ui.focus(ui.probe().path("name"), true);
    }
    if (renaming_ == place) {
        ImGui::SetNextItemWidth(room);
        const Change change = text(ui, {.name = "name"}, name_);
        if (change == Change::finished && !name_.empty() && name_ != label) session.post(Rename{place, name_});
        if (change == Change::finished || change == Change::cancelled) renaming_.clear();
        return;
    }
    if (button(ui, "select",
               {.icon = icon_of(*document, place),
                .text = label,
                .what = "Show the properties of this object",
                .chosen = chosen,
                .flat = true,
                .left = true,
                .width = room}))
        session.select(place);
    if (!has_marks) return;
    const bool hidden = marks->hidden.contains(label), locked = marks->locked.contains(label);
    ImGui::SameLine();
    if (button(ui, "hide",
               {.icon = hidden ? Icon::eye_off : Icon::eye,
                .what = hidden ? "Show in the view" : "Hide in the view",
                .flat = true,
                .width = side}))
        toggle(marks->hidden, label);
    ImGui::SameLine();
    if (button(ui, "lock",
               {.icon = locked ? Icon::lock : Icon::unlock,
                .what = locked ? "Let the pointer pick it" : "Protect from the pointer",
                .flat = true,
                .width = side}))
        toggle(marks->locked, label);
}

}  // namespace weft::editor
