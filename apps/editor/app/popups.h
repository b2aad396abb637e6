// Windows over the others.
#pragma once

#include "editor/ui/ui.h"
#include "editor/ui/widgets/controls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

namespace weft::editor {

/// A window in the middle over everything else, which takes the whole input. Lives while its content is drawn. It is
/// never larger than the window, and scrolls then. Long lines are wrapped.
class Dialog {
  public:
    /// `size`: pixels; height 0: as high as the content.
    Dialog(Ui& ui, const char* name, const char* title, ImVec2 size)
        : scope_(ui, name), ui_(ui), name_(name), fits_(size.y <= 0) {
        if (fits_) size.y = std::max(heights()[name_], ui.theme().px(80));
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
        ImGui::PushTextWrapPos(0);
    }
    ~Dialog() {
        ImGui::PopTextWrapPos();
        const float needed = std::ceil(ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y +
                                       ImGui::GetStyle().WindowPadding.y + 2 * ImGui::GetStyle().ChildBorderSize + 1);
        if (float& height = heights()[name_]; fits_ && height != needed) {
            height = needed;
            ui_.redraw();
        }
        ImGui::EndChild();
        ImGui::PopStyleVar(2);
        ImGui::PopStyleColor();
        ImGui::End();
    }
    Dialog(const Dialog&) = delete;
    Dialog& operator=(const Dialog&) = delete;

  private:
    /// Of the content in the last frame, by the dialog's name, pixels.
    static std::map<std::string, float>& heights() {
        static std::map<std::string, float> all;
        return all;
    }
    Ui::Scope scope_;
    Ui& ui_;
    std::string name_;
    bool fits_;
};

/// A button beside the one before it, or below it if there is no room.
inline bool next_button(Ui& ui, std::string_view name, const ButtonStyle& style) {
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < button_width(ui, style)) ImGui::NewLine();
    return button(ui, name, style);
}

}  // namespace weft::editor
