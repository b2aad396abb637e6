// Several numbers that can be changed as one.
#include "editor/ui/expression.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/number.h"

#include <algorithm>
#include <string>

namespace weft::editor {
namespace {

bool all_equal(std::span<const double> values) {
    return std::ranges::all_of(values, [&](double one) { return one == values[0]; });
}

/// A button at the left of the control, which becomes narrower.
bool link_button(Ui& ui, ImRect& control, bool linked) {
    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos(control.Min);
    const ButtonStyle style{.icon = linked ? Icon::link : Icon::unlink,
                            .what = linked ? "Change each by itself" : "Make them equal, and change them as one",
                            .flat = true};
    const bool pressed = button(ui, "link", style);
    ImGui::SetCursorScreenPos(cursor);
    control.Min.x += button_width(ui, style) + ui.theme().px(4);
    return pressed;
}

std::string text_of(std::span<const double> values, std::string_view unit) {
    std::string text;
    for (const double one : values) text += (text.empty() ? "" : ", ") + format_number(one);
    return unit.empty() ? text : text + " " + std::string(unit);
}

class LinkedNumbers {
  public:
    LinkedNumbers(Ui& ui, const Field& field, std::span<double> values, const NumberRange& range,
                  std::span<const double> usual, std::span<const std::string_view> parts)
        : ui_(ui), field_(field), values_(values), range_(range), usual_(usual), parts_(parts) {}

    Change as_one() {
        Field whole = field_;
        whole.range = describe(range_);
        if (!usual_.empty()) {
            whole.usual = all_equal(usual_) ? format_number(usual_[0], range_.unit) : text_of(usual_, range_.unit);
            whole.differs = !std::ranges::equal(values_, usual_);
        }
        Row row = begin_row(ui_, whole);
        if (row.reset && !usual_.empty()) {
            std::ranges::copy(usual_, values_.begin());
            return Change::finished;
        }
        const Ui::Scope scope(ui_, field_.name);
        toggled = link_button(ui_, row.control, true);
        NumberRange one = range_;
        if (!usual_.empty() && all_equal(usual_)) one.usual = usual_[0];
        double value = values_[0];
        const Change change = number_in(ui_, "all", row.control, value, one, whole);
        if (change != Change::none) std::ranges::fill(values_, value);
        return change;
    }

    Change apart() {
        const Ui::Scope scope(ui_, field_.name);
        Change change = Change::none;
        for (std::size_t i = 0; i < values_.size() && i < parts_.size(); ++i) {
            NumberRange range = range_;
            if (i < usual_.size()) range.usual = usual_[i];
            const std::string label =
                i == 0 ? std::string(field_.label) + " " + std::string(parts_[i]) : "    " + std::string(parts_[i]);
            const std::string what = std::string(parts_[i]) + ": " + std::string(field_.what);
            Field one{.name = parts_[i], .label = label, .what = what, .range = describe(range)};
            if (range.usual) {
                one.usual = format_number(*range.usual, range.unit);
                one.differs = values_[i] != *range.usual;
            }
            Row row = begin_row(ui_, one);
            ImRect below = row.control;
            if (i == 0) toggled = link_button(ui_, row.control, false);
            if (i == 0) indent_ = row.control.Min.x - below.Min.x;
            row.control.Min.x = below.Min.x + indent_;
            Change made = Change::none;
            if (row.reset && range.usual)
                values_[i] = *range.usual, made = Change::finished;
            else
                made = number_in(ui_, parts_[i], row.control, values_[i], range, one);
            if (made != Change::none) change = made;
        }
        if (!toggled) return change;
        std::ranges::fill(values_, values_[0]);
        return Change::finished;
    }

    bool toggled = false;

  private:
    Ui& ui_;
    const Field& field_;
    std::span<double> values_;
    const NumberRange& range_;
    std::span<const double> usual_;
    std::span<const std::string_view> parts_;
    float indent_ = 0;
};

}  // namespace

Change linked_vector(Ui& ui, const Field& field, std::span<double> values, const NumberRange& range,
                     std::span<const double> usual, std::span<const std::string_view> parts) {
    if (usual.size() != values.size()) usual = {};
    // Kept by ImGui: whether equal numbers are shown apart, and how they were shown last.
    ImGuiStorage* const kept = ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID((std::string(field.name) + ".apart").c_str()),
                  last = ImGui::GetID((std::string(field.name) + ".linked").c_str());
    bool linked = all_equal(values) && !kept->GetBool(id);
    // A drag or a typed text goes on in the row in which it began.
    if (ImGui::GetActiveID() != 0 || ui.gesture.id != 0) linked = kept->GetBool(last, linked);
    if (kept->GetBool(last, linked) != linked) ui.redraw();
    kept->SetBool(last, linked);
    LinkedNumbers numbers(ui, field, values, range, usual, parts);
    const bool equal = all_equal(values);
    const Change change = linked ? numbers.as_one() : numbers.apart();
    if (numbers.toggled) kept->SetBool(id, linked), kept->SetBool(last, !linked), ui.redraw();
    return !linked && numbers.toggled && equal ? Change::none : change;
}

}  // namespace weft::editor
