#include "editor/ui/ui.h"

#include "editor/ui/compat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace weft::editor {
namespace {

constexpr double tooltip_delay = 0.6;  // s
constexpr int frames_to_settle = 2;    // ImGui shows some consequences, such as popups, one or two frames later
constexpr double never = std::numeric_limits<double>::infinity();

struct KeyPair {
    Key key;
    ImGuiKey imgui;
};
// Keys that ImGui's own widgets use. Tab is missing: focus_next() moves the keyboard.
constexpr KeyPair imgui_keys[] = {{Key::left, ImGuiKey_LeftArrow},
                                  {Key::right, ImGuiKey_RightArrow},
                                  {Key::up, ImGuiKey_UpArrow},
                                  {Key::down, ImGuiKey_DownArrow},
                                  {Key::page_up, ImGuiKey_PageUp},
                                  {Key::page_down, ImGuiKey_PageDown},
                                  {Key::home, ImGuiKey_Home},
                                  {Key::end, ImGuiKey_End},
                                  {Key::insert, ImGuiKey_Insert},
                                  {Key::delete_key, ImGuiKey_Delete},
                                  {Key::backspace, ImGuiKey_Backspace},
                                  {Key::space, ImGuiKey_Space},
                                  {Key::enter, ImGuiKey_Enter},
                                  {Key::escape, ImGuiKey_Escape},
                                  {Key::pad_enter, compat::pad_enter},
                                  {Key::a, ImGuiKey_A},
                                  {Key::c, ImGuiKey_C},
                                  {Key::v, ImGuiKey_V},
                                  {Key::x, ImGuiKey_X},
                                  {Key::y, ImGuiKey_Y},
                                  {Key::z, ImGuiKey_Z}};

std::size_t at(Key key) {
    return static_cast<std::size_t>(key);
}

bool focus_is_visible() {
    return GImGui->NavId != 0 && !GImGui->NavDisableHighlight;
}

}  // namespace

Ui::Ui(UiOptions options) : options_(std::move(options)), scale_(options_.scale), appearance_(options_.appearance) {
    IMGUI_CHECKVERSION();
    context_ = ImGui::CreateContext();
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors | ImGuiBackendFlags_RendererHasVtxOffset;
    io.ConfigInputTextCursorBlink = false;  // an idle window needs no frames
    io.ConfigWindowsMoveFromTitleBarOnly = true;
#if IMGUI_VERSION_NUM >= 18700
    io.ConfigInputTrickleEventQueue = false;  // InputFrames does that
#else
    for (const KeyPair& one : imgui_keys) io.KeyMap[one.imgui] = static_cast<int>(one.key);
#endif
    io.ClipboardUserData = this;
    io.GetClipboardTextFn = [](void* self) {
        Ui& ui = *static_cast<Ui*>(self);
        if (ui.options_.clipboard) ui.clipboard_ = ui.options_.clipboard();
        return ui.clipboard_.c_str();
    };
    io.SetClipboardTextFn = [](void* self, const char* text) {
        Ui& ui = *static_cast<Ui*>(self);
        ui.clipboard_ = text;
        if (ui.options_.set_clipboard) ui.options_.set_clipboard(text);
    };
}

Ui::~Ui() {
    ImGui::DestroyContext(context_);
}

// --- A frame

void Ui::add(const std::vector<render::WindowEvent>& events, float pixels_per_unit) {
    frames_.add(events, pixels_per_unit);
    if (!events.empty()) settling_ = frames_to_settle;
}

void Ui::set_theme(Appearance appearance, float scale) {
    scale = std::clamp(scale, least_scale, most_scale);
    if (appearance == appearance_ && scale == scale_) return;
    appearance_ = appearance;
    scale_ = scale;
    new_theme_ = true;
    redraw();
}

void Ui::apply_theme() {
    theme_ = make_theme(*context_, appearance_, scale_);
    context_->IO.MouseDoubleClickMaxDist = theme_.px(6);
    context_->IO.MouseDragThreshold = theme_.px(3);
    new_fonts_ = true;
    new_theme_ = false;
}

void Ui::begin(float width, float height, double now) {
    ImGui::SetCurrentContext(context_);
    if (new_theme_) apply_theme();
    if (asked_.exchange(false)) settling_ = std::max(settling_, 1);
    if (now >= due_) due_ = never;
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(std::max(1.0f, width), std::max(1.0f, height));
    // While the keyboard moves on to a widget, the next key waits for it.
    input_ = frames_.next(now, wants_text(), focus_wanted_ != 0 || !focus_path_.empty());
    // ImGui's clock is that of the events, so that a double click is one even if frames are slow.
    io.DeltaTime = static_cast<float>(std::max(last_time_ < 0 ? 1.0 / 60 : input_.time - last_time_, 1e-5));
    last_time_ = input_.time;
    feed();
    kept_digits_ = std::exchange(keeps_digits_, false);
    kept_delete_ = std::exchange(keeps_delete_, false);
    released_space_ = std::exchange(releases_space_, false);
    if (focus_wanted_ == 0 && focus_path_.empty()) focus_typing_ = false;
    probe_.begin_frame();
    probe_.width = width;
    probe_.height = height;
    probe_.scale = theme_.scale;
    probe_.changes = input_.changes;
    probe_.pointer_x = input_.pointer ? input_.pointer->x : -1;
    probe_.pointer_y = input_.pointer ? input_.pointer->y : -1;
    last_stops_ = std::exchange(stops_, {});
    had_popup_ = !context_->OpenPopupStack.empty();
    ImGui::NewFrame();
    update_focus();
}

// Hands the frame's input to ImGui.
void Ui::feed() {
    ImGuiIO& io = ImGui::GetIO();
    const Modifiers modifiers = input_.modifiers();
    const ImVec2 pointer = input_.pointer ? ImVec2(input_.pointer->x, input_.pointer->y) : ImVec2(-FLT_MAX, -FLT_MAX);
#if IMGUI_VERSION_NUM >= 18700
    io.AddFocusEvent(input_.focused);
    io.AddMousePosEvent(pointer.x, pointer.y);
    for (int i = 0; i < 5; ++i) io.AddMouseButtonEvent(i, input_.buttons[static_cast<std::size_t>(i)]);
    if (input_.wheel != Vec2{}) io.AddMouseWheelEvent(input_.wheel.x, input_.wheel.y);
    io.AddKeyEvent(ImGuiMod_Shift, modifiers.shift);
    io.AddKeyEvent(ImGuiMod_Ctrl, modifiers.control);
    io.AddKeyEvent(ImGuiMod_Alt, modifiers.alt);
    io.AddKeyEvent(ImGuiMod_Super, modifiers.super);
    for (const KeyPair& one : imgui_keys) io.AddKeyEvent(one.imgui, input_.label_down[at(one.key)]);
#else
    io.MousePos = pointer;
    for (std::size_t i = 0; i < 5; ++i) io.MouseDown[i] = input_.buttons[i];
    io.MouseWheel = input_.wheel.y;
    io.MouseWheelH = input_.wheel.x;
    io.KeyShift = modifiers.shift;
    io.KeyCtrl = modifiers.control;
    io.KeyAlt = modifiers.alt;
    io.KeySuper = modifiers.super;
    for (const KeyPair& one : imgui_keys) io.KeysDown[at(one.key)] = input_.label_down[at(one.key)];
#endif
    for (const char32_t character : input_.text) io.AddInputCharacter(static_cast<unsigned>(character));
}

const ImDrawData& Ui::end() {
    ImGui::Render();
    ++probe_.frames;
    if (settling_ > 0) --settling_;
    if (focus_wanted_ != 0 && focus_wanted_ == focus_missed_) focus_wanted_ = 0;  // the widget is gone
    focus_missed_ = focus_wanted_;
    if (!focus_path_.empty() && settling_ == 0) focus_path_.clear();  // there is no such widget
    probe_.idle = !wants_frame() && !frames_.pending();
    if (probe_.idle) ++probe_.settled;
    return *ImGui::GetDrawData();
}

bool Ui::take_new_fonts() {
    return std::exchange(new_fonts_, false);
}

ImVec2 Ui::size() const {
    return context_->IO.DisplaySize;
}

// --- Input

bool Ui::pressed(Key key, bool repeat) const {
    return std::ranges::any_of(input_.keys, [&](const InputFrame::Press& one) {
        return one.label == key && one.down && (repeat || !one.repeated);
    });
}

bool Ui::shortcut(Key label, Modifiers modifiers) const {
    const bool plain = !modifiers.control && !modifiers.alt && !modifiers.super;
    if (wants_text()) {
        constexpr Key editing[] = {Key::a, Key::c,    Key::v,     Key::x,         Key::y,
                                   Key::z, Key::left, Key::right, Key::backspace, Key::delete_key};
        const bool function = label >= Key::f1 && label <= Key::f12;
        if ((plain && !function) || std::ranges::find(editing, label) != std::end(editing)) return false;
    }
    // Who chooses all in a number field means its text.
    if ((kept_digits_ || keeps_digits_) && label == Key::a && modifiers.control) return false;
    if (plain && focus_is_visible()) {
        constexpr Key steering[] = {Key::space, Key::enter, Key::pad_enter, Key::left,    Key::right,    Key::up,
                                    Key::down,  Key::home,  Key::end,       Key::page_up, Key::page_down};
        const bool released = label == Key::space && (released_space_ || releases_space_);
        if (!released && std::ranges::find(steering, label) != std::end(steering)) return false;
        const bool digit = (label >= Key::digit_0 && label <= Key::digit_9) || label == Key::minus ||
                           label == Key::period || (label >= Key::pad_0 && label <= Key::pad_add);
        if ((kept_digits_ || keeps_digits_) && digit) return false;
        if ((kept_delete_ || keeps_delete_) && (label == Key::delete_key || label == Key::backspace)) return false;
    }
    return std::ranges::any_of(input_.keys, [&](const InputFrame::Press& one) {
        return one.label == label && one.down && !one.repeated && one.modifiers == modifiers;
    });
}

bool Ui::wants_pointer() const {
    return context_->IO.WantCaptureMouse;
}

bool Ui::wants_text() const {
    return gesture.typing || (context_->IO.WantTextInput && context_->ActiveId != 0);
}

// --- When to draw again

void Ui::redraw() {
    asked_ = true;
    if (on_redraw) on_redraw();
}

void Ui::redraw_in(double seconds) {
    due_ = std::min(due_, now() + seconds);
}

bool Ui::wants_frame() const {
    return settling_ > 0 || asked_ || frames_.pending() || new_theme_;
}

double Ui::due_in(double now) const {
    return wants_frame() ? 0 : due_ - now;
}

// --- Names and focus

// ImGui shows no label for ids that begin with "##".
std::string Ui::label_of(std::string_view name) {
    return "##" + std::string(name);
}

ImGuiID Ui::id_of(std::string_view name) {
    return ImGui::GetCurrentWindow()->GetID(label_of(name).c_str());
}

Ui::Scope::Scope(Ui& ui, std::string_view name) : ui_(ui) {
    ImGui::PushID(name.data(), name.data() + name.size());
    ui.probe_.push(name);
}

Ui::Scope::~Scope() {
    ui_.probe_.pop();
    ImGui::PopID();
}

Item Ui::place(std::string_view name, ImVec2 size, std::string_view value) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImRect box(from, from + size);
    ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
    return place_at(name, box, value);
}

Item Ui::place_at(std::string_view name, const ImRect& box, std::string_view value, bool reachable) {
    ImGuiWindow* window = ImGui::GetCurrentWindow();
    Item item;
    item.box = box;
    item.id = id_of(name);
    // Widgets that are scrolled out of sight can get the keyboard, and are then scrolled into view.
    const bool enabled = (GImGui->CurrentItemFlags & ImGuiItemFlags_Disabled) == 0;
    const bool wanted =
        (focus_wanted_ == item.id || (!focus_path_.empty() && focus_path_ == probe_.path(name))) && enabled;
    item.visible = ImGui::ItemAdd(box, item.id);
    if (reachable && enabled) stops_.push_back({item.id, window});
    if (wanted) {
        focus_wanted_ = 0;
        focus_path_.clear();
        ImGui::FocusWindow(window);
        ImGui::SetFocusID(item.id, window);
        GImGui->NavDisableHighlight = false;
        GImGui->NavDisableMouseHover = true;
        ImGui::ScrollToRect(window, box, ImGuiScrollFlags_KeepVisibleEdgeY);
        settling_ = std::max(settling_, frames_to_settle);
    }
    item.hovered = item.visible && compat::hoverable(box, item.id);
    item.focused = GImGui->NavId == item.id && !GImGui->NavDisableHighlight && GImGui->NavWindow == window;
    probe_.add(name, box, window->ClipRect, enabled, item.focused, value);
    return item;
}

void Ui::note(std::string_view name, const ImRect& box, std::string_view value) {
    probe_.add(name, box, ImGui::GetCurrentWindow()->ClipRect, true, false, value);
}

void Ui::update_focus() {
    if (!pressed(Key::tab, true)) return;
    const Modifiers held = input_.modifiers();
    if (held.control || held.alt || held.super || gesture.typing) return;  // a field that is typed into ends first
    focus_next(!held.shift, false);
}

void Ui::focus_next(bool forward, bool typing) {
    const std::vector<Stop>& stops = last_stops_;
    const ImGuiID now = context_->ActiveId != 0 ? context_->ActiveId : context_->NavId;
    // An open popup keeps the keyboard.
    const ImGuiWindow* popup = context_->OpenPopupStack.Size > 0 ? context_->OpenPopupStack.back().Window : nullptr;
    std::vector<ImGuiID> order;
    for (const Stop& stop : stops)
        if (!popup || (stop.window && stop.window->RootWindow == popup)) order.push_back(stop.id);
    if (order.empty()) return;
    const auto found = std::ranges::find(order, now);
    const auto count = static_cast<std::ptrdiff_t>(order.size());
    std::ptrdiff_t next = forward ? 0 : count - 1;
    if (found != order.end()) next = (found - order.begin() + (forward ? 1 : -1) + count) % count;
    focus_wanted_ = order[static_cast<std::size_t>(next)];
    focus_typing_ = typing;
    settling_ = std::max(settling_, frames_to_settle);
    if (context_->ActiveId != 0) ImGui::ClearActiveID();
}

void Ui::focus(std::string_view path, bool typing) {
    focus_path_ = path;
    focus_typing_ = typing;
    settling_ = std::max(settling_, frames_to_settle + 1);  // the widget may be new in the next frame
    redraw();
}

bool Ui::takes_typing(const Item& item) {
    return item.focused && focus_wanted_ == 0 && std::exchange(focus_typing_, false);
}

void Ui::draw_focus(const Item& item) const {
    if (!item.focused) return;
    const float width = theme_.px(2);
    const ImRect ring(item.box.Min - ImVec2(width, width), item.box.Max + ImVec2(width, width));
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRect(ring.Min + ImVec2(0.5f * width, 0.5f * width), ring.Max - ImVec2(0.5f * width, 0.5f * width),
                  theme_.color(theme_.colors.focus), ImGui::GetStyle().FrameRounding + 1, 0, width);
}

void Ui::keep_arrows(const Item& item) const {
    if (!item.focused) return;
    const ImGuiContext& g = *context_;
    if (g.NavMoveSubmitted && (g.NavMoveDir == ImGuiDir_Left || g.NavMoveDir == ImGuiDir_Right))
        ImGui::NavMoveRequestCancel();
}

// Beside the panel, so that it covers no other row; else below or above the item. Always within the window.
ImVec2 Ui::place_of_tooltip(const ImRect& item, const ImRect& panel, ImVec2 tip) const {
    const float gap = theme_.px(6);
    const ImVec2 most(std::max(gap, size().x - tip.x - gap), std::max(gap, size().y - tip.y - gap));
    const bool is_panel = panel.GetWidth() < size().x / 2;
    const float left = panel.Min.x - gap - tip.x, right = panel.Max.x + gap;
    if (is_panel && left >= gap) return {left, std::clamp(item.Min.y, gap, most.y)};
    if (is_panel && right <= most.x) return {right, std::clamp(item.Min.y, gap, most.y)};
    const float below = item.Max.y + gap, above = item.Min.y - gap - tip.y;
    return {std::clamp(item.Min.x, gap, most.x), below <= most.y || above < gap ? std::min(below, most.y) : above};
}

void Ui::tooltip(const Item& item, const std::function<void()>& content) {
    const bool rests = (item.hovered && !focus_is_visible()) || item.focused;
    const bool busy = context_->ActiveId == item.id || context_->IO.MouseDown[0];
    if (!rests || busy) {
        if (tip_ == item.id) tip_ = 0;
        return;
    }
    if (tip_ != item.id) {
        tip_ = item.id;
        tip_since_ = now();
        tip_size_ = {};
    }
    const double left = tip_since_ + tooltip_delay - now();
    if (left > 0) {
        redraw_in(left);
        return;
    }
    ImGui::SetNextWindowPos(place_of_tooltip(item.box, ImGui::GetCurrentWindow()->Rect(), tip_size_));
    // The panel around the widget may have no padding.
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme_.px(8), theme_.px(6)));
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(std::min(theme_.px(340), size().x - theme_.px(28)));
    content();
    ImGui::PopTextWrapPos();
    const ImVec2 shown = ImGui::GetWindowSize();
    if (shown.x != tip_size_.x || shown.y != tip_size_.y) redraw();  // it is placed when its size is known
    tip_size_ = shown;
    note("tooltip", ImRect(ImGui::GetWindowPos(), ImGui::GetWindowPos() + shown), "");
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

}  // namespace weft::editor
