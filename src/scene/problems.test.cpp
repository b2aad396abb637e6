#include "scene/problems.h"

#include <gtest/gtest.h>

#include <limits>

namespace weft {
namespace {

TEST(Problems, PointersFollowTheStandard) {
    EXPECT_EQ(at("", "cloths"), "/cloths");
    EXPECT_EQ(at("/cloths", 0), "/cloths/0");
    EXPECT_EQ(at("", "a/b~c"), "/a~1b~0c");
    EXPECT_EQ(at("/a", ""), "/a/");
}

TEST(Problems, NumbersReadAsTyped) {
    EXPECT_EQ(number_text(-1.0f), "-1");
    EXPECT_EQ(number_text(0.0f), "0");
    EXPECT_EQ(number_text(0.1f), "0.1");
    EXPECT_EQ(number_text(100000.0f), "100000");
    EXPECT_EQ(number_text(11.9e-6f), "1.19e-5");
    EXPECT_EQ(number_text(1e39), "1e39");
    EXPECT_EQ(number_text(1e9f), "1e9");
    EXPECT_EQ(number_text(4294967295u), "4294967295");
    EXPECT_EQ(number_text(4294967295.0), "4294967295");
    EXPECT_EQ(number_text(3.4028235e38f), "3.4028235e38");
    EXPECT_EQ(number_text(std::numeric_limits<float>::quiet_NaN()), "nan");
    EXPECT_EQ(number_text(-std::numeric_limits<float>::infinity()), "-infinity");
}

TEST(Problems, QuotesStayShortAndOnOneLine) {
    EXPECT_EQ(in_quotes("silk"), "\"silk\"");
    EXPECT_EQ(in_quotes("a\nb"), "\"a\\u000ab\"");
    EXPECT_EQ(in_quotes(std::string(100, 'x')), '"' + std::string(60, 'x') + "…\"");
    // The cut must not split a character: é has two bytes.
    std::string accents;
    for (int i = 0; i < 50; ++i) accents += "é";
    EXPECT_EQ(in_quotes("x" + accents), "\"x" + accents.substr(0, 58) + "…\"");
}

TEST(Problems, KnowWhatTheyConcern) {
    Problems problems;
    EXPECT_FALSE(problems.concern("/cloths"));
    problems.add("/cloths/1/mesh", "bad");
    EXPECT_TRUE(problems.concern("/cloths/1/mesh"));
    EXPECT_TRUE(problems.concern("/cloths/1"));
    EXPECT_TRUE(problems.concern("/cloths/1/mesh/grid"));
    EXPECT_TRUE(problems.concern(""));
    EXPECT_FALSE(problems.concern("/cloths/1/me"));
    EXPECT_FALSE(problems.concern("/cloths/1/meshes"));
    EXPECT_FALSE(problems.concern("/cloths/10"));
}

TEST(Problems, LeaveConsequencesOut) {
    Problems causes;
    causes.add("/a/b", "bad");
    Problems later(&causes);
    later.add("/a/b/0", "out of range");
    later.add("/a", "is odd");
    later.add("/c", "out of range");
    EXPECT_TRUE(later.concern("/a/b"));
    EXPECT_TRUE(later.concern("/c"));
    causes.append(std::move(later));
    const Errors errors = std::move(causes).take();
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].message(), "/a/b: bad");
    EXPECT_EQ(errors[1].message(), "/c: out of range");
}

TEST(Problems, AreNamedAndCounted) {
    Problems problems;
    for (int i = 0; i < 250; ++i) problems.add(at("/list", static_cast<std::size_t>(i)), "bad");
    const Errors errors = std::move(problems).take("file.json");
    ASSERT_EQ(errors.size(), 101u);
    EXPECT_EQ(errors[0].message(), "file.json: /list/0: bad");
    EXPECT_EQ(errors[99].message(), "file.json: /list/99: bad");
    EXPECT_EQ(errors[100].message(), "file.json: and 150 more");
}

TEST(Problems, OfTheWholeCarryTheNameAlone) {
    Problems problems;
    problems.add("", "is empty");
    EXPECT_EQ(std::move(problems).take("file.json").at(0).message(), "file.json: is empty");
}

}  // namespace
}  // namespace weft
