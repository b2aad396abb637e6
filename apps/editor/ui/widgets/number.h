// Number fields: drag, type with a unit, step by arrow keys, reset.
#pragma once

#include "base/parameter.h"
#include "editor/ui/widgets/field.h"

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace weft::editor {

struct NumberRange {
    double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
    bool min_excluded = false, zero_too = false;  ///< as in Parameter
    std::string_view unit = {};
    std::optional<double> usual = {};  ///< the default
    bool integer = false;
    double snap = 0;  ///< step while Ctrl is held; 0: by the range
};

/// The range of a parameter, without a default.
NumberRange range_of(const Parameter& parameter);
/// "0 … 1000 N/m", "> 0 kg/m²"; empty without limits.
std::string describe(const NumberRange& range);
/// The nearest value within the range.
double clamped(double value, const NumberRange& range);

/// Where a value lies along its slider: linear, or logarithmic if the range spans decades.
class Track {
  public:
    /// `value`: when the drag begins. A range without end gets an end from it and the default.
    Track(const NumberRange& range, double value);
    bool bounded() const { return bounded_; }  ///< whether it has both ends, so that a bar shows the position
    bool logarithmic() const { return knee_ > 0; }
    double position(double value) const;  ///< 0…1 from end to end
    double value(double position) const;
    /// Rounded to what a drag over a field of so many pixels resolves, so that scenes hold 0.25 and not 0.2487.
    double rounded(double value, double pixels) const;

  private:
    double min_ = 0, max_ = 1, knee_ = 0;  // knee: below it about linear, above logarithmic; 0: all linear
    bool bounded_ = true, integer_ = false;
};

/// A drag over the whole field moves from one end to the other; Shift moves a tenth as far, Ctrl goes in steps. A click
/// gives the field the keyboard: arrows step, Enter or a digit begins to type, Delete resets. Ctrl+click types at once,
/// a double click resets.
Change number(Ui& ui, const Field& field, double& value, const NumberRange& range);
Change integer(Ui& ui, const Field& field, long long& value, NumberRange range);
/// Degrees; Ctrl goes in steps of 15°.
Change angle(Ui& ui, const Field& field, double& degrees, NumberRange range = {});
/// Two to four numbers in a row, named NAME/x, NAME/y, …. `usual`: the defaults; empty or as many. `parts`: the names
/// of the numbers, such as `static` and `kinetic`, if they are not along x, y, z and w.
Change vector(Ui& ui, const Field& field, std::span<double> values, const NumberRange& range,
              std::span<const double> usual = {}, std::span<const std::string_view> parts = {});
/// Numbers that are often equal, such as the stiffness along warp and weft. Equal ones are one number, NAME/all, which
/// sets all of them; others have a row each, NAME/PART. The button NAME/link changes between both.
Change linked_vector(Ui& ui, const Field& field, std::span<double> values, const NumberRange& range,
                     std::span<const double> usual, std::span<const std::string_view> parts);
/// A number without a row of its own. `prefix`: shown at the left, "x".
Change number_in(Ui& ui, std::string_view name, const ImRect& box, double& value, const NumberRange& range,
                 const Field& tip, std::string_view prefix = {});

}  // namespace weft::editor
