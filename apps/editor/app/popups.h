// Windows over the others.
#pragma once

#include "editor/ui/ui.h"

#include <algorithm>
#include <string>

namespace weft::editor {

/// A window in the middle over everything else, which takes the whole input. Lives while its content is drawn.
class Dialog {
  public:
    Dialog(Ui& ui, const char* name, const char* title, ImVec2 size) : scope_(ui, name) {
        const ImVec2 window = ui.size();
        // A window of its own catches clicks beside the dialog.
        constexpr ImGuiWindowFlags fixed =
            ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
        ImGui::SetNextWindowPos(ImVec2(0, 0));
        ImGui::SetNextWindowSize(window);
        const std::string shade = "shade " + std::string(name);
        // Only at first: later it would take the keyboard from a field of the dialog.
        const ImGuiWindow* known = ImGui::FindWindowByName(shade.c_str());
        if (!known || !known->WasActive) ImGui::SetNextWindowFocus();
        ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0, 0, 0, 0.45f));
        ImGui::Begin(shade.c_str(), nullptr, fixed);
        ImGui::PopStyleColor();
        const ImVec2 fitted(std::min(size.x, window.x - 8), std::min(size.y, window.y - 8));
        ImGui::SetCursorPos(ImVec2((window.x - fitted.x) / 2, (window.y - fitted.y) / 2));
        const Theme& theme = ui.theme();
        ImGui::PushStyleColor(ImGuiCol_ChildBg, theme.colors.popup);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(16), theme.px(14)));
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(8), theme.px(7)));
        ImGui::BeginChild(name, fitted, true, ImGuiWindowFlags_AlwaysUseWindowPadding);
        ImGui::PushFont(theme.strong);
        ImGui::TextUnformatted(title);
        ImGui::PopFont();
    }
    ~Dialog() {
        ImGui::EndChild();
        ImGui::PopStyleVar(2);
        ImGui::PopStyleColor();
        ImGui::End();
    }
    Dialog(const Dialog&) = delete;
    Dialog& operator=(const Dialog&) = delete;

  private:
    Ui::Scope scope_;
};

}  // namespace weft::editor
