#include "editor/app/property_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace weft::editor {
namespace {

using testing::ElementsAre;

DocumentPtr document_with(const std::string& collider) {
    auto made =
        make_document(Json::parse(R"({ "weft": 1, "cloths": [ {} ], "colliders": [ )" + collider + " ] }"), {}, {});
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message());
    return made ? *made : DocumentPtr();
}

std::vector<std::string> keys_of(const PropertyGroup& group) {
    std::vector<std::string> keys;
    for (const Property& value : group.values) keys.emplace_back(value.key());
    for (const ChildProperty& child : group.children) keys.emplace_back(child.key());
    return keys;
}

TEST(MotionOfColliders, is_one_of_three) {
    const std::string place = "/colliders/0";
    const std::vector<std::pair<std::string, std::size_t>> colliders = {
        {R"({ "sphere": {} })", 0},
        {R"({ "sphere": {}, "motion": "static" })", 0},
        {R"({ "sphere": {}, "motion": { "keys": [ {} ] } })", 1},
        {R"({ "sphere": {}, "motion": { "dynamic": {} } })", 2}};
    for (const auto& [collider, motion] : colliders) {
        const DocumentPtr document = document_with(collider);
        ASSERT_TRUE(document);
        EXPECT_EQ(motion_of(*document, place), motion) << collider;
        EXPECT_THAT(motions_of(*document, place), ElementsAre("static", "keys", "dynamic"));
    }
    EXPECT_THAT(motions_of(*document_with(R"({ "plane": {} })"), place), ElementsAre("static", "keys"));
}

TEST(MotionOfColliders, changes_from_each_to_each) {
    const std::string place = "/colliders/0";
    for (const char* const shape :
         {R"("sphere": {})", R"("box": {})", R"("mesh": { "file": "bunny.obj", "contact": "surface" })"}) {
        for (const char* const motion : {R"("static")", R"({ "keys": [ { "time": 2 } ] })", R"({ "dynamic": {} })"}) {
            if (std::string(shape).find("surface") != std::string::npos &&
                std::string(motion).find("dynamic") != std::string::npos)
                continue;
            const DocumentPtr before = document_with("{ " + std::string(shape) + R"(, "motion": )" + motion + " }");
            ASSERT_TRUE(before);
            for (std::size_t chosen = 0; chosen < 3; ++chosen) {
                const auto after = edited(*before, change_motion(*before, place, chosen));
                ASSERT_TRUE(after.ok()) << shape << motion << chosen << after.error().message();
                EXPECT_EQ(motion_of(**after, place), chosen);
                const SceneCollider& collider = (*after)->scene.colliders[0];
                EXPECT_EQ(collider.body.has_value(), chosen == 2);
                EXPECT_EQ(collider.motion.size(), chosen == 1 ? 1u : 0u);
                const bool mesh = std::holds_alternative<SolidMeshDesc>(collider.shape);
                if (collider.body) {
                    EXPECT_EQ(collider.body->mass, mesh ? 1 : 0);
                }
            }
        }
    }
}

TEST(MotionOfColliders, shows_the_values_of_a_body_alone) {
    const std::string place = "/colliders/0/motion";
    const DocumentPtr body = document_with(R"({ "sphere": {}, "motion": { "dynamic": { "mass": 3 } } })");
    const DocumentPtr rests = document_with(R"({ "sphere": {} })");
    EXPECT_THAT(keys_of(properties_of(*body, place)), ElementsAre("dynamic"));
    EXPECT_THAT(keys_of(properties_of(*rests, place)), ElementsAre());
    const PropertyGroup values = properties_of(*body, place + "/dynamic");
    EXPECT_THAT(keys_of(values), ElementsAre("mass", "density", "center", "inertia", "velocity", "spin", "damping",
                                             "spin_damping", "restitution", "reaction"));
    EXPECT_EQ(value_of(*body, place + "/dynamic", values.values[0]), Json(3));
    EXPECT_EQ(value_of(*body, place + "/dynamic", values.values[1]), Json(1000));
}

// Two numbers of a fabric are never along x and y.
TEST(PartsOfValues, of_fabrics_have_names_of_their_own) {
    for (const FabricTable& table : fabric_tables()) {
        for (const Parameter& parameter : table.parameters) {
            if (parameter.count < 2) continue;
            EXPECT_EQ(parts_of("/cloths/0/fabric", parameter).size(), parameter.count) << parameter.key;
        }
    }
}

}  // namespace
}  // namespace weft::editor
