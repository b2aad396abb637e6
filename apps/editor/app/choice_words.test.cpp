#include "editor/app/choice_words.h"

#include "editor/app/property_tables.h"
#include "scene/check.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace weft::editor {
namespace {

// One object of every kind that has choices.
DocumentPtr document_with_choices() {
    auto made = make_document(Json::parse(R"({"weft": 1,
        "cloths": [{"mesh": {"grid": {}}, "fabric": "silk", "material": "cotton"}],
        "colliders": [{"mesh": {"file": "a.obj"}}],
        "air": {"wind": [{"kind": "jet", "gust": {}}]}, "solver": {}})"),
                              {}, {});
    EXPECT_TRUE(made) << made.error().message();
    return made ? *made : nullptr;
}

TEST(ChoiceWords, say_something_about_each_value) {
    const DocumentPtr document = document_with_choices();
    ASSERT_TRUE(document);
    int choices = 0;
    for (const char* const place : {"/cloths/0", "/cloths/0/mesh/grid", "/cloths/0/fabric", "/cloths/0/material",
                                    "/colliders/0/mesh", "/air/wind/0", "/air/wind/0/gust", "/solver"}) {
        const PropertyGroup group = properties_of(*document, place);
        for (const auto* const list : {&group.values, &group.seldom}) {
            for (const Property& property : *list) {
                if (property.parameter->kind != ParameterKind::choice || property.key() == "up") continue;
                ++choices;
                const auto words = choice_words(*property.parameter);
                const auto parts = std::ranges::count(property.parameter->choices, '|') + 1;
                EXPECT_EQ(static_cast<std::ptrdiff_t>(words.size()), parts) << place << "/" << property.key();
            }
        }
    }
    EXPECT_GE(choices, 14);
}

TEST(ChoiceWords, show_the_weight_of_fabrics_in_alphabetical_order) {
    const DocumentPtr document = document_with_choices();
    ASSERT_TRUE(document);
    const auto names = names_for(*document, "/cloths/0/fabric", "preset");
    EXPECT_TRUE(std::ranges::is_sorted(names));
    const auto words = preset_words("/cloths/0/fabric", names);
    ASSERT_EQ(words.size(), names.size());
    for (const std::string& word : words) EXPECT_THAT(word, testing::EndsWith(" g/m²"));
    EXPECT_TRUE(std::ranges::is_sorted(names_for(*document, "/cloths/0/material", "preset")));
}

}  // namespace
}  // namespace weft::editor
