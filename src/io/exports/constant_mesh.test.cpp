#include "io/exports/constant_mesh.h"

#include "io/exports/torn_film.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace weft {
namespace {

using test::Cloth;
using test::expect_shows;
using test::Instant;
using test::make_cloth;
using test::TornFilm;
using ::testing::HasSubstr;

template <class Value>
std::vector<Value> copied(std::span<const Value> values) {
    return {values.begin(), values.end()};
}

TEST(ConstantMesh, ShowsEveryFrameWithTheTrianglesOfTheLastOne) {
    for (const bool removes : {false, true}) {
        const TornFilm film(removes);
        ConstantMeshes meshes;
        std::vector<std::vector<Vec3>> positions, normals;
        for (std::size_t f = 0; f < film.size(); ++f) {
            const auto instant = film.at(f);
            ASSERT_EQ(meshes.follow(instant->frame()), "");
            positions.push_back(copied(meshes.surfaces()[0].positions));
            normals.push_back(copied(meshes.surfaces()[0].normals));
            ASSERT_EQ(meshes.surfaces()[1].positions.data(), instant->positions(1).data()) << "not copied";
        }
        EXPECT_TRUE(meshes.have_grown());
        EXPECT_EQ(meshes[0].vertex_count(), film.vertices());
        EXPECT_EQ(meshes[0].uvs().size(), film.vertices());
        EXPECT_EQ(meshes[0].colors().size(), film.vertices());
        EXPECT_EQ(meshes[1].vertex_count(), 9u);
        const std::vector<Triangle> triangles = copied(meshes[0].triangles());
        for (const Triangle& triangle : triangles)
            EXPECT_TRUE(is_face(triangle)) << "the removed one has an area at first";
        for (std::size_t f = 0; f < film.size(); ++f) {
            const auto instant = film.at(f);
            meshes[0].widen(positions[f]);
            meshes[0].widen(normals[f]);
            expect_shows(triangles, positions[f], film.torn(f).triangles, instant->positions(0), f);
            expect_shows(triangles, normals[f], film.torn(f).triangles, instant->normals(0), f);
        }
        if (!removes) {
            EXPECT_EQ(triangles, film.torn(5).triangles) << "vertices keep the numbers of the surface";
        }
    }
}

TEST(ConstantMesh, OfACopiedCopyRidesWithTheFirstOriginal) {
    const TornFilm film(false);
    ConstantMeshes meshes;
    for (std::size_t f = 0; f < film.size(); ++f) ASSERT_EQ(meshes.follow(film.at(f)->frame()), "");
    const std::size_t last = film.vertices() - 1;
    EXPECT_EQ(meshes[0].parent(last), TornFilm::side * TornFilm::side + 1);
    EXPECT_LT(meshes[0].parent(meshes[0].parent(last)), TornFilm::side * TornFilm::side);
}

TEST(ConstantMesh, ThatNothingChangesCopiesNothing) {
    const std::vector<Cloth> cloths = {make_cloth("c", 4, 0)};
    ConstantMeshes meshes;
    for (const std::uint64_t version : {1, 1, 2}) {
        Instant instant(cloths, 0, 0);
        instant.surfaces[0].topology_version = version;
        ASSERT_EQ(meshes.follow(instant.frame()), "");
        EXPECT_EQ(meshes.surfaces()[0].positions.data(), instant.positions(0).data());
        EXPECT_EQ(meshes.surfaces()[0].triangles.data(), cloths[0].mesh.triangles.data());
    }
    EXPECT_FALSE(meshes.have_grown());
}

// All triangles at a vertex get a copy of it. The vertex of the mesh follows them, and the surface has one more.
TEST(ConstantMesh, AVertexThatAllTrianglesLeaveFollowsThem) {
    std::vector<Cloth> cloths = {make_cloth("c", 4, 0)};
    ConstantMeshes meshes;
    ASSERT_EQ(meshes.follow(Instant(cloths, 0, 0).frame()), "");
    const std::vector<Triangle> before = cloths[0].mesh.triangles;
    TriangleMesh& mesh = cloths[0].mesh;
    mesh.positions.push_back(Vec3(mesh.positions[5]));
    mesh.uvs.push_back(Vec2(mesh.uvs[5]));
    for (Triangle& triangle : mesh.triangles) std::ranges::replace(triangle, 5u, 16u);
    Instant later(cloths, 1, 1);
    later.surfaces[0].topology_version = 2;
    later.positions(0)[16] = {7, 8, 9};
    ASSERT_EQ(meshes.follow(later.frame()), "");
    EXPECT_FALSE(meshes.have_grown());
    EXPECT_EQ(copied(meshes[0].triangles()), before);
    EXPECT_EQ(meshes.surfaces()[0].positions[5], (Vec3{7, 8, 9}));
}

/// Appends a copy of the vertex and gives it to some of its triangles.
template <class Leaves>
void copy_vertex(TriangleMesh& mesh, std::uint32_t vertex, Leaves&& leaves) {
    mesh.positions.push_back(Vec3(mesh.positions[vertex]));
    mesh.uvs.push_back(Vec2(mesh.uvs[vertex]));
    const auto copy = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (leaves(t)) std::ranges::replace(mesh.triangles[t], vertex, copy);
}

TEST(ConstantMesh, AVertexThatItsLastTrianglesLeaveFollowsThem) {
    std::vector<Cloth> cloths = {make_cloth("c", 4, 0)};
    ConstantMeshes meshes;
    ASSERT_EQ(meshes.follow(Instant(cloths, 0, 0).frame()), "");
    const auto follow = [&](std::uint64_t version) {
        Instant instant(cloths, version, 1);
        instant.surfaces[0].topology_version = version;
        ASSERT_EQ(meshes.follow(instant.frame()), "");
    };
    copy_vertex(cloths[0].mesh, 5, [](std::size_t t) { return t < 4; });
    follow(2);
    EXPECT_EQ(meshes[0].vertex_count(), 17u);
    const std::vector<Triangle> parted = copied(meshes[0].triangles());
    copy_vertex(cloths[0].mesh, 5, [](std::size_t) { return true; });
    follow(3);
    EXPECT_EQ(meshes[0].vertex_count(), 17u);
    EXPECT_EQ(copied(meshes[0].triangles()), parted);
}

TEST(ConstantMesh, NewVerticesHaveTheOrderOfTheSurface) {
    std::vector<Cloth> cloths = {make_cloth("c", 4, 0)};
    ConstantMeshes meshes;
    ASSERT_EQ(meshes.follow(Instant(cloths, 0, 0).frame()), "");
    for (const std::uint32_t vertex : {10u, 5u, 6u})
        copy_vertex(cloths[0].mesh, vertex, [](std::size_t t) { return t % 2 == 0; });
    Instant later(cloths, 1, 1);
    later.surfaces[0].topology_version = 2;
    ASSERT_EQ(meshes.follow(later.frame()), "");
    EXPECT_EQ(copied(meshes[0].triangles()), cloths[0].mesh.triangles);
    EXPECT_EQ(meshes[0].parent(16), 10u);
}

TEST(ConstantMesh, ARemovedTriangleStaysWhereItCollapsed) {
    std::vector<Cloth> cloths = {make_cloth("c", 4, 0)};
    cloths[0].mesh.triangles[0] = {0, 0, 0};  // before the first frame
    ConstantMeshes meshes;
    ASSERT_EQ(meshes.follow(Instant(cloths, 0, 0).frame()), "");
    cloths[0].mesh.triangles[8] = {5, 5, 5};
    Instant second(cloths, 1, 1);
    second.surfaces[0].topology_version = 2;
    ASSERT_EQ(meshes.follow(second.frame()), "");
    const std::size_t count = meshes[0].vertex_count();
    EXPECT_GT(count, 16u);
    cloths[0].mesh.triangles[0] = cloths[0].mesh.triangles[8] = {6, 6, 6};
    Instant third(cloths, 2, 2);
    third.surfaces[0].topology_version = 3;
    ASSERT_EQ(meshes.follow(third.frame()), "");
    EXPECT_EQ(meshes[0].vertex_count(), count);
}

TEST(ConstantMesh, OfAnotherClothIsRefused) {
    const std::vector<Cloth> cloths = {make_cloth("a", 4, 0), make_cloth("b", 4, 1, true)};
    // The mesh of the frame after one in which cloth b is whole.
    const auto problem = [&](auto&& change) {
        ConstantMeshes meshes;
        EXPECT_EQ(meshes.follow(Instant(cloths, 0, 0).frame()), "");
        std::vector<Cloth> later = cloths;
        change(later[1].mesh);
        Instant instant(later, 1, 1);
        instant.surfaces[1].topology_version = 2;
        return meshes.follow(instant.frame());
    };
    EXPECT_EQ(problem([](TriangleMesh&) {}), "");
    EXPECT_EQ(problem([](TriangleMesh& mesh) { mesh.triangles[3] = {0, 0, 0}; }), "");
    EXPECT_EQ(
        problem([](TriangleMesh& mesh) { mesh.triangles.pop_back(); }),
        "frame 1: cloth \"b\" has 17 triangles instead of 18, so it is not the cloth of the frames before; write a "
        "sequence instead");
    EXPECT_THAT(problem([](TriangleMesh& mesh) { std::swap(mesh.triangles[2], mesh.triangles[7]); }),
                HasSubstr("has triangle 2 at another place of the cloth"));
    EXPECT_THAT(problem([](TriangleMesh& mesh) { mesh.uvs[3].x += 1; }), HasSubstr("at another place of the cloth"));
    EXPECT_THAT(problem([](TriangleMesh& mesh) { mesh.colors[3].y += 1; }), HasSubstr("at another place of the cloth"));
    EXPECT_THAT(problem([](TriangleMesh& mesh) { mesh.positions[3].x += 1; }),
                HasSubstr("at another place of the cloth"));
    EXPECT_THAT(problem([](TriangleMesh& mesh) { mesh.colors.clear(); }), HasSubstr("has other data per vertex"));

    ConstantMeshes meshes;
    EXPECT_EQ(meshes.follow(Instant(cloths, 0, 0).frame()), "");
    EXPECT_EQ(meshes.follow(Instant({cloths[0]}, 4, 1).frame()),
              "frame 4: it does not have the cloths of the first frame");
}

TEST(ConstantMesh, OfARemovedTriangleThatReturnsIsRefused) {
    const TornFilm film;
    ConstantMeshes meshes;
    for (const std::size_t f : {0u, 3u}) ASSERT_EQ(meshes.follow(film.at(f)->frame()), "");
    EXPECT_THAT(meshes.follow(film.at(2)->frame()), HasSubstr("has triangle 8 again, which was removed"));
}

TEST(ConstantMesh, WithColorsThatAreNoNumbersIsTheSameCloth) {
    std::vector<Cloth> cloths = {make_cloth("c", 4, 0, true)};
    cloths[0].mesh.colors[5].x = std::numeric_limits<float>::quiet_NaN();
    ConstantMeshes meshes;
    for (const std::uint64_t version : {1, 2}) {
        Instant instant(cloths, 0, 0);
        instant.surfaces[0].topology_version = version;
        EXPECT_EQ(meshes.follow(instant.frame()), "");
    }
}

}  // namespace
}  // namespace weft
