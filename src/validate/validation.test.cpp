#include "validate/validation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace weft {
namespace {

// The same code as `weft validate`, with fewer settings. Where weft is known to miss a reference, the deviation must
// not grow.
class ValidationCases : public testing::TestWithParam<ValidationCase> {};

// Labels: slow no-asan
TEST_P(ValidationCases, are_as_known) {
    Validation validation({.backend = "cpu"}, true);
    const ValidationResult result = run_case(GetParam(), validation);
    EXPECT_EQ(result.problem, "");
    EXPECT_FALSE(result.checks.empty());
    for (const ValidationCheck& check : result.checks)
        EXPECT_TRUE(check.is_as_known()) << check.what << ": " << check.measured << " in place of " << check.expected;
}

INSTANTIATE_TEST_SUITE_P(Quick, ValidationCases, testing::ValuesIn(validation_cases()),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(ValidationCheck, passes_within_its_bound_only) {
    ValidationCheck check{.what = "x", .measured = 1.04, .expected = 1, .tolerance = 0.05};
    EXPECT_TRUE(check.passes());
    check.measured = 0.94;
    EXPECT_FALSE(check.passes());
    EXPECT_NEAR(check.deviation(), -0.06, 1e-12);
    check.bound = Bound::at_most;
    EXPECT_TRUE(check.passes());
    EXPECT_EQ(check.deviation(), 0);
    check.bound = Bound::at_least;
    EXPECT_FALSE(check.passes());
    for (const Bound bound : {Bound::near, Bound::at_most, Bound::at_least}) {
        check.bound = bound, check.measured = std::numeric_limits<double>::quiet_NaN(), check.known = 10;
        EXPECT_FALSE(check.passes());
        EXPECT_FALSE(check.is_as_known());
    }
}

TEST(ValidationCheck, is_as_known_while_the_deviation_does_not_grow) {
    ValidationCheck check{.what = "x", .measured = 1.2, .expected = 1, .tolerance = 0.01, .known = 0.2};
    EXPECT_FALSE(check.passes());
    EXPECT_TRUE(check.is_as_known());
    check.measured = 1.3;
    EXPECT_FALSE(check.is_as_known());
}

TEST(ValidationResult, fails_without_checks_and_with_a_problem) {
    EXPECT_FALSE((ValidationResult{.name = "x", .checks = {}}.passes()));
    ValidationResult result{.name = "x", .checks = {{.what = "y"}}};
    EXPECT_TRUE(result.passes());
    result.problem = "no device";
    EXPECT_FALSE(result.passes());
}

TEST(ValidationCase, has_a_name_of_its_own) {
    std::set<std::string_view> names;
    for (const ValidationCase& one : validation_cases()) {
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
        EXPECT_EQ(find_validation_case(one.name), &one);
        EXPECT_NE(one.title, "");
        EXPECT_NE(one.source, "");
    }
    EXPECT_EQ(find_validation_case("nothing"), nullptr);
}

TEST(Validation, says_which_backend_there_is_not) {
    Validation validation({.backend = "quantum"}, true);
    const ValidationResult result = run_case(*find_validation_case("free_fall"), validation);
    EXPECT_NE(result.problem, "");
    EXPECT_FALSE(result.passes());
}

}  // namespace
}  // namespace weft
