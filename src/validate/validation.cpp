#include "validate/validation.h"

#include "weft/backends.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace weft {

#define WEFT_CASE(name, title, source, shortfall) void validate_##name(Validation&);
#include "validate/cases.def"
#undef WEFT_CASE

namespace {

constexpr ValidationCase all_cases[] = {
#define WEFT_CASE(name, title, source, shortfall) {#name, title, source, shortfall, validate_##name},
#include "validate/cases.def"
#undef WEFT_CASE
};

}  // namespace

double ValidationCheck::deviation() const {
    switch (bound) {
        case Bound::near:
            return measured - expected;
        case Bound::at_most:
            return std::max(measured - expected, 0.0);
        default:
            return std::min(measured - expected, 0.0);
    }
}

// NaN passes nothing.
bool ValidationCheck::passes() const {
    return std::abs(deviation()) <= (bound == Bound::near ? tolerance : 0);
}

bool ValidationCheck::is_as_known() const {
    return passes() || (known != 0 && std::abs(deviation()) <= 1.1 * std::abs(known) + tolerance);
}

bool ValidationResult::passes() const {
    return problem.empty() && !checks.empty() && std::ranges::all_of(checks, &ValidationCheck::passes);
}

World Validation::make_world(const WorldSettings& settings) const {
    auto backend = make_backend(options_);
    if (!backend) throw std::runtime_error(backend.error().message());
    return World(std::move(*backend), settings);
}

void Validation::add(ValidationCheck check) {
    checks_.push_back(std::move(check));
    if (on_check) on_check(checks_.back());
}

void Validation::add_near(std::string what, double measured, double expected, double relative, std::string unit,
                          double known_relative, std::vector<ValidationSetting> settings) {
    add({.what = std::move(what),
         .unit = std::move(unit),
         .measured = measured,
         .expected = expected,
         .tolerance = relative * std::abs(expected),
         .known = known_relative * std::abs(expected),
         .settings = std::move(settings)});
}

std::span<const ValidationCase> validation_cases() {
    return all_cases;
}

const ValidationCase* find_validation_case(std::string_view name) {
    const auto found = std::ranges::find(all_cases, name, &ValidationCase::name);
    return found == std::end(all_cases) ? nullptr : &*found;
}

ValidationResult run_case(const ValidationCase& one, Validation& validation) {
    ValidationResult result{.name = one.name, .checks = {}};
    const auto begin = std::chrono::steady_clock::now();
    try {
        one.run(validation);
    } catch (const std::exception& error) {
        result.problem = error.what();
    }
    result.checks = validation.take_checks();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

}  // namespace weft
