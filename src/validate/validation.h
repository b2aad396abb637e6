// Compares weft with known solutions of mechanics, on any backend. Each case is a file in cases/ and a line in
// cases.def.
#pragma once

#include "solver/world/world.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace weft {

enum class Bound {
    near,      ///< |measured − expected| ≤ tolerance
    at_most,   ///< measured ≤ expected
    at_least,  ///< measured ≥ expected
};

/// A setting of a check, so that results can be sorted and plotted.
struct ValidationSetting {
    std::string_view name;  ///< the same in all cases: "cells", "gamma", "substeps", ...
    std::variant<double, std::string> value;

    template <class T>
    requires std::is_arithmetic_v<T> ValidationSetting(std::string_view of, T number)
        : name(of), value(static_cast<double>(number)) {}
    ValidationSetting(std::string_view of, std::string text) : name(of), value(std::move(text)) {}
};

/// One number against its reference.
struct ValidationCheck {
    std::string what;  ///< with its settings
    std::string unit = {};
    double measured = 0, expected = 0;
    double tolerance = 0;  ///< in `unit`; of Bound::near
    Bound bound = Bound::near;
    /// If not 0: weft is known to miss the reference. The deviation that was measured when the check was written, in
    /// `unit`; tests fail if it grows beyond that by a tenth and the tolerance.
    double known = 0;
    std::vector<ValidationSetting> settings = {};
    double ms_per_frame = 0;                          ///< wall time of a frame; 0: not measured
    std::vector<std::array<double, 2>> outline = {};  ///< m: closed outline of the cloth from above, if measured

    /// How far the number is from what it may be, in `unit`: measured − expected for Bound::near, else the part beyond
    /// the bound.
    double deviation() const;
    bool passes() const;
    /// Whether the deviation is no larger than the tolerance or the known one.
    bool is_as_known() const;
};

struct ValidationResult {
    std::string_view name;
    std::vector<ValidationCheck> checks;
    double seconds = 0;
    std::string problem = {};  ///< why the case could not run; empty: it ran
    bool passes() const;
};

/// What a case needs: worlds on the chosen backend, and where its checks go.
class Validation {
  public:
    /// `quick`: fewer resolutions and settings, for tests.
    Validation(Options options, bool quick) : options_(std::move(options)), quick_(quick) {}

    bool quick() const { return quick_; }
    /// Throws std::runtime_error if the backend cannot be made.
    World make_world(const WorldSettings& settings) const;
    void add(ValidationCheck check);
    /// A check with a tolerance in parts of the expected value.
    void add_near(std::string what, double measured, double expected, double relative, std::string unit,
                  double known_relative = 0, std::vector<ValidationSetting> settings = {});

    /// Called after each check.
    std::function<void(const ValidationCheck&)> on_check = {};
    std::vector<ValidationCheck> take_checks() { return std::move(checks_); }

  private:
    Options options_;
    bool quick_;
    std::vector<ValidationCheck> checks_;
};

struct ValidationCase {
    std::string_view name;
    std::string_view title;
    std::string_view source;     ///< of the reference values
    std::string_view shortfall;  ///< why weft misses them, as far as it does; may be empty
    void (*run)(Validation&);
};

std::span<const ValidationCase> validation_cases();
/// The case with this name, or null.
const ValidationCase* find_validation_case(std::string_view name);
/// Runs a case. Exceptions of the case become ValidationResult::problem.
ValidationResult run_case(const ValidationCase& one, Validation& validation);

}  // namespace weft
