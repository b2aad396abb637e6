// What selection, groups, brush and anchors say to the document, and that undo and redo bring it and the cloth back.
#include "editor/app/brush_tool.h"
#include "editor/app/vertex_edits.h"
#include "editor/core/scene.test.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

namespace weft::editor {
namespace {

using testing::ElementsAre;

constexpr const char* sheet = "/cloths/0";

Json scene_json(const char* more = "") {
    return Json::parse(std::string(R"({ "weft": 1, "solver": {"substeps": 2},
        "cloths": [{"name": "sheet", "mesh": {"grid": {"size": [1, 1], "resolution": [11, 11]}}, "fabric": "cotton",
                    "transform": {"position": [0, 1, 0], "rotation": [90, 0, 0]})") +
                       more + R"(}],
        "colliders": [{"name": "ball", "sphere": {"radius": 0.2}}] })");
}

DocumentPtr document_of(const char* more) {
    auto made = make_document(scene_json(more), {}, {});
    EXPECT_TRUE(made) << made.error().message();
    return *made;
}

/// The document after the edits.
DocumentPtr after(const Document& document, const std::vector<Edit>& edits) {
    auto next = edited(document, edits);
    EXPECT_TRUE(next) << next.error().message();
    return *next;
}

const SceneCloth& cloth_of(const Document& document) {
    return document.scene.cloths[0];
}

const std::vector<std::uint32_t>& vertices_of_pin(const Document& document, std::size_t pin) {
    return std::get<VertexPins>(cloth_of(document).pins.at(pin).select).vertices;
}

TEST(Pins, join_the_last_that_only_lists_vertices) {
    const DocumentPtr before = document_of(R"(, "pins": [{"vertices": [3, 1]}, {"vertices": [9], "attach": "ball"}])");
    const DocumentPtr more = after(*before, changed_pins(*before, sheet, {2, 7}, {}).edits);
    EXPECT_THAT(vertices_of_pin(*more, 0), ElementsAre(1, 2, 3, 7));
    EXPECT_THAT(vertices_of_pin(*more, 1), ElementsAre(9));
    const DocumentPtr fewer = after(*more, changed_pins(*more, sheet, {}, {1, 9}).edits);
    ASSERT_EQ(cloth_of(*fewer).pins.size(), 1u) << "a pin without vertices goes";
    EXPECT_THAT(vertices_of_pin(*fewer, 0), ElementsAre(2, 3, 7));
    const DocumentPtr none = after(*fewer, changed_pins(*fewer, sheet, {}, {2, 3, 7}).edits);
    EXPECT_FALSE(find(none->json, "/cloths/0/pins"));
    EXPECT_TRUE(changed_pins(*none, sheet, {}, {5}).edits.empty());
}

TEST(Pins, of_a_group_list_what_is_left) {
    const DocumentPtr before = document_of(R"(, "groups": [{"name": "hem", "vertices": [0, 1, 2]}],
        "pins": [{"group": "hem", "attach": "ball"}, {"box": {"min": [-1, -1, -1], "max": [1, 3, 1]}}])");
    EXPECT_THAT(listed_pins(*before, sheet), ElementsAre(0, 1, 2));
    const PinChange change = changed_pins(*before, sheet, {}, {1});
    EXPECT_EQ(change.others, 1u);
    const DocumentPtr less = after(*before, change.edits);
    EXPECT_THAT(vertices_of_pin(*less, 0), ElementsAre(0, 2));
    EXPECT_EQ(cloth_of(*less).pins[0].attach, "ball");
    EXPECT_THAT(cloth_of(*less).groups[0].vertices, ElementsAre(0, 1, 2));
    // The pin of exactly a group names it.
    EXPECT_EQ(pin_edits(*before, sheet, {0, 1, 2})[0].value, (Json{{"group", "hem"}}));
    EXPECT_EQ(pin_edits(*before, sheet, {0, 1})[0].value, (Json{{"vertices", {0, 1}}}));
}

TEST(Groups, are_made_changed_renamed_and_removed) {
    DocumentPtr document = document_of(R"(, "tearing": "split")");
    document = after(*document, group_edits(*document, sheet, "hem", {4, 5}));
    document = after(*document, group_edits(*document, sheet, "collar", {7}));
    EXPECT_EQ(free_group_name(*document, sheet, "hem"), "hem 2");
    document = after(*document, pin_edits(*document, sheet, {4, 5}));
    document = after(*document, {{"/cloths/0/resistance/-", Json{{"group", "hem"}, {"factor", 0.5}}}});
    document = after(*document, group_renaming(*document, sheet, "hem", "edge"));
    EXPECT_THAT(group_names(*document, sheet), ElementsAre("edge", "collar"));
    EXPECT_EQ(*find(document->json, "/cloths/0/pins/0/group"), "edge");
    // Other vertices of the group are other pins.
    document = after(*document, group_edits(*document, sheet, "edge", {4, 5, 6}));
    EXPECT_THAT(vertices_of_pin(*document, 0), ElementsAre(4, 5, 6));
    const DocumentPtr removed = after(*document, group_removal(*document, sheet, "edge"));
    EXPECT_THAT(group_names(*removed, sheet), ElementsAre("collar"));
    EXPECT_THAT(vertices_of_pin(*removed, 0), ElementsAre(4, 5, 6)) << "the pins stay";
    EXPECT_EQ(cloth_of(*removed).resistance[0].factor, 0.5f);
    EXPECT_FALSE(find(after(*removed, group_removal(*removed, sheet, "collar"))->json, "/cloths/0/groups"));
    // A name that is taken is refused.
    EXPECT_FALSE(edited(*document, group_renaming(*document, sheet, "edge", "collar")));
}

/// A cloth in a world, as the brush sees it.
struct Painted {
    explicit Painted(DocumentPtr document)
        : stage(*Stage::open(std::move(document), {})), picture(photographer.take(stage)) {}
    void see() { picture = photographer.take(stage); }
    PaintTarget target(const ClothVertices& cloth, const std::string& group = {}) const {
        return {*stage.document(), sheet, cloth, picture->world->frame().cloths[0], group};
    }
    /// Paints with a kind at particles.
    std::vector<Edit> stroke(std::string_view name, const VertexSet& at, float value, const std::string& group = {}) {
        see();
        const PaintKind& kind = *std::ranges::find(paint_kinds(), name, &PaintKind::name);
        const ClothVertices cloth = vertices_of(*picture, 0);
        const PaintTarget of = target(cloth, group);
        std::vector<float> values = kind.read(of);
        for (const std::uint32_t p : at) values[p] = value;
        std::vector<Edit> edits = kind.prepare ? kind.prepare(of) : std::vector<Edit>{};
        for (const Edit& edit : kind.write(of, values, at)) edits.push_back(edit);
        return edits;
    }
    std::vector<float> values(std::string_view name, const std::string& group = {}) {
        see();
        const ClothVertices cloth = vertices_of(*picture, 0);
        return std::ranges::find(paint_kinds(), name, &PaintKind::name)->read(target(cloth, group));
    }

    Photographer photographer;
    Stage stage;
    PicturePtr picture;
};

// Each is one action: document and state come back to the bit, and the redo is the same again.
TEST(Strokes, are_undone_and_redone_to_the_bit) {
    Painted painted(document_of(R"(, "pins": [{"vertices": [0, 10]}], "tearing": "split")"));
    Stage& stage = painted.stage;
    ASSERT_TRUE(stage.apply(Advance{10}));
    const std::string first = stage.hash();
    std::vector<std::string> hashes{first};
    const std::tuple<const char*, VertexSet, float, const char*> strokes[] = {
        {"pins", {60, 61}, 1, ""},     {"resistance", {50, 51, 52}, 0.25f, ""},
        {"group", {3, 4}, 1, "hem"},   {"resistance", {52, 53}, 3.0f, ""},
        {"density", {70, 71}, 20, ""}, {"stretch", {70}, 0.5f, ""},
        {"bend", {72, 73}, 3, ""},     {"density", {71, 72}, 0.1f, ""},
        {"pins", {0, 60}, 0, ""},      {"group", {3}, 0, "hem"},
        {"group", {4}, 0, "hem"}};
    for (const auto& [kind, at, value, group] : strokes) {
        const std::uint64_t frame = stage.frame();
        ASSERT_TRUE(stage.apply(ChangeScene{kind, painted.stroke(kind, at, value, group), 0}));
        EXPECT_EQ(stage.frame(), frame) << "the run goes on";
        const std::vector<float> now = painted.values(kind, group);
        for (const std::uint32_t p : at) EXPECT_FLOAT_EQ(now[p], value) << kind << ' ' << p;
        ASSERT_TRUE(stage.apply(Advance{2}));
        hashes.push_back(stage.hash());
    }
    EXPECT_EQ(painted.values("resistance")[50], 0.25f) << "an earlier stroke stays";
    EXPECT_EQ(painted.values("density")[70], 20) << "an earlier stroke stays";
    EXPECT_EQ(cloth_of(*stage.document()).weights.size(), 3u) << "one description of each value";
    EXPECT_FALSE(find(stage.document()->json, "/cloths/0/groups")) << "the last vertex takes the group along";
    for (std::size_t i = 0; i < std::size(strokes); ++i) ASSERT_TRUE(stage.apply(Undo{}));
    EXPECT_EQ(stage.hash(), first);
    for (std::size_t i = 0; i < std::size(strokes); ++i) ASSERT_TRUE(stage.apply(Redo{}));
    ASSERT_TRUE(stage.apply(Advance{0}));
    EXPECT_EQ(stage.hash(), hashes.back());
}

// Painting strengths moves nothing at that moment, and neither do pins where the cloth is.
TEST(Strokes, move_nothing) {
    Painted painted(document_of(R"(, "pins": [{"vertices": [0, 10]}], "tearing": "split")"));
    Stage& stage = painted.stage;
    ASSERT_TRUE(stage.apply(Advance{20}));
    const auto positions = [&] {
        painted.see();
        const auto now = painted.picture->world->frame().cloths[0].positions;
        return std::vector<Vec4>(now.begin(), now.end());
    };
    const std::vector<Vec4> before = positions();
    for (const auto& [kind, value] :
         {std::pair{"resistance", 0.5f}, {"density", 9.0f}, {"bend", 0.1f}, {"pins", 1.0f}, {"group", 1.0f}}) {
        ASSERT_TRUE(stage.apply(ChangeScene{kind, painted.stroke(kind, {40, 41}, value, "hem"), 0}));
        const std::vector<Vec4> now = positions();
        for (std::size_t p = 0; p < now.size(); ++p) EXPECT_EQ(now[p].xyz(), before[p].xyz()) << kind << ' ' << p;
    }
}

TEST(Strokes, let_a_cloth_tear_that_could_not) {
    Painted painted(document_of(""));
    const std::vector<Edit> edits = painted.stroke("resistance", {7}, 0.5f);
    ASSERT_EQ(edits.size(), 2u);
    EXPECT_EQ(edits[0].place, "/cloths/0/tearing");
    const DocumentPtr now = after(*painted.stage.document(), edits);
    EXPECT_EQ(cloth_of(*now).tearing, Tearing::split);
    EXPECT_THAT(cloth_of(*now).resistance[0].factors, ElementsAre(0.5f));
}

// Copies of particles that a cut has made are painted, chosen and pinned like their originals.
TEST(ClothVertices, of_a_cut_cloth_are_those_of_the_whole_one) {
    Painted painted(document_of(R"(, "pins": [{"vertices": [0, 10]}], "tearing": "split")"));
    const ClothVertices whole = vertices_of(*painted.picture, 0);
    EXPECT_EQ(whole.particles(), 121u);
    ASSERT_TRUE(painted.stage.apply(Cut{"sheet", {{0, 1.6f, 0}, {0, 0.4f, 0}}}));
    painted.see();
    const ClothFrame& frame = painted.picture->world->frame().cloths[0];
    ASSERT_GT(frame.positions.size(), 121u);
    const ClothVertices cut = vertices_of(*painted.picture, 0);
    EXPECT_EQ(cut.triangles, whole.triangles);
    for (std::uint32_t p = 121; p < frame.positions.size(); ++p) {
        const std::uint32_t original = original_of(frame, *cut.numbers, p);
        ASSERT_LT(original, 121u);
        EXPECT_LT(length(frame.positions[p].xyz() - frame.positions[original].xyz()), 1e-5f);
    }
    EXPECT_EQ(original_of(frame, *cut.numbers, 100000), none);
    EXPECT_THAT(cut.to_vertices({5, 3}), ElementsAre(3, 5));
    EXPECT_THAT(cut.to_particles({3, 5, 100000}), ElementsAre(3, 5));
    // At rest, in its own axes: the grid lies in its xz plane.
    for (const Vec3& p : cut.rest) EXPECT_NEAR(p.y, 0, 1e-6f);
}

TEST(PaintKinds, have_colors_that_show_how_much) {
    for (const PaintKind& kind : paint_kinds()) {
        const ClothPaint paint = colors_of(kind, "sheet", {kind.least, kind.neutral, kind.most});
        EXPECT_LE(paint.values[0], paint.values[1]);
        EXPECT_LT(paint.values[1], paint.values[2]);
        EXPECT_FALSE(kind.what.empty());
        EXPECT_NE(kind.scale_low, kind.scale_high) << "not told by color alone";
    }
}

}  // namespace
}  // namespace weft::editor
