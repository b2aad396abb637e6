// The user interface of one frame: ImGui's context with our theme, input, keyboard focus and probe. Needs no window.
#pragma once

#include "editor/ui/input_frames.h"
#include "editor/ui/probe.h"
#include "editor/ui/theme.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

/// What a widget made of the user's input. Values that change during a gesture, such as a drag, are `in_progress`; its
/// end is `finished`. So a gesture is one step of undo.
enum class Change {
    none,
    in_progress,  ///< the value is new; more may follow
    finished,     ///< the gesture is over; the value may be the same as in the last frame
    cancelled,    ///< the gesture was taken back (Esc): the value is as before it
};

/// A widget that has been placed.
struct Item {
    ImGuiID id = 0;
    ImRect box;
    bool visible = false;  ///< not clipped
    bool hovered = false;
    bool focused = false;  ///< has the keyboard, and the user can see it
};

struct UiOptions {
    Appearance appearance = Appearance::dark;
    float scale = 1;  ///< 0.75…3
    std::function<std::string()> clipboard = {};
    std::function<void(const std::string&)> set_clipboard = {};
};

class Ui {
  public:
    explicit Ui(UiOptions options = {});
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    // --- A frame

    /// Events wait here until frames take them.
    void add(const std::vector<render::WindowEvent>& events, float pixels_per_unit = 1);
    /// Begins a frame of this size in pixels. `now`: s, on the clock of the events.
    void begin(float width, float height, double now);
    /// Ends it. The lists are valid until the next begin().
    const ImDrawData& end();
    /// Whether the fonts are new, so that they must be uploaded. Asked once after each begin().
    bool take_new_fonts();

    // --- For what is shown

    const Theme& theme() const { return theme_; }
    /// From the next frame on.
    void set_theme(Appearance appearance, float scale);
    Probe& probe() { return probe_; }
    /// What the user did in this frame.
    const InputFrame& input() const { return input_; }
    ImVec2 size() const;
    double now() const { return input_.time; }

    /// Whether the user has just pressed the key with this label together with exactly these modifiers, and no text
    /// field and no focused widget needs it.
    bool shortcut(Key label, Modifiers modifiers = {}) const;
    /// Whether a widget or popup is under the pointer or drags it, so that the view should not react.
    bool wants_pointer() const;
    /// Whether keys go to a text field.
    bool wants_text() const;
    /// Whether a list or menu was open when the frame began. Escape closes it.
    bool had_popup() const { return had_popup_; }

    // --- When to draw again

    /// Asks for another frame. Any thread may call this.
    void redraw();
    /// Asks for a frame in so many seconds.
    void redraw_in(double seconds);
    /// Whether events wait for the next frames.
    bool input_pending() const { return frames_.pending(); }
    /// Whether a frame is due now.
    bool wants_frame() const;
    /// When the next requested frame is due, in s from `now`; infinity if none is.
    double due_in(double now) const;
    /// Called when redraw() was called by any thread.
    std::function<void()> on_redraw = {};

    // --- For widgets

    /// Prefixes names of widgets, for ImGui's ids and for the probe.
    class Scope {
      public:
        Scope(Ui& ui, std::string_view name);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        Ui& ui_;
    };
    /// Places a widget at ImGui's cursor, which moves on, and makes it reachable by Tab.
    Item place(std::string_view name, ImVec2 size, std::string_view value = {});
    /// The same at a given place; the cursor stays.
    Item place_at(std::string_view name, const ImRect& box, std::string_view value = {}, bool reachable = true);
    /// ImGui's id of a widget, and the label that makes it.
    static ImGuiID id_of(std::string_view name);
    static std::string label_of(std::string_view name);
    /// Adds to the probe only.
    void note(std::string_view name, const ImRect& box, std::string_view value = {});
    /// Whether a key that a focused widget needs was pressed in this frame. `repeat`: also when it is held.
    bool pressed(Key key, bool repeat = false) const;
    /// Draws the ring around what has the keyboard.
    void draw_focus(const Item& item) const;
    /// Moves the keyboard to the next or previous widget. `typing`: opens it for typing, if it can be typed into.
    void focus_next(bool forward, bool typing);
    /// Moves the keyboard to a widget by its path, when it is next placed. `typing`: as in focus_next().
    void focus(std::string_view path, bool typing = false);
    /// Whether this widget should open for typing now, because the keyboard moved to it with `typing`.
    bool takes_typing(const Item& item);
    /// Arrow keys left and right belong to the focused widget in this frame.
    void keep_arrows(const Item& item) const;
    /// Digits and signs belong to the focused widget and are no shortcuts.
    void keep_digits() { keeps_digits_ = true; }
    /// Delete and Backspace reset the focused widget and are no shortcuts.
    void keep_delete() { keeps_delete_ = true; }
    /// The focused widget does not need the space bar.
    void release_space() { releases_space_ = true; }
    /// Shows text about the widget beside its panel, once the pointer or the keyboard has rested there for a while.
    void tooltip(const Item& item, const std::function<void()>& content);
    /// The state of the widget that is in a gesture.
    struct Gesture {
        ImGuiID id = 0;
        bool typing = false;     ///< into a field
        bool opened = false;     ///< the field has got the keyboard
        bool at_end = false;     ///< the cursor begins at the end; otherwise all is selected
        bool took_text = false;  ///< the text has what was typed in the frame in which it began
        bool keys = false;       ///< by arrow keys
        bool moved = false;      ///< the value has changed
        double start = 0;        ///< value before
        double position = 0, pointer = 0, span = 0;
        std::string text;  ///< being typed
    } gesture;

  private:
    void feed();
    void update_focus();
    void apply_theme();
    ImVec2 place_of_tooltip(const ImRect& item, const ImRect& panel, ImVec2 tip) const;

    UiOptions options_;
    ImGuiContext* context_ = nullptr;
    Theme theme_;
    Probe probe_;
    InputFrames frames_;
    InputFrame input_;
    double last_time_ = -1;
    float scale_ = 1;
    Appearance appearance_{};
    bool new_theme_ = true, new_fonts_ = false;

    std::atomic<bool> asked_{true};
    int settling_ = 2;                                 // frames until what follows from the last input is shown
    double due_ = 0;                                   // s: time of a requested frame; infinity: none
    bool keeps_digits_ = false, kept_digits_ = false;  // in this frame, in the last one
    bool had_popup_ = false;
    bool keeps_delete_ = false, kept_delete_ = false;
    bool releases_space_ = false, released_space_ = false;

    struct Stop {
        ImGuiID id = 0;
        ImGuiWindow* window = nullptr;
    };
    std::vector<Stop> stops_, last_stops_;
    ImGuiID focus_wanted_ = 0, focus_missed_ = 0;  // missed: in the last frame
    std::string focus_path_;
    bool focus_typing_ = false;
    ImGuiID tip_ = 0;
    double tip_since_ = 0;
    ImVec2 tip_size_{};  ///< in the last frame; 0: not known yet
    std::string clipboard_;

    friend class Scope;
};

}  // namespace weft::editor
