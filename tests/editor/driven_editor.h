// The editor's program in a window of its own, driven by mouse and keys alone, as a user drives it. It aims at the
// names in the file that `--probe` writes, and waits for what the file says; never at pixels, never for a time.
#pragma once

#include "editor/core/action_log.h"

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace weft::editor {

struct Point {
    double x = 0, y = 0;
    friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
    friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
    friend Point operator*(Point a, double by) { return {a.x * by, a.y * by}; }
};
double length(Point p);

struct Rectangle {
    double x = 0, y = 0, width = 0, height = 0;
    Point center() const { return {x + width / 2, y + height / 2}; }
    /// A place in it, from 0, 0 (upper left) to 1, 1.
    Point at(double across, double down) const { return {x + width * across, y + height * down}; }
};

/// Waits without end are failures: functions throw std::runtime_error with what the program has printed.
class DrivenEditor {
  public:
    struct Start {
        std::filesystem::path folder;             ///< for the files of the run
        std::vector<std::string> arguments = {};  ///< after `weft edit`
        std::map<std::string, std::string> environment = {};
        bool keep_settings = false;
        std::string size = "1280 800";
    };
    /// Starts the program and waits for its first frames.
    explicit DrivenEditor(Start start);
    ~DrivenEditor();
    DrivenEditor(const DrivenEditor&) = delete;
    DrivenEditor& operator=(const DrivenEditor&) = delete;

    // --- What the user sees

    bool shows(const std::string& name) { return find(name) && find(name)->at("visible"); }
    bool is_enabled(const std::string& name) { return widget(name).at("enabled"); }
    bool is_focused(const std::string& name) { return widget(name).at("focused"); }
    /// The name of the widget that has the keyboard; empty: none.
    std::string focused();
    std::string value(const std::string& name) { return widget(name).at("value"); }
    double number(const std::string& name);
    Rectangle place(const std::string& name);
    /// The names that begin so.
    std::vector<std::string> names(const std::string& beginning);
    std::uint64_t frame() { return static_cast<std::uint64_t>(number("status/frame")); }
    bool plays() { return value("toolbar/play") == "Pause"; }
    /// Frames of the user interface.
    std::uint64_t frames();

    // --- What the user does. All but the functions of Batch wait until the editor has followed.

    void point_at(Point at);
    void press(unsigned button = 1);
    void release(unsigned button = 1);
    /// Moves the pointer in steps, as a hand does.
    void move(Point to, int steps = 6);
    void drag(Point from, Point to);
    void click(const std::string& name, unsigned button = 1);
    void click(Point at, unsigned button = 1);
    void double_click(const std::string& name);
    /// As xdotool names them: `ctrl+z`, `Return`, `F2`.
    void key(const std::string& keys);
    /// Holds a key until it is let go of.
    void hold(const std::string& key);
    void let_go(const std::string& key);
    /// Holds a key, with which something may move all the time, until this is so.
    void hold_until(const std::string& key, const std::string& what, const std::function<bool()>& so);
    void type(const std::string& text);
    /// Positive: away from the user.
    void wheel(int notches);
    /// Turns the wheel over the panel until the widget is in sight.
    void scroll_to(const std::string& name, const std::string& panel);
    void resize(unsigned width, unsigned height);

    /// Everything that `what` does goes to the window at once, without waiting in between.
    void at_once(const std::function<void()>& what);

    void until(const std::string& what, const std::function<bool()>& so, double seconds = 30);
    /// Waits until all input and all actions have been carried out.
    void settle();

    // --- The process

    /// Seconds of processor time so far.
    double processor_seconds() const;
    void kill();
    /// The exit status of the program, which ends by what the user does.
    int end_by(const std::function<void()>& what);
    bool runs();
    std::string printed() const;

    // --- The log

    Log log() const;
    /// The actions of one kind.
    std::vector<Action> actions(std::string_view kind) const;
    /// The scene and the state to which the log leads.
    Stage played() const;
    const std::filesystem::path& log_file() const { return log_; }

  private:
    class Hands;
    const Json& probe();
    const Json* find(const std::string& name);
    const Json& widget(const std::string& name);
    void send(const std::string& command, unsigned changes = 0);
    int wait();
    [[noreturn]] void fail(const std::string& what);

    std::filesystem::path folder_, probe_file_, log_, output_;
    pid_t process_ = 0;
    int status_ = 0;
    std::unique_ptr<Hands> hands_;
    Json probe_;
    std::string probe_text_;
    std::uint64_t sent_ = 0;  // changes of keys and buttons
    Point pointer_{};
    bool at_once_ = false;
};

}  // namespace weft::editor
