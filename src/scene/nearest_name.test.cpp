#include "scene/nearest_name.h"

#include <gtest/gtest.h>

#include <string>

namespace weft {
namespace {

constexpr std::string_view keys[] = {"density", "damping", "stretch", "bend", "rest_angle", "friction"};

TEST(NearestName, FindsWhatWasMeant) {
    EXPECT_EQ(nearest_name("densty", keys), "density");     // missing
    EXPECT_EQ(nearest_name("dampping", keys), "damping");   // added
    EXPECT_EQ(nearest_name("strotch", keys), "stretch");    // changed
    EXPECT_EQ(nearest_name("frictoin", keys), "friction");  // swapped
    EXPECT_EQ(nearest_name("Bend", keys), "bend");          // case
    EXPECT_EQ(nearest_name("rest-angle", keys), "rest_angle");
    EXPECT_EQ(nearest_name("restangle", keys), "rest_angle");
    EXPECT_EQ(nearest_name("dens", keys), "density");  // a beginning of the name
    EXPECT_EQ(nearest_name("friction_static", keys), "friction");
    EXPECT_EQ(nearest_name("bend", keys), "bend");
}

TEST(NearestName, PrefersTheFewestErrors) {
    constexpr std::string_view names[] = {"mask", "mass", "mast"};
    EXPECT_EQ(nearest_name("maass", names), "mass");
    EXPECT_EQ(nearest_name("mas", names), "mask");  // all are equally near: the first
}

TEST(NearestName, FindsNothingFarAway) {
    EXPECT_EQ(nearest_name("color", keys), "");
    EXPECT_EQ(nearest_name("x", keys), "");
    EXPECT_EQ(nearest_name("", keys), "");
    EXPECT_EQ(nearest_name("bend", {}), "");
    EXPECT_EQ(nearest_name(std::string(1 << 20, 'z'), keys), "");
}

TEST(NearestName, ShortNamesMustBeginAlike) {
    constexpr std::string_view names[] = {"wind", "a", "b"};
    EXPECT_EQ(nearest_name("wnd", names), "wind");
    EXPECT_EQ(nearest_name("iwnd", names), "wind");
    EXPECT_EQ(nearest_name("Wind", names), "wind");
    EXPECT_EQ(nearest_name("kind", names), "");
    EXPECT_EQ(nearest_name("c", names), "");
}

TEST(NearestName, KnowsOtherWordsForTheSame) {
    constexpr std::string_view of_wind[] = {"kind", "velocity", "gust", "turbulence", "seed"};
    EXPECT_EQ(suggestion("speed", of_wind), "; did you mean \"velocity\"?");
    EXPECT_EQ(suggestion("mass", keys), "; did you mean \"density\"?");
    EXPECT_EQ(suggestion("mass", of_wind).substr(0, 12), "; known are ") << "there is no density";
}

TEST(NearestName, SuggestsOrLists) {
    constexpr std::string_view names[] = {"plane", "sphere", "box"};
    EXPECT_EQ(suggestion("shpere", names), "; did you mean \"sphere\"?");
    EXPECT_EQ(suggestion("teapot", names), "; known are \"plane\", \"sphere\" and \"box\"");
    EXPECT_EQ(suggestion("teapot", {}), "");
    EXPECT_EQ(alternatives(names), "\"plane\", \"sphere\" or \"box\"");
    EXPECT_EQ(alternatives(std::span(names).first(1)), "\"plane\"");
}

TEST(NearestName, a_former_name_is_answered_with_the_one_of_today) {
    constexpr std::string_view keys[] = {"bend", "bend_edges", "bend_model"}, models[] = {"dihedral", "plate"};
    EXPECT_EQ(suggestion("hinges", keys), "; this is called \"bend_edges\" now");
    EXPECT_EQ(former_name("hinges", models), "; this is called \"dihedral\" now");
    EXPECT_EQ(former_name("hinges", {}), "");
    EXPECT_EQ(former_name("hinge", keys), "");
    constexpr std::string_view of_scene[] = {"cloths", "colliders"};
    EXPECT_EQ(suggestion("look", of_scene), "; each cloth and each collider has a key \"material\" now");
    EXPECT_EQ(former_name("look", keys), "");
}

}  // namespace
}  // namespace weft
