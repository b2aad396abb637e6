#include "driven_editor.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace weft::editor {
namespace {

std::string content(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Starts a program. `in`, `out`: what its standard streams become, if they are not −1.
pid_t start(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment, int in,
            int out, int err) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const pid_t process = ::fork();
    if (process != 0) return process;
    if (in >= 0) ::dup2(in, STDIN_FILENO);
    if (out >= 0) ::dup2(out, STDOUT_FILENO);
    if (err >= 0) ::dup2(err, STDERR_FILENO);
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    ::execvp(words[0], words.data());
    ::_exit(127);
}

}  // namespace

double length(Point p) {
    return std::hypot(p.x, p.y);
}

/// xdotool, which carries out one line after another through the X server's XTest extension.
class DrivenEditor::Hands {
  public:
    Hands() {
        std::array<int, 2> to{}, from{};
        if (::pipe2(to.data(), O_CLOEXEC) != 0 || ::pipe2(from.data(), O_CLOEXEC) != 0)
            throw std::runtime_error("no pipe");
        process_ = start({"stdbuf", "-oL", XDOTOOL, "-"}, {}, to[0], from[1], -1);
        ::close(to[0]), ::close(from[1]);
        in_ = ::fdopen(to[1], "w");
        out_ = ::fdopen(from[0], "r");
    }
    ~Hands() {
        std::fclose(in_);
        std::fclose(out_);
        ::waitpid(process_, nullptr, 0);
    }
    Hands(const Hands&) = delete;
    Hands& operator=(const Hands&) = delete;
    /// Returns once the X server has got everything.
    bool run(const std::string& commands) {
        std::fputs((commands + "\ngetmouselocation\n").c_str(), in_);
        std::fflush(in_);
        std::array<char, 256> line{};
        return std::fgets(line.data(), static_cast<int>(line.size()), out_) != nullptr;
    }

  private:
    pid_t process_ = 0;
    std::FILE *in_ = nullptr, *out_ = nullptr;
};

DrivenEditor::DrivenEditor(Start begin)
    : folder_(begin.folder),
      probe_file_(folder_ / "probe.json"),
      log_(folder_ / "session.log"),
      output_(folder_ / "output.txt") {
    std::filesystem::create_directories(folder_);
    std::filesystem::remove(probe_file_);
    std::vector<std::string> command{WEFT_PROGRAM, "edit"};
    command.insert(command.end(), begin.arguments.begin(), begin.arguments.end());
    command.insert(command.end(), {"--probe", probe_file_.string(), "--size"});
    std::istringstream sides(begin.size);
    for (std::string side; sides >> side;) command.push_back(side);
    if (!begin.keep_settings) {
        command.insert(command.end(), {"--no-settings", "--record", log_.string()});
    }
    const int out = ::open(output_.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0600);
    process_ = start(command, begin.environment, -1, out, out);
    ::close(out);
    hands_ = std::make_unique<Hands>();
    until(
        "the first frame", [&] { return std::filesystem::exists(probe_file_); }, 60);
    until("the view", [&] { return shows("middle/view/view") && shows("status/frame"); });
    // A window gets keys while the pointer is in it, because there is no window manager.
    point_at(place("status/frame").at(0.9, 0.5));
}

DrivenEditor::~DrivenEditor() {
    hands_.reset();
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
}

// --- The probe

// The program replaces the file at once. Its time does not tell whether it is another one: the clock of files ticks
// more slowly than frames follow one another.
const Json& DrivenEditor::probe() {
    std::string text = content(probe_file_);
    if (text == probe_text_) return probe_;
    Json next = Json::parse(text, nullptr, false);
    if (next.is_discarded()) return probe_;
    probe_text_ = std::move(text);
    probe_ = std::move(next);
    return probe_;
}

const Json* DrivenEditor::find(const std::string& name) {
    const Json& now = probe();
    if (!now.contains("widgets")) return nullptr;
    const Json& widgets = now["widgets"];
    const auto found = widgets.find(name);
    return found == widgets.end() ? nullptr : &*found;
}

const Json& DrivenEditor::widget(const std::string& name) {
    if (const Json* found = find(name)) return *found;
    until(
        "widget " + name, [&] { return find(name) != nullptr; }, 10);
    return *find(name);
}

double DrivenEditor::number(const std::string& name) {
    const std::string text = value(name);
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 3, "\xE2\x88\x92") == 0)  // a minus sign as it is printed
            plain += '-', i += 2;
        else
            plain += text[i];
    }
    char* end = nullptr;
    const double number = std::strtod(plain.c_str(), &end);
    if (end == plain.c_str()) fail(name + " shows \"" + text + "\" and no number");
    return number;
}

Rectangle DrivenEditor::place(const std::string& name) {
    const Json& one = widget(name);
    return {one.at("x"), one.at("y"), one.at("width"), one.at("height")};
}

std::vector<std::string> DrivenEditor::names(const std::string& beginning) {
    std::vector<std::string> found;
    for (const auto& [name, one] : probe().at("widgets").items())
        if (name.starts_with(beginning)) found.push_back(name);
    return found;
}

std::string DrivenEditor::focused() {
    for (const auto& [name, one] : probe().at("widgets").items())
        if (one.at("focused").get<bool>()) return name;
    return {};
}

std::uint64_t DrivenEditor::frames() {
    return probe().at("frames");
}

// --- Waiting

void DrivenEditor::until(const std::string& what, const std::function<bool()>& so, double seconds) {
    const auto start = std::chrono::steady_clock::now();
    while (!so()) {
        if (!runs()) fail("the program has ended before this held: " + what);
        if (std::chrono::steady_clock::now() - start > std::chrono::duration<double>(seconds))
            fail("this does not come to hold: " + what);
        std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
}

void DrivenEditor::settle() {
    if (at_once_) return;
    const auto count = [&](const char* name) {
        const Json* one = find(name);
        return one ? std::stoull(one->at("value").get<std::string>()) : 0;
    };
    until(
        "all input is processed",
        [&] {
            const Json& now = probe();
            const Json& pointer = now.at("pointer");
            return now.at("changes").get<std::uint64_t>() >= sent_ && now.at("idle").get<bool>() &&
                   pointer.at("x") == pointer_.x && pointer.at("y") == pointer_.y &&
                   count("status/posted") <= count("status/acknowledged");
        },
        20);
}

void DrivenEditor::fail(const std::string& what) {
    std::string text = what + "\nThe program printed: " + printed();
    if (probe_.is_object()) {
        text += "\nprobe: changes " + probe_["changes"].dump() + " of " + std::to_string(sent_) + ", idle " +
                probe_["idle"].dump() + ", pointer " + probe_["pointer"].dump();
        for (const char* name : {"status/text", "status/posted", "status/acknowledged"})
            if (probe_["widgets"].contains(name))
                text += "\n" + std::string(name) + ": " + probe_["widgets"][name]["value"].dump();
        for (const auto& [name, one] : probe_["widgets"].items())
            if (name.find("messages") != std::string::npos) text += "\n" + name + ": " + one["value"].dump();
    }
    throw std::runtime_error(text);
}

// --- Input

void DrivenEditor::send(const std::string& command, unsigned changes) {
    sent_ += changes;
    if (!hands_->run(command)) fail("xdotool has ended");
    settle();
}

void DrivenEditor::point_at(Point at) {
    pointer_ = {std::floor(at.x), std::floor(at.y)};
    send("mousemove " + std::to_string(static_cast<int>(pointer_.x)) + " " +
         std::to_string(static_cast<int>(pointer_.y)));
}

void DrivenEditor::press(unsigned button) {
    send("mousedown " + std::to_string(button), 1);
}

void DrivenEditor::release(unsigned button) {
    send("mouseup " + std::to_string(button), 1);
}

void DrivenEditor::move(Point to, int steps) {
    const Point from = pointer_;
    for (int i = 1; i <= steps; ++i) point_at(from + (to - from) * (static_cast<double>(i) / steps));
}

void DrivenEditor::drag(Point from, Point to) {
    point_at(from);
    press();
    move(to);
    release();
}

void DrivenEditor::click(Point at, unsigned button) {
    point_at(at);
    send("click " + std::to_string(button), 2);
}

void DrivenEditor::click(const std::string& name, unsigned button) {
    if (!shows(name))
        until(
            name + " is in sight", [&] { return shows(name); }, 10);
    click(place(name).center(), button);
}

void DrivenEditor::double_click(const std::string& name) {
    point_at(place(name).center());
    send("click --repeat 2 --delay 40 1", 4);
}

void DrivenEditor::key(const std::string& keys) {
    const auto count = static_cast<unsigned>(std::ranges::count(keys, '+')) + 1;
    send("key " + keys, 2 * count);
}

void DrivenEditor::hold(const std::string& key) {
    send("keydown " + key, 1);
}

void DrivenEditor::let_go(const std::string& key) {
    send("keyup " + key, 1);
}

void DrivenEditor::hold_until(const std::string& key, const std::string& what, const std::function<bool()>& so) {
    at_once_ = true;  // it does not settle meanwhile
    hold(key);
    at_once_ = false;
    until(what, so);
    let_go(key);
}

void DrivenEditor::type(const std::string& text) {
    // Shift is pressed as well where it is needed. A key that is pressed again within a millisecond counts as held
    // down.
    send("type --delay 8 \"" + text + "\"", 2 * static_cast<unsigned>(text.size()));
    if (!at_once_) sent_ = std::max(sent_, probe().at("changes").get<std::uint64_t>());
}

void DrivenEditor::scroll_to(const std::string& name, const std::string& panel) {
    if (shows(name)) return;
    point_at(place(panel).center());
    for (int i = 0; i < 30 && !shows(name); ++i) wheel(1);
    for (int i = 0; i < 60 && !shows(name); ++i) wheel(-1);
    if (!shows(name)) fail(name + " cannot be scrolled into sight");
}

void DrivenEditor::wheel(int notches) {
    for (int i = 0; i < std::abs(notches); ++i) {
        const std::uint64_t before = frames();
        send(notches > 0 ? "click 4" : "click 5");
        until("the wheel turns", [&] { return frames() > before; });
        settle();
    }
}

void DrivenEditor::resize(unsigned width, unsigned height) {
    point_at({4, 4});  // so that it stays in the window
    if (!hands_->run("search --onlyvisible --name weft windowsize %@ " + std::to_string(width) + " " +
                     std::to_string(height)))
        fail("xdotool has ended");
    until("the window has its new size", [&] {
        const Json& window = probe().at("window");
        return window.at("width") == width && window.at("height") == height;
    });
}

void DrivenEditor::at_once(const std::function<void()>& what) {
    at_once_ = true;
    what();
    at_once_ = false;
    settle();
}

// --- The process

double DrivenEditor::processor_seconds() const {
    std::string text = content("/proc/" + std::to_string(process_) + "/stat");
    text = text.substr(text.rfind(')') + 2);  // the program's name may have spaces
    std::istringstream in(text);
    std::string word;
    double ticks = 0;
    for (int field = 3; in >> word && field <= 15; ++field)
        if (field >= 14) ticks += std::stod(word);
    return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

void DrivenEditor::kill() {
    ::kill(process_, SIGKILL);
    (void)wait();
    (void)hands_->run("mouseup 1");  // the screen has only one mouse
}

int DrivenEditor::end_by(const std::function<void()>& what) {
    at_once_ = true;
    what();
    return wait();
}

int DrivenEditor::wait() {
    for (int i = 0; i < 6000 && runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (process_ > 0) fail("the program does not end");
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
}

bool DrivenEditor::runs() {
    if (process_ > 0 && ::waitpid(process_, &status_, WNOHANG) == process_) process_ = 0;
    return process_ > 0;
}

std::string DrivenEditor::printed() const {
    return content(output_);
}

// --- The log

Log DrivenEditor::log() const {
    auto log = read_log(log_);
    if (!log) throw std::runtime_error(log.error().message());
    return std::move(*log);
}

std::vector<Action> DrivenEditor::actions(std::string_view kind) const {
    std::vector<Action> found;
    for (TimedAction& one : log().actions)
        if (kind_of(one.action) == kind) found.push_back(std::move(one.action));
    return found;
}

Stage DrivenEditor::played() const {
    const Log all = log();
    auto stage = open_stage(all.head, {});
    if (!stage) throw std::runtime_error(stage.error().message());
    if (auto done = play(*stage, all.actions, all.end); !done) throw std::runtime_error(done.error().message());
    return std::move(*stage);
}

}  // namespace weft::editor
