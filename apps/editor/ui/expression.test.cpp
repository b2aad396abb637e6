#include "editor/ui/expression.h"
#include "editor/ui/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace weft::editor {
namespace {

using testing::HasSubstr;

double value_of(const std::string& text, const std::string& unit = "", double now = 0) {
    const auto result = evaluate(text, unit, now);
    EXPECT_TRUE(result.ok()) << text << ": " << (result ? "" : result.error().what);
    return result ? *result : -999;
}
std::string error_of(const std::string& text, const std::string& unit = "") {
    const auto result = evaluate(text, unit);
    EXPECT_FALSE(result.ok()) << text << " = " << (result ? *result : 0);
    return result ? "" : result.error().what;
}

TEST(Expression, computes) {
    EXPECT_DOUBLE_EQ(value_of("0.25"), 0.25);
    EXPECT_DOUBLE_EQ(value_of(" 1e-6 "), 1e-6);
    EXPECT_DOUBLE_EQ(value_of("3/4"), 0.75);
    EXPECT_DOUBLE_EQ(value_of("1 + 2*3 - 4/2"), 5);
    EXPECT_DOUBLE_EQ(value_of("2*(1 + 0.5)"), 3);
    EXPECT_DOUBLE_EQ(value_of("-2^2"), -4);
    EXPECT_DOUBLE_EQ(value_of("2^3^2"), 512);
    EXPECT_DOUBLE_EQ(value_of("2^-1"), 0.5);
    EXPECT_DOUBLE_EQ(value_of("sqrt(2)*pi"), std::numbers::sqrt2 * std::numbers::pi);
    EXPECT_DOUBLE_EQ(value_of("2 × 3 − 1"), 5);
    EXPECT_DOUBLE_EQ(value_of("0,5"), 0.5);
    EXPECT_DOUBLE_EQ(value_of(".5"), 0.5);
}

TEST(Expression, changes_the_value) {
    EXPECT_DOUBLE_EQ(value_of("*2", "", 3), 6);
    EXPECT_DOUBLE_EQ(value_of("/4", "", 3), 0.75);
    EXPECT_DOUBLE_EQ(value_of("+=1", "", 3), 4);
    EXPECT_DOUBLE_EQ(value_of("-= 5 cm", "m", 1), 0.95);
    EXPECT_DOUBLE_EQ(value_of("-1", "", 3), -1) << "a negative number";
    EXPECT_DOUBLE_EQ(value_of("+1", "", 3), 1);
}

TEST(Expression, knows_units) {
    EXPECT_DOUBLE_EQ(value_of("5 mm", "m"), 0.005);
    EXPECT_DOUBLE_EQ(value_of("2cm + 0.5", "m"), 0.52);
    EXPECT_DOUBLE_EQ(value_of("(1 + 1) cm", "m"), 0.02);
    EXPECT_DOUBLE_EQ(value_of("2 cm * 3", "m"), 0.06);
    EXPECT_DOUBLE_EQ(value_of("150 g/m2", "kg/m²"), 0.15);
    EXPECT_DOUBLE_EQ(value_of("150 g/m^2", "kg/m²"), 0.15);
    EXPECT_DOUBLE_EQ(value_of("3 kN/m", "N/m"), 3000);
    EXPECT_DOUBLE_EQ(value_of("2 Pa*m", "N/m"), 2);
    EXPECT_DOUBLE_EQ(value_of("36 km/h", "m/s"), 10);
    EXPECT_DOUBLE_EQ(value_of("pi/2 rad", "°"), std::numbers::pi / (2 * 180 / std::numbers::pi))
        << "pi divided by 2 rad";
    EXPECT_DOUBLE_EQ(value_of("2 rad", "°"), 360 / std::numbers::pi);
    EXPECT_DOUBLE_EQ(value_of("90°", "°"), 90);
    EXPECT_DOUBLE_EQ(value_of("20 %"), 0.2);
    EXPECT_DOUBLE_EQ(value_of("2 1/s", "1/s"), 2);
    EXPECT_DOUBLE_EQ(value_of("20 ms", "s"), 0.02);
    EXPECT_DOUBLE_EQ(value_of("3 stops", "stops"), 3) << "a unit that is only a word";
}

TEST(Expression, tells_what_is_wrong) {
    EXPECT_THAT(error_of("5 kg", "m"), HasSubstr("kg cannot be converted to m"));
    EXPECT_THAT(error_of("5 kg"), HasSubstr("pure number"));
    EXPECT_THAT(error_of("5 foo", "m"), HasSubstr("\"foo\" is not understood"));
    EXPECT_THAT(error_of("(1 + 2"), HasSubstr("parenthesis is missing"));
    EXPECT_THAT(error_of("1 +"), HasSubstr("a number is missing"));
    EXPECT_THAT(error_of(""), HasSubstr("a number is missing"));
    EXPECT_THAT(error_of("1/0"), HasSubstr("division by zero"));
    EXPECT_THAT(error_of("/0"), HasSubstr("division by zero"));
    EXPECT_THAT(error_of("1e999"), testing::Not(""));
    EXPECT_THAT(error_of("10^999"), HasSubstr("not a finite number"));
    EXPECT_THAT(error_of("nan"), HasSubstr("a number is missing"));
    EXPECT_THAT(error_of("sqrt(-1)"), HasSubstr("negative"));
    EXPECT_THAT(error_of(std::string(5000, '(')), HasSubstr("too many"));
    EXPECT_THAT(error_of(std::string(5000, '-')), HasSubstr("too many"));
}

TEST(Numbers, are_short) {
    EXPECT_EQ(format_number(0.25), "0.25");
    EXPECT_EQ(format_number(-0.0), "0");
    EXPECT_EQ(format_number(1200), "1200");
    EXPECT_EQ(format_number(123456), "123456");
    EXPECT_EQ(format_number(1e-6), "1e-6");
    EXPECT_EQ(format_number(2.5e9), "2.5e9");
    EXPECT_EQ(format_number(1.0 / 3), "0.3333");
    EXPECT_EQ(format_number(0.2, "kg/m²"), "0.2 kg/m²");
    EXPECT_EQ(format_number(30, "°"), "30°");
    EXPECT_EQ(format_short(0.00015, 2), "1.5e-4");
    EXPECT_EQ(format_short(-0.0002, 3), "-2e-4");
    EXPECT_EQ(format_short(0.05, 2), "0.05");
    EXPECT_EQ(format_short(1200, 3), "1200");
    EXPECT_EQ(format_short(0, 2), "0");
}

TEST(Units, that_measure_the_same_are_converted) {
    EXPECT_DOUBLE_EQ(*conversion("mm", "m"), 0.001);
    EXPECT_DOUBLE_EQ(*conversion("J/m", "N"), 1);
    EXPECT_DOUBLE_EQ(*conversion("N·m⁻¹", "N/m"), 1);
    EXPECT_FALSE(conversion("m", "s").has_value());
    EXPECT_FALSE(conversion("", "m").has_value());
    EXPECT_FALSE(conversion("m//s", "m/s").has_value());
    EXPECT_FALSE(conversion("/", "m").has_value());
}

}  // namespace
}  // namespace weft::editor
