// For tests: a page with every widget.
#pragma once

#include "editor/ui/expression.h"
#include "editor/ui/ui_renderer.h"
#include "editor/ui/widgets/color.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/number.h"
#include "editor/ui/widgets/panels.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

struct WidgetPage {
    double density = 0.2, stretch = 8000, damping = 0.1, position_y = 1.25, turn = 30;
    std::array<double, 3> position{0, 1.25, -0.5}, wind{2.5, 0, 0};
    std::array<double, 2> uv{1, 1};
    std::array<double, 4> row4{0, 0.25, 0.5, 1};
    long long substeps = 12;
    bool self_collision = true, hidden = false, playing = true, fabric_open = true, place_open = true,
         more_open = false;
    std::size_t model = 1, layer = 0;
    std::string name = "tablecloth", path;
    Vec3 tint{0.5f, 0.05f, 0.03f};
    float left = 220, right = 380, done = 0.42f;
    std::vector<float> step_ms;
    std::string log;  // what changed, and how
    int added = 0, cancelled = 0;
    UiImage view = UiImage::none;

    WidgetPage() {
        for (int i = 0; i < 120; ++i)
            step_ms.push_back(4 + std::sin(static_cast<float>(i) * 0.21f) + (i % 37 == 0 ? 5.0f : 0.0f));
    }

    void tell(std::string_view what, Change change) {
        if (change == Change::none) return;
        log += std::string(what) + (change == Change::finished ? "! " : change == Change::cancelled ? "x " : "~ ");
    }

    void build(Ui& ui) {
        const Theme& theme = ui.theme();
        const ImVec2 size = ui.size();
        constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
        ImGui::SetNextWindowPos(ImVec2(0, 0));
        ImGui::SetNextWindowSize(size);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
        ImGui::PushStyleColor(ImGuiCol_WindowBg, theme.colors.background);
        ImGui::Begin("page", nullptr, fixed);
        ImGui::PopStyleColor();
        toolbar(ui, size.x);
        const float height = size.y - ImGui::GetCursorPosY() - theme.px(28);
        const float least = theme.px(80), bar = splitter_width(ui);
        const float left_width = theme.px(left), right_width = theme.px(right);
        panel(ui, "objects", ImVec2(left_width, height), [&] { objects(ui); });
        ImGui::SameLine(0, 0);
        splitter(ui, "split_left", SplitAxis::x, height, left, 120, 400);
        ImGui::SameLine(0, 0);
        const float middle = std::max(least, size.x - left_width - right_width - 2 * bar);
        panel(ui, "view", ImVec2(middle, height), [&] { show_view(ui); });
        ImGui::SameLine(0, 0);
        splitter(ui, "split_right", SplitAxis::x, height, right, 200, 600, true);
        ImGui::SameLine(0, 0);
        panel(ui, "properties", ImVec2(std::max(least, right_width), height), [&] { properties(ui); });
        status(ui, size.x);
        ImGui::End();
        ImGui::PopStyleVar(2);
    }

  private:
    template <class Content>
    void panel(Ui& ui, const char* name, ImVec2 size, Content&& content) {
        const Theme& theme = ui.theme();
        const bool view_panel = std::string_view(name) == "view";
        ImGui::PushStyleColor(ImGuiCol_ChildBg, view_panel ? theme.colors.background : theme.colors.panel);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, view_panel ? ImVec2(0, 0) : ImVec2(theme.px(10), theme.px(8)));
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(6), theme.px(5)));
        ImGui::BeginChild(name, size, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
        ImGui::PopStyleColor();
        {
            const Ui::Scope scope(ui, name);
            content();
        }
        ImGui::PopStyleVar(2);  // before EndChild(), which adds the spacing below
        ImGui::EndChild();
    }

    void toolbar(Ui& ui, float width) {
        const Theme& theme = ui.theme();
        ImGui::PushStyleColor(ImGuiCol_ChildBg, theme.colors.header);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(8), theme.px(5)));
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(4), theme.px(4)));
        ImGui::BeginChild("toolbar", ImVec2(width, ImGui::GetFrameHeight() + theme.px(10)), false,
                          ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
        {
            const Ui::Scope scope(ui, "toolbar");
            if (button(ui, "play",
                       {.icon = playing ? Icon::pause : Icon::play,
                        .text = playing ? "Pause" : "Play",
                        .what = "Run the simulation",
                        .shortcut = "Space",
                        .primary = true}))
                playing = !playing;
            ImGui::SameLine();
            button(ui, "step", {.icon = Icon::step, .what = "One frame", .shortcut = "."});
            ImGui::SameLine();
            button(ui, "reset", {.icon = Icon::reset, .what = "Back to the first frame", .shortcut = "R"});
            ImGui::SameLine(0, theme.px(16));
            button(ui, "undo", {.icon = Icon::undo, .what = "Undo", .shortcut = "Ctrl+Z", .flat = true});
            ImGui::SameLine();
            button(ui, "redo",
                   {.icon = Icon::redo, .what = "Redo", .shortcut = "Ctrl+Shift+Z", .flat = true, .enabled = false});
            ImGui::SameLine(0, theme.px(16));
            if (button(ui, "add", {.icon = Icon::add, .text = "Add", .what = "Add an object"})) ++added;
            ImGui::SameLine();
            button(ui, "move", {.icon = Icon::move, .what = "Move", .shortcut = "G", .chosen = true});
            for (const Icon tool :
                 {Icon::rotate, Icon::scale, Icon::hand, Icon::pin, Icon::brush, Icon::cut, Icon::lasso}) {
                ImGui::SameLine();
                button(ui, name_of(tool), {.icon = tool, .what = name_of(tool), .flat = true});
            }
            ImGui::SameLine(0, theme.px(16));
            button(ui, "camera", {.icon = Icon::camera, .what = "Save an image", .shortcut = "F12", .flat = true});
        }
        ImGui::PopStyleVar(2);  // before EndChild(), which adds the spacing below
        ImGui::EndChild();
        ImGui::PopStyleColor();
    }

    void objects(Ui& ui) {
        button(ui, "hide", {.icon = hidden ? Icon::eye_off : Icon::eye, .what = "Show or hide", .flat = true});
        ImGui::SameLine();
        button(ui, "lock", {.icon = Icon::lock, .what = "Lock", .flat = true});
        ImGui::SameLine();
        button(ui, "delete", {.icon = Icon::trash, .what = "Delete", .shortcut = "Del", .flat = true});
        ImGui::PushFont(ui.theme().strong);
        ImGui::TextUnformatted("Icons");
        ImGui::PopFont();
        std::string line;
        for (int i = 1; i < static_cast<int>(Icon::count); ++i) {
            line += text_of(static_cast<Icon>(i));
            line += i % 9 == 0 ? "\n" : " ";
        }
        ImGui::TextUnformatted(line.c_str());
        ImGui::TextWrapped("%s", "Letters: ° ² ³ ⁻ · µ Ω → … × − ≤ ≥ ± √ äöüß čšž Привет αβγ");
        plot(ui, "step_time", step_ms, {.label = "Step time", .unit = "ms", .seconds = 2});
        if (progress(ui, "export", done, "Exporting film.mp4")) ++cancelled;
        note(ui, "warned", Note::warning, "The cloth stretches by 12 %. More substeps make it stiffer.");
        note(ui, "failed", Note::error, "scenes/flag.json: /cloths/0/fabric/density: must be > 0 kg/m², got -1");
        note(ui, "told", Note::info, "Drag the cloth with the left button.");
    }

    void show_view(Ui& ui) {
        const ImVec2 from = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
        if (view != UiImage::none) ImGui::Image(texture_id(view), room);
        ui.note("image", ImRect(from, from + room));
    }

    void properties(Ui& ui) {
        tell("name", text(ui, {.name = "name", .label = "Name", .what = "Shown in lists"}, name));
        tell("path", text(ui, {.name = "path", .label = "Mesh", .what = "A mesh file"}, path, "drop a file here"));
        if (section(ui, "fabric", "Fabric", fabric_open, Icon::cloth)) {
            const Ui::Scope scope(ui, "fabric");
            tell("density", number(ui, {.name = "density", .label = "Density", .what = "Mass per area"}, density,
                                   {.min = 0, .max = 10, .min_excluded = true, .unit = "kg/m²", .usual = 0.15}));
            tell("stretch",
                 number(ui, {.name = "stretch", .label = "Stretch stiffness", .what = "Force per strain and width"},
                        stretch, {.min = 0, .max = 1e6, .unit = "N/m", .usual = 8000.0}));
            tell("damping",
                 number(ui, {.name = "damping", .label = "Damping"}, damping, {.min = 0, .max = 1, .usual = 0.1}));
            constexpr std::string_view models[] = {"dihedral", "plate", "distance"};
            tell("model",
                 choice(ui, {.name = "model", .label = "Bending model", .what = "How folds resist"}, model, models, 0));
            tell("collide", flag(ui, {.name = "self_collision", .label = "Self-collision", .what = "Exact contact"},
                                 self_collision, false));
        }
        if (section(ui, "place", "Place", place_open, Icon::move)) {
            const Ui::Scope scope(ui, "place");
            const double zeros[] = {0, 0, 0};
            tell("position", vector(ui, {.name = "position", .label = "Position", .what = "Of the center"}, position,
                                    {.unit = "m"}, zeros));
            tell("turn",
                 angle(ui, {.name = "turn", .label = "Rotation"}, turn, {.min = -180, .max = 180, .usual = 0.0}));
            tell("wind", vector(ui, {.name = "wind", .label = "Wind"}, wind, {.min = -50, .max = 50, .unit = "m/s"}));
            tell("uv", vector(ui, {.name = "uv", .label = "UV tiling"}, uv, {.min = 0, .max = 100}));
            tell("row4", vector(ui, {.name = "row4", .label = "Four"}, row4, {}));
            tell("substeps", integer(ui, {.name = "substeps", .label = "Substeps"}, substeps,
                                     {.min = 1, .max = 64, .usual = 12.0}));
            tell("tint", color(ui, {.name = "tint", .label = "Color", .what = "Of the cloth in white light"}, tint,
                               Vec3{0.5f, 0.5f, 0.5f}));
        }
        section(ui, "more", "More", more_open);
        ImGui::BeginDisabled();
        double locked = 3;
        number(ui, {.name = "locked", .label = "A locked value"}, locked, {.min = 0, .max = 10, .unit = "s"});
        ImGui::EndDisabled();
    }

    void status(Ui& ui, float width) {
        const Theme& theme = ui.theme();
        const ImVec2 from = ImGui::GetCursorScreenPos();
        const ImRect box(from, from + ImVec2(width, theme.px(28)));
        ImGui::ItemSize(box, 0);
        ImGui::GetWindowDrawList()->AddRectFilled(box.Min, box.Max, theme.color(theme.colors.header));
        clipped_text(ImRect(box.Min + ImVec2(theme.px(10), 0), box.Max),
                     "4.2 ms per step · 16 641 particles · cpu, 2 threads · 60 frames/s",
                     theme.color(theme.colors.muted));
        ui.note("status", box);
    }
};

}  // namespace weft::editor
