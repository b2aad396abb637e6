// For tests: a user interface without a window, which gets events from a script.
#pragma once

#include "editor/ui/ui.h"

#include <functional>
#include <string_view>
#include <vector>

namespace weft::editor {

/// Events at a clock that the script moves on.
class Script {
  public:
    double clock = 0;  // s
    std::vector<render::WindowEvent> events;

    Script& wait(double seconds) {
        clock += seconds;
        return *this;
    }
    Script& move(float x, float y) {
        pointer_ = {x, y};
        return add(render::PointerMoved{pointer_});
    }
    Script& button(bool down, PointerButton which = PointerButton::left) {
        return add(render::ButtonChanged{which, down, pointer_, held_});
    }
    Script& click(int times = 1) {
        for (int i = 0; i < times; ++i) button(true).wait(0.02).button(false).wait(0.05);
        return *this;
    }
    Script& wheel(float y) { return add(render::WheelTurned{{0, y}}); }
    Script& key(Key which, bool down) {
        if (which == Key::left_control) held_.control = down;
        if (which == Key::left_shift) held_.shift = down;
        return add(render::KeyChanged{which, which, down, false, held_});
    }
    Script& press(Key which) { return key(which, true).wait(0.01).key(which, false).wait(0.01); }
    /// With the keys that type the letters and digits.
    Script& type(std::string_view text) {
        for (const char c : text) {
            const Key which = c >= '0' && c <= '9'   ? static_cast<Key>(static_cast<int>(Key::digit_0) + c - '0')
                              : c >= 'a' && c <= 'z' ? static_cast<Key>(static_cast<int>(Key::a) + c - 'a')
                                                     : Key::period;
            key(which, true).add(render::TextTyped{static_cast<char32_t>(c)}).wait(0.01).key(which, false);
        }
        return *this;
    }
    template <class What>
    Script& add(What what) {
        events.push_back({clock, std::move(what)});
        return *this;
    }
    std::vector<render::WindowEvent> take() { return std::exchange(events, {}); }

  private:
    Vec2 pointer_;
    Modifiers held_;
};

/// Runs frames of one function.
class Stage {
  public:
    explicit Stage(std::function<void(Ui&)> content, UiOptions options = {})
        : ui(std::move(options)), content_(std::move(content)) {
        settle();
    }
    /// One frame.
    const ImDrawData& frame() {
        ui.begin(width, height, script.clock);
        ui.take_new_fonts();
        if (ImGui::GetIO().Fonts->TexID == nullptr) ImGui::GetIO().Fonts->SetTexID(reinterpret_cast<ImTextureID>(1));
        ImGui::SetNextWindowPos(ImVec2(0, 0));
        ImGui::SetNextWindowSize(ImVec2(width, height));
        ImGui::Begin("page", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBringToFrontOnFocus);
        content_(ui);
        ImGui::End();
        return ui.end();
    }
    /// All events of the script at once, then frames until nothing is left: as slow as the user interface can be.
    void settle() {
        ui.add(script.take());
        int frames = 0;
        do {
            frame();
        } while (ui.wants_frame() && ++frames < 1000);
    }
    /// The middle of a widget.
    Vec2 middle(std::string_view path) const {
        const ProbedWidget* widget = const_cast<Ui&>(ui).probe().find(path);
        if (!widget) return {-1, -1};
        return {widget->x + widget->width / 2, widget->y + widget->height / 2};
    }
    const ProbedWidget& widget(std::string_view path) {
        static const ProbedWidget none;
        const ProbedWidget* found = ui.probe().find(path);
        return found ? *found : none;
    }
    Script& to(std::string_view path) {
        const Vec2 at = middle(path);
        return script.move(at.x, at.y).wait(0.5);
    }

    Ui ui;
    Script script;
    float width = 400, height = 600;

  private:
    std::function<void(Ui&)> content_;
};

}  // namespace weft::editor
