// What differs between the versions of Dear ImGui that weft builds with.
#pragma once

#include "editor/ui/dear_imgui.h"

namespace weft::editor::compat {

#if IMGUI_VERSION_NUM >= 18700
inline constexpr ImGuiKey pad_enter = ImGuiKey_KeypadEnter;
#else
inline constexpr ImGuiKey_ pad_enter = ImGuiKey_KeyPadEnter;
#endif

inline bool hoverable(const ImRect& box, ImGuiID id) {
#if IMGUI_VERSION_NUM >= 18950
    return ImGui::ItemHoverable(box, id, GImGui->LastItemData.InFlags);
#else
    return ImGui::ItemHoverable(box, id);
#endif
}

/// Makes the next text field with this id take the keyboard.
inline void request_text_input(ImGuiID id) {
    ImGuiContext& g = *GImGui;
#if IMGUI_VERSION_NUM >= 18940
    g.NavActivateId = id;
    g.NavActivateFlags = ImGuiActivateFlags_PreferInput;
#else
    g.NavActivateInputId = id;
#endif
}
inline void forget_text_input_request() {
    ImGuiContext& g = *GImGui;
#if IMGUI_VERSION_NUM >= 18940
    g.NavActivateId = 0;
    g.NavActivateFlags = ImGuiActivateFlags_None;
#else
    g.NavActivateInputId = 0;
#endif
}

}  // namespace weft::editor::compat
