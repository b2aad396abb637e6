#include "editor/app/tool_panel.h"

#include "editor/app/vertex_edits.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/number.h"
#include "view/legend.h"

#include <algorithm>
#include <array>
#include <optional>

namespace weft::editor {
namespace {

/// Buttons side by side, as wide as the panel.
class ButtonRow {
  public:
    ButtonRow(Ui& ui, int count) : ui_(ui), gap_(ui.theme().px(4)) {
        width_ = (ImGui::GetContentRegionAvail().x - gap_ * static_cast<float>(count - 1)) / static_cast<float>(count);
    }
    bool add(std::string_view name, ButtonStyle style) {
        if (!first_) ImGui::SameLine(0, gap_);
        first_ = false;
        style.width = width_;
        return button(ui_, name, style);
    }

  private:
    Ui& ui_;
    float gap_, width_ = 0;
    bool first_ = true;
};

/// The cloth that groups belong to; empty: none.
std::string cloth_of_groups(const Session& session, const ViewPanel& view) {
    if (session.selected().starts_with("/cloths/")) {
        const std::size_t end = session.selected().find('/', 8);
        return session.selected().substr(0, end);
    }
    if (!view.selector.chosen().empty()) return place_of_cloth(*session.document(), view.selector.cloth());
    return session.document()->scene.cloths.size() == 1 ? "/cloths/0" : "";
}

void heading(const Ui& ui, const char* text) {
    ImGui::PushFont(ui.theme().strong);
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
}

/// A patch of color with its meaning. `end`: 0 or 1, of the scale.
void scale_end(const Ui& ui, render::ColorScale scale, float end, std::string_view text) {
    const float side = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const Vec4 c = color_of(scale, end);
    ImGui::GetWindowDrawList()->AddRectFilled(at, ImVec2(at.x + side, at.y + side),
                                              ImGui::GetColorU32(ImVec4(c.x, c.y, c.z, 1)), ui.theme().px(3));
    ImGui::Dummy(ImVec2(side, side));
    ImGui::SameLine(0, ui.theme().px(6));
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

}  // namespace

bool ToolPanel::show(Ui& ui, Session& session, ViewPanel& view, const Picture& picture) {
    const Tool tool = view.settings.tool;
    const bool chooses = tool == Tool::select || tool == Tool::lasso;
    if (!chooses && tool != Tool::brush && tool != Tool::anchors && tool != Tool::hand) return false;
    const Ui::Scope scope(ui, "tool");
    heading(ui, tool == Tool::select  ? "Select"
                : tool == Tool::lasso ? "Lasso"
                : tool == Tool::brush ? "Brush"
                : tool == Tool::hand  ? "Hand"
                                      : "Anchors");
    if (chooses) selection(ui, session, view, picture);
    if (tool == Tool::hand) hand(ui, view);
    if (tool == Tool::brush) brush(ui, session, view);
    if (tool == Tool::anchors) anchors(ui, session, view);
    return true;
}

void ToolPanel::hand(Ui& ui, ViewPanel& view) {
    double force = static_cast<double>(view.settings.pull_force);
    if (number(ui, {.name = "force", .label = "Largest force", .what = "The hand pulls cloth with at most this force"},
               force, {.min = 0.01, .max = 10000, .unit = "N", .usual = 5}) != Change::none)
        view.settings.pull_force = static_cast<float>(force);
}

// --- Selection and groups

void ToolPanel::selection(Ui& ui, Session& session, ViewPanel& view, const Picture& picture) {
    VertexSelector& selector = view.selector;
    const bool any = !selector.chosen().empty();
    const std::string pin = "Pin " + std::to_string(selector.chosen().size());
    ButtonRow pins(ui, 2);
    if (pins.add("pin",
                 {.icon = Icon::pin, .text = pin, .what = "Hold the chosen vertices", .shortcut = "P", .enabled = any}))
        selector.pin(session);
    if (pins.add("unpin", {.icon = Icon::unpin,
                           .text = "Unpin",
                           .what = "Let go of the chosen vertices",
                           .shortcut = "Shift+P",
                           .enabled = any}))
        selector.unpin(session);
    constexpr std::array shortcuts{"Ctrl+A", "Ctrl+Shift+A", "Ctrl+I", "Ctrl+=", "Ctrl+-", "Ctrl+B"};
    std::optional<ButtonRow> row;
    for (std::size_t i = 0; i < selection_changes().size(); ++i) {
        const SelectionChange& one = selection_changes()[i];
        if (i % 3 == 0) row.emplace(ui, 3);
        if (row->add(one.name, {.text = one.label,
                                .what = one.what,
                                .shortcut = shortcuts.at(i),
                                .enabled = any || !one.needs_chosen}))
            selector.change(one, session, picture);
    }
    (void)flag(ui,
               {.name = "through", .label = "Hidden too", .what = "Choose vertices that cloth or colliders hide (T)"},
               selector.through);
    groups(ui, session, view);
}

void ToolPanel::groups(Ui& ui, Session& session, ViewPanel& view) {
    const std::string cloth = cloth_of_groups(session, view);
    if (cloth.empty()) return;
    const VertexSet& chosen = view.selector.chosen();
    const std::vector<std::string> names = group_names(*session.document(), cloth);
    heading(ui, "Groups");
    if (!names.empty()) {
        std::size_t at = static_cast<std::size_t>(std::ranges::find(names, group_) - names.begin());
        if (at == names.size()) at = names.size() - 1;
        const std::vector<std::string_view> views(names.begin(), names.end());
        (void)choice(ui, {.name = "group", .label = "Group", .what = "Vertices with a name"}, at, views);
        group_ = names[at];
        std::string name = group_;
        const Change typed =
            text(ui, {.name = "group_name", .label = "Name", .what = "Pins, resistance and weights can name it"}, name);
        if (typed == Change::finished && name != group_) {
            const auto edits = group_renaming(*session.document(), cloth, group_, name);
            session.change("Rename group " + group_ + " to " + name, edits);
            if (find_group(*session.document(), cloth, name)) group_ = name;
        }
        group_buttons(ui, session, view, cloth);
    }
    ButtonRow row(ui, 1);
    if (row.add("group_new", {.icon = Icon::add,
                              .text = "New group of " + std::to_string(chosen.size()),
                              .what = "Give the chosen vertices a name",
                              .enabled = !chosen.empty()})) {
        const std::string at = place_of_cloth(*session.document(), view.selector.cloth());
        group_ = free_group_name(*session.document(), at, "group");
        session.change("New group " + group_, group_edits(*session.document(), at, group_, chosen));
        ui.focus(ui.probe().path("group_name"), true);
    }
}

void ToolPanel::group_buttons(Ui& ui, Session& session, ViewPanel& view, const std::string& cloth) {
    const VertexGroup* group = find_group(*session.document(), cloth, group_);
    if (!group) return;
    const VertexSet members = make_set(group->vertices);
    const std::string name = session.document()->scene.cloths[std::stoul(cloth.substr(8))].name;
    const bool has_chosen = !view.selector.chosen().empty() && view.selector.cloth() == name;
    const VertexSet chosen = has_chosen ? view.selector.chosen() : VertexSet{};
    const std::string count = "Choose " + std::to_string(members.size());
    ButtonRow first(ui, 2);
    if (first.add("group_choose", {.text = count, .what = "Choose the vertices of the group"}))
        view.selector.choose(name, members);
    if (first.add("group_delete", {.icon = Icon::trash,
                                   .text = "Delete",
                                   .what = "Remove the group. Pins that name it list its vertices from then on"})) {
        session.change("Delete group " + group_, group_removal(*session.document(), cloth, group_));
        return;
    }
    ButtonRow second(ui, 2);
    if (second.add(
            "group_add",
            {.icon = Icon::add, .text = "Add", .what = "Add the chosen vertices to the group", .enabled = has_chosen}))
        session.change("Add to group " + group_,
                       group_edits(*session.document(), cloth, group_, with(members, chosen)));
    const VertexSet left = without(members, chosen);
    if (second.add("group_subtract", {.icon = Icon::remove,
                                      .text = "Subtract",
                                      .what = "Take the chosen vertices out of the group. The last one cannot be taken",
                                      .enabled = has_chosen && !left.empty()}))
        session.change("Subtract from group " + group_, group_edits(*session.document(), cloth, group_, left));
}

// --- Brush

void ToolPanel::brush(Ui& ui, Session& session, ViewPanel& view) {
    BrushOptions& options = view.brush.options;
    std::vector<std::string_view> labels;
    for (const PaintKind& one : paint_kinds()) labels.push_back(one.label);
    (void)choice(ui, {.name = "kind", .label = "Paint", .what = "What a stroke changes"}, options.kind, labels);
    const PaintKind& kind = view.brush.kind();
    const std::string cloth = cloth_of_groups(session, view);
    if (kind.name == "group") {
        const std::vector<std::string> names =
            cloth.empty() ? std::vector<std::string>() : group_names(*session.document(), cloth);
        if (!names.empty()) {
            std::vector<std::string_view> views(names.begin(), names.end());
            std::size_t at = static_cast<std::size_t>(std::ranges::find(names, options.group) - names.begin());
            if (at == names.size()) views.push_back(options.group);
            const Change picked = choice(ui, {.name = "group", .label = "Group", .what = kind.what}, at, views);
            if (picked != Change::none && at < names.size()) options.group = names[at];
        }
        std::string name = options.group;
        const Change typed = text(
            ui, {.name = "group_name", .label = "Name", .what = "A stroke makes the group if there is none"}, name);
        if (typed == Change::finished && !name.empty()) options.group = name;
    }
    brush_numbers(ui, options, kind);
    constexpr std::array<std::string_view, 4> mirrors{"off", "x", "y", "z"};
    std::size_t mirror = options.mirror ? static_cast<std::size_t>(*options.mirror) + 1 : 0;
    (void)choice(ui,
                 {.name = "mirror",
                  .label = "Mirror",
                  .what = "Also paints the other side of the cloth at rest, along this axis of the cloth"},
                 mirror, mirrors);
    options.mirror = mirror == 0 ? std::nullopt : std::optional(static_cast<MirrorAxis>(mirror - 1));
    const ClothPaint colors = colors_of(kind, {}, {});
    scale_end(ui, colors.scale, 0, kind.scale_low);
    if (kind.neutral != 0) scale_end(ui, colors.scale, 0.5f, "the fabric");
    scale_end(ui, colors.scale, 1, kind.scale_high);
}

void ToolPanel::brush_numbers(Ui& ui, BrushOptions& options, const PaintKind& kind) {
    constexpr std::array<std::string_view, 5> modes{"paint", "add", "subtract", "smooth", "erase"};
    constexpr std::array<std::string_view, 2> modes_on_off{"paint", "erase"};
    const Field how{.name = "mode", .label = "Stroke", .what = "Ctrl erases, Shift smooths"};
    std::size_t mode = static_cast<std::size_t>(options.mode);
    if (kind.on_off) {
        mode = options.mode == PaintMode::erase ? 1 : 0;
        if (choice(ui, how, mode, modes_on_off) != Change::none)
            options.mode = mode == 1 ? PaintMode::erase : PaintMode::paint;
    } else if (choice(ui, how, mode, modes) != Change::none) {
        options.mode = static_cast<PaintMode>(mode);
    }
    const auto row = [&](const Field& field, float& value, const NumberRange& range) {
        double exact = static_cast<double>(value);
        if (number(ui, field, exact, range) != Change::none) value = static_cast<float>(exact);
    };
    if (!kind.on_off)
        row({.name = "value", .label = "Value", .what = kind.what}, options.values[options.kind],
            {.min = static_cast<double>(kind.least), .max = static_cast<double>(kind.most)});
    row({.name = "radius", .label = "Radius", .what = "Over the surface at rest; [ and ] change it"}, options.radius,
        {.min = 0.001, .max = 100, .unit = "m"});
    if (kind.on_off) return;
    row({.name = "strength", .label = "Strength", .what = "Part of the way to the value that a stroke goes"},
        options.strength, {.min = 0, .max = 1});
    constexpr std::array<std::string_view, 3> falls{"smooth", "linear", "none"};
    std::size_t fall_off = static_cast<std::size_t>(options.fall_off);
    if (choice(ui, {.name = "fall_off", .label = "Fall-off", .what = "From the center to the ring"}, fall_off, falls) !=
        Change::none)
        options.fall_off = static_cast<BrushFallOff>(fall_off);
}

// --- Anchors

void ToolPanel::anchors(Ui& ui, Session& session, ViewPanel& view) {
    AnchorTool& tool = view.anchors;
    const std::string count = tool.pending() ? std::to_string(tool.added().size()) + " to pin, " +
                                                   std::to_string(tool.removed().size()) + " to let go"
                                             : "Click vertices to pin them or let them go.";
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(count.c_str());
    ImGui::PopTextWrapPos();
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    ui.note("pending", ImRect(low, high), count);
    ButtonRow row(ui, 2);
    if (row.add("apply", {.icon = Icon::check,
                          .text = "Apply",
                          .what = "Pin and let go as marked; one undo step",
                          .shortcut = "Enter",
                          .primary = tool.pending(),
                          .enabled = tool.pending()}))
        tool.apply(session);
    if (row.add("discard", {.icon = Icon::cross,
                            .text = "Discard",
                            .what = "Forget the marks",
                            .shortcut = "Esc",
                            .enabled = tool.pending()}))
        tool.discard();
    const std::size_t chosen = view.selector.chosen().size();
    ButtonRow more(ui, 1);
    if (more.add("add_chosen", {.icon = Icon::add,
                                .text = "Add the " + std::to_string(chosen) + " chosen",
                                .what = "Mark the chosen vertices to be pinned",
                                .enabled = chosen > 0}))
        tool.add(session, view.selector.cloth(), view.selector.chosen());
    (void)flag(ui, {.name = "live", .label = "Live", .what = "Each click changes the pins at once"}, tool.live);
    (void)flag(ui,
               {.name = "through", .label = "Hidden too", .what = "Choose vertices that cloth or colliders hide (T)"},
               view.selector.through);
}

}  // namespace weft::editor
