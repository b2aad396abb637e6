#include "editor/ui/widgets/number.h"

#include "editor/ui/expression.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace weft::editor {
namespace {

constexpr double fine = 0.1;

/// A number field in its frame.
class NumberField {
  public:
    NumberField(Ui& ui, std::string_view name, const ImRect& box, double& value, const NumberRange& range,
                const Field& tip, std::string_view prefix)
        : ui_(ui), name_(name), box_(box), value_(value), range_(range), tip_(tip), prefix_(prefix) {}

    Change run() {
        item_ = ui_.place_at(name_, box_, format_number(value_, range_.unit));
        if (is_typing(ui_, item_)) return type();
        Change change = Change::none;
        if (item_.focused) change = obey_keys();
        if (change == Change::none) change = obey_pointer();
        if (change == Change::none) change = end_of_keys();
        if (is_typing(ui_, item_)) return type();
        draw();
        if (ImGui::GetActiveID() != item_.id) field_tooltip(ui_, item_, tip_);
        return change;
    }

  private:
    Change set(double value, Change change) {
        value = clamped(value, range_);
        const bool same = value == value_;
        value_ = value;
        ui_.redraw();
        return change == Change::in_progress && same ? Change::none : change;
    }
    Change reset() {
        if (!range_.usual || value_ == *range_.usual) return Change::none;
        return set(*range_.usual, Change::finished);
    }

    Change obey_keys() {
        ui_.keep_arrows(item_);
        ui_.keep_digits();
        ui_.keep_delete();
        ui_.release_space();
        if (ui_.pressed(Key::enter) || ui_.pressed(Key::pad_enter) || ui_.pressed(Key::f2) || ui_.takes_typing(item_)) {
            begin_typing(ui_, item_, format_number(value_, 9));
            return Change::none;
        }
        const std::u32string& typed = ui_.input().text;
        constexpr std::u32string_view first = U"0123456789.,-+(*/";
        if (!typed.empty() && first.find(typed[0]) != std::u32string_view::npos) {
            begin_typing_over(ui_, item_);
            return Change::none;
        }
        if (ui_.pressed(Key::delete_key) || ui_.pressed(Key::backspace)) return reset();
        const int steps =
            static_cast<int>(ui_.pressed(Key::right, true)) - static_cast<int>(ui_.pressed(Key::left, true));
        if (steps == 0) return Change::none;
        Ui::Gesture& gesture = ui_.gesture;
        if (gesture.id != item_.id || !gesture.keys) {
            gesture = {};
            gesture.id = item_.id;
            gesture.keys = true;
            gesture.start = value_;
        }
        const Modifiers held = ui_.input().modifiers();
        if (range_.integer) return set(value_ + steps * (held.shift ? 10 : 1), Change::in_progress);
        const Track track(range_, gesture.start);
        const double to = track.value(track.position(value_) + steps * (held.shift ? 0.02 * fine : 0.02));
        return set(track.rounded(to, held.shift ? 1000 : 100), Change::in_progress);
    }

    // Steps by arrow keys are one gesture until the key is released.
    Change end_of_keys() {
        Ui::Gesture& gesture = ui_.gesture;
        if (gesture.id != item_.id || !gesture.keys) return Change::none;
        const auto held = [&](Key key) { return ui_.input().label_down[static_cast<std::size_t>(key)]; };
        if (item_.focused && (held(Key::left) || held(Key::right))) return Change::none;
        gesture = {};
        return Change::finished;
    }

    Change obey_pointer() {
        const ImGuiIO& io = ImGui::GetIO();
        Ui::Gesture& gesture = ui_.gesture;
        ImGuiWindow* window = ImGui::GetCurrentWindow();
        if (item_.hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        if (item_.hovered && io.MouseClicked[0]) {
            ImGui::FocusWindow(window);
            ImGui::SetFocusID(item_.id, window);
            if (io.MouseClickedCount[0] == 2 && range_.usual) {
                if (ImGui::GetActiveID() == item_.id) ImGui::ClearActiveID();
                gesture = {};
                return reset();
            }
            if (io.KeyCtrl || io.MouseClickedCount[0] == 2) {
                begin_typing(ui_, item_, format_number(value_, 9));
                return Change::none;
            }
            ImGui::SetActiveID(item_.id, window);
            gesture = {};
            gesture.id = item_.id;
            gesture.start = value_;
            gesture.position = Track(range_, value_).position(value_);
            gesture.pointer = static_cast<double>(io.MousePos.x);
            return Change::none;
        }
        if (gesture.id != item_.id || gesture.keys || gesture.typing) return Change::none;
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        if (ui_.pressed(Key::escape)) {
            const bool moved = gesture.moved;
            value_ = gesture.start;
            gesture = {};
            if (ImGui::GetActiveID() == item_.id) ImGui::ClearActiveID();
            ui_.redraw();
            return moved ? Change::cancelled : Change::none;
        }
        if (!io.MouseDown[0] || ImGui::GetActiveID() != item_.id) return release();
        return drag();
    }

    Change drag() {
        const ImGuiIO& io = ImGui::GetIO();
        Ui::Gesture& gesture = ui_.gesture;
        const double by = static_cast<double>(io.MousePos.x) - gesture.pointer,
                     width = static_cast<double>(box_.GetWidth());
        if (by == 0 || (!gesture.moved && std::abs(by) < static_cast<double>(io.MouseDragThreshold)))
            return Change::none;
        gesture.moved = true;
        gesture.pointer += by;
        gesture.position += by / width * (io.KeyShift ? fine : 1);
        const Track track(range_, gesture.start);
        double to = track.value(gesture.position);
        if (io.KeyCtrl) {
            const double step =
                range_.snap > 0 ? range_.snap : std::pow(10, std::floor(std::log10(std::max(1e-9, std::abs(to)))));
            return set(std::round(to / step) * step, Change::in_progress);
        }
        return set(track.rounded(to, io.KeyShift ? width / fine : width), Change::in_progress);
    }

    Change release() {
        const bool moved = ui_.gesture.moved;
        ui_.gesture = {};
        if (ImGui::GetActiveID() == item_.id) ImGui::ClearActiveID();
        if (moved) return Change::finished;
        GImGui->NavDisableHighlight = false;  // after a click keys go here
        ui_.keep_digits();
        ui_.release_space();
        ui_.redraw();
        return Change::none;
    }

    Change type() {
        const Typed typed = type_into(ui_, item_, name_, box_);
        const auto result = evaluate(typed.text, range_.unit, value_);
        if (typed.active) {
            if (typed.text.empty()) return Change::none;
            note_typed(result);
            return Change::none;
        }
        if (typed.cancelled || typed.text.empty()) return Change::none;
        if (!result) {
            // Enter on what cannot be understood goes on typing; the note says why.
            if (!typed.entered) return Change::none;
            begin_typing(ui_, item_, typed.text, true);
            ui_.gesture.took_text = true;
            return type();
        }
        const double before = value_;
        set(*result, Change::finished);
        return value_ == before ? Change::none : Change::finished;
    }

    // What the text means, below the field.
    void note_typed(const Result<double>& result) const {
        const Theme& theme = ui_.theme();
        std::string note;
        Icon icon = Icon::none;
        if (!result) {
            icon = Icon::warning;
            note = result.error().what;
        } else if (const double kept = clamped(*result, range_); kept != *result) {
            icon = Icon::warning;
            note = format_number(kept, range_.unit) + (kept < *result ? " is the most" : " is the least");
            if (range_.integer && std::abs(kept - *result) < 1) note = "= " + format_number(kept, range_.unit);
        } else {
            note = "= " + format_number(*result, range_.unit, 6);
        }
        ImGui::SetNextWindowPos(ImVec2(box_.Min.x, box_.Max.y + theme.px(4)));
        ImGui::BeginTooltip();
        if (icon != Icon::none) {
            ImGui::PushStyleColor(ImGuiCol_Text, theme.colors.warning);
            ImGui::TextUnformatted(text_of(icon).c_str());
            ImGui::PopStyleColor();
            ImGui::SameLine();
        }
        ImGui::TextUnformatted(note.c_str());
        ImGui::EndTooltip();
    }

    void draw() const {
        if (!item_.visible) return;
        const Theme& theme = ui_.theme();
        draw_field(ui_, item_, ImGui::GetActiveID() == item_.id);
        draw_bar();
        std::string number = format_number(value_);
        const bool close = range_.unit == "°" || range_.unit == "%";  // no space before these
        const std::string unit = range_.unit.empty() ? "" : (close ? "" : " ") + std::string(range_.unit);
        const float padding = theme.px(prefix_.empty() ? 6 : 4);
        ImRect inner(box_.Min + ImVec2(padding, 0), box_.Max - ImVec2(padding, 0));
        const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text), muted = ImGui::GetColorU32(ImGuiCol_TextDisabled);
        const float named =
            prefix_.empty() ? 0 : ImGui::CalcTextSize(prefix_.data(), prefix_.data() + prefix_.size()).x + theme.px(3);
        if (named > 0 && ImGui::CalcTextSize(number.c_str()).x <= inner.GetWidth() - named) {
            clipped_text(inner, prefix_, muted);
            inner.Min.x += named;
        }
        for (int digits = 3; digits > 1 && ImGui::CalcTextSize(number.c_str()).x > inner.GetWidth(); --digits)
            number = format_short(value_, digits);
        if (ImGui::CalcTextSize(number.c_str()).x > inner.GetWidth()) {  // before a digit is hidden, the padding goes
            inner.Min.x = box_.Min.x + theme.px(1);
            inner.Max.x = box_.Max.x - theme.px(1);
            if (ImGui::CalcTextSize(number.c_str()).x > inner.GetWidth()) number = format_short(value_, 1);
        }
        const float wide = ImGui::CalcTextSize(number.c_str()).x, whole = wide + ImGui::CalcTextSize(unit.c_str()).x;
        if (whole > inner.GetWidth() || !prefix_.empty()) {  // the label of a vector has its unit
            clipped_text(inner, number, text, prefix_.empty() ? 0.5f : 1.0f);
            return;
        }
        const float x = std::floor(inner.Min.x + 0.5f * (inner.GetWidth() - whole));
        const float y = std::floor(box_.Min.y + (box_.GetHeight() - ImGui::GetFontSize()) / 2);
        ImDrawList* list = ImGui::GetWindowDrawList();
        list->AddText(ImVec2(x, y), text, number.c_str());
        list->AddText(ImVec2(x + wide, y), muted, unit.c_str());
    }

    // The part of the range below the value, from zero if zero is within.
    void draw_bar() const {
        const bool dragged = ui_.gesture.id == item_.id && (ui_.gesture.moved || ui_.gesture.keys);
        const Track track(range_, dragged ? ui_.gesture.start : value_);
        if (!track.bounded() || !prefix_.empty()) {
            ui_.draw_focus(item_);
            return;
        }
        const auto at = [&](double value) {
            return std::floor(box_.Min.x +
                              static_cast<float>(std::clamp(track.position(value), 0.0, 1.0)) * box_.GetWidth());
        };
        const double zero = std::clamp(0.0, range_.min, std::max(range_.min, range_.max));
        const float from = std::min(at(zero), at(value_)), to = std::max(at(zero), at(value_));
        const Palette& colors = ui_.theme().colors;
        ImDrawList* list = ImGui::GetWindowDrawList();
        const float round = ImGui::GetStyle().FrameRounding;
        if (to - from > 0) {
            const bool left = from <= box_.Min.x + round, right = to >= box_.Max.x - round;
            const ImDrawFlags corners = left && right ? ImDrawFlags_RoundCornersAll
                                        : left        ? ImDrawFlags_RoundCornersLeft
                                        : right       ? ImDrawFlags_RoundCornersRight
                                                      : ImDrawFlags_RoundCornersNone;
            list->AddRectFilled(ImVec2(from, box_.Min.y), ImVec2(to, box_.Max.y), ui_.theme().color(colors.fill),
                                to - from > 2 * round ? round : 0, corners);
        }
        const float line = ui_.theme().px(2),
                    x = std::clamp(at(value_) - line / 2, box_.Min.x + line, box_.Max.x - 2 * line);
        // Two notches, so that no line crosses the number.
        const ImU32 notch = ui_.theme().color(colors.accent_text);
        list->AddRectFilled(ImVec2(x, box_.Min.y), ImVec2(x + line, box_.Min.y + 2.5f * line), notch);
        list->AddRectFilled(ImVec2(x, box_.Max.y - 2.5f * line), ImVec2(x + line, box_.Max.y), notch);
        ui_.draw_focus(item_);
    }

    Ui& ui_;
    std::string_view name_;
    ImRect box_;
    double& value_;
    const NumberRange& range_;
    const Field& tip_;
    std::string_view prefix_;
    Item item_;
};

/// The field with what its tooltip says about the range and the default.
Field with_range(Field field, const NumberRange& range, double value) {
    if (field.range.empty()) field.range = describe(range);
    if (range.usual) {
        field.usual = format_number(*range.usual, range.unit);
        field.differs = value != *range.usual;
    }
    return field;
}

}  // namespace

Change number_in(Ui& ui, std::string_view name, const ImRect& box, double& value, const NumberRange& range,
                 const Field& tip, std::string_view prefix) {
    return NumberField(ui, name, box, value, range, tip, prefix).run();
}

Change number(Ui& ui, const Field& field, double& value, const NumberRange& range) {
    const Field whole = with_range(field, range, value);
    const Row row = begin_row(ui, whole);
    if (row.reset && range.usual) {
        value = *range.usual;
        return Change::finished;
    }
    return number_in(ui, field.name, row.control, value, range, whole);
}

Change integer(Ui& ui, const Field& field, long long& value, NumberRange range) {
    range.integer = true;
    double as_number = static_cast<double>(value);
    const Change change = number(ui, field, as_number, range);
    value = static_cast<long long>(std::llround(as_number));
    return change;
}

Change angle(Ui& ui, const Field& field, double& degrees, NumberRange range) {
    range.unit = "°";
    range.snap = 15;
    return number(ui, field, degrees, range);
}

Change vector(Ui& ui, const Field& field, std::span<double> values, const NumberRange& range,
              std::span<const double> usual, std::span<const std::string_view> parts) {
    constexpr std::array<std::string_view, 4> usual_names = {"x", "y", "z", "w"};
    const std::span<const std::string_view> names = parts.size() == values.size() ? parts : usual_names;
    Field whole = field;
    if (whole.range.empty()) whole.range = describe(range);
    if (usual.size() == values.size()) {
        whole.differs = !std::ranges::equal(values, usual);
        whole.usual.clear();
        for (const double one : usual) whole.usual += (whole.usual.empty() ? "" : ", ") + format_number(one);
        if (!range.unit.empty()) whole.usual += " " + std::string(range.unit);
    }
    const std::string label =
        std::string(field.label) + (range.unit.empty() ? "" : " (" + std::string(range.unit) + ")");
    whole.label = label;
    const Row row = begin_row(ui, whole);
    if (row.reset && whole.differs) {
        std::ranges::copy(usual, values.begin());
        return Change::finished;
    }
    const Ui::Scope scope(ui, field.name);
    const float gap = ui.theme().px(4), count = static_cast<float>(values.size());
    const float width = std::floor((row.control.GetWidth() - gap * (count - 1)) / count);
    Change change = Change::none;
    for (std::size_t i = 0; i < values.size() && i < names.size(); ++i) {
        const float x = row.control.Min.x + static_cast<float>(i) * (width + gap);
        NumberRange one = range;
        if (whole.usual.empty() == false) one.usual = usual[i];
        const ImRect box(ImVec2(x, row.control.Min.y), ImVec2(x + width, row.control.Max.y));
        // Where the name does not fit beside the number, the tooltip has it.
        const std::string what = std::string(names[i]) + ": " + std::string(field.what);
        Field tip = whole;
        if (!parts.empty()) tip.what = what;
        const Change made = number_in(ui, names[i], box, values[i], one, tip, names[i]);
        if (made != Change::none) change = made;
    }
    return change;
}

}  // namespace weft::editor
