#include "io/exports/torn_film.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>

namespace weft {
namespace {

using test::Cloth;
using test::expect_shows;
using test::export_film;
using test::Instant;
using test::make_cloth;
using test::read_text;
using test::TestFolder;
using test::TornFilm;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

tinygltf::Model load(const std::filesystem::path& path) {
    tinygltf::Model model;
    std::string error, warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path.string())) << error;
    EXPECT_EQ(error + warning, "");
    return model;
}

template <class Value>
std::vector<Value> values(const tinygltf::Model& model, int accessor_index) {
    const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(accessor_index));
    const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    EXPECT_EQ(view.byteLength, accessor.count * sizeof(Value));
    EXPECT_EQ(view.byteOffset % 4, 0u);
    std::vector<Value> result(accessor.count);
    std::memcpy(result.data(), model.buffers.at(0).data.data() + view.byteOffset, view.byteLength);
    return result;
}

void expect_bounds(const tinygltf::Model& model, int accessor_index) {
    const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(accessor_index));
    Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    for (const Vec3& v : values<Vec3>(model, accessor_index)) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    EXPECT_EQ(accessor.minValues, (std::vector<double>{low.x, low.y, low.z}));
    EXPECT_EQ(accessor.maxValues, (std::vector<double>{high.x, high.y, high.z}));
}

void expect_bounds_if_any(const tinygltf::Model& model, int accessor_index) {
    if (!model.accessors.at(static_cast<std::size_t>(accessor_index)).minValues.empty())
        expect_bounds(model, accessor_index);
}

/// base + delta, both rounded to float, may be off by the rounding error of each.
void expect_close(const std::vector<Vec3>& base, const std::vector<Vec3>& delta, const std::vector<Vec3>& expected) {
    ASSERT_EQ(base.size(), expected.size());
    ASSERT_EQ(delta.size(), expected.size());
    float worst = 0;
    for (std::size_t i = 0; i < base.size(); ++i) {
        const Vec3 off = base[i] + delta[i] - expected[i];
        worst = std::max({worst, std::abs(off.x), std::abs(off.y), std::abs(off.z)});
    }
    EXPECT_LE(worst, 2.5e-7f);
}

TEST(GlbExport, EveryTargetAndKeyIsItsFrame) {
    const TestFolder folder;
    // Two cloths of the same name, one with colors, one without UVs.
    std::vector<Cloth> cloths = {make_cloth("cloth", 6, 0.2f, true), make_cloth("cloth", 9, 1)};
    cloths[1].mesh.uvs.clear();
    constexpr std::size_t frames = 5;
    constexpr double rate = 50;
    ASSERT_TRUE(export_film(folder / "a.glb", cloths, frames, rate).ok());
    const tinygltf::Model model = load(folder / "a.glb");
    EXPECT_THAT(model.asset.generator, HasSubstr("weft "));
    EXPECT_EQ(model.scenes.at(0).name, "waves");
    ASSERT_EQ(model.meshes.size(), cloths.size());
    ASSERT_EQ(model.scenes[0].nodes.size(), cloths.size());

    for (std::size_t c = 0; c < cloths.size(); ++c) {
        const TriangleMesh& mesh = cloths[c].mesh;
        EXPECT_EQ(model.nodes.at(c).name, "cloth");
        EXPECT_EQ(model.nodes[c].mesh, static_cast<int>(c));
        EXPECT_EQ(model.meshes[c].weights, std::vector<double>(frames - 1, 0.0));
        const tinygltf::Primitive& primitive = model.meshes[c].primitives.at(0);
        EXPECT_TRUE(model.materials.at(static_cast<std::size_t>(primitive.material)).doubleSided);

        const std::vector<std::uint16_t> indices = values<std::uint16_t>(model, primitive.indices);
        ASSERT_EQ(indices.size(), 3 * mesh.triangles.size());
        EXPECT_TRUE(std::equal(indices.begin(), indices.end(), mesh.triangles.front().data()));

        Instant first(cloths, 0, 0);
        const std::vector<Vec3> positions = values<Vec3>(model, primitive.attributes.at("POSITION"));
        const std::vector<Vec3> normals = values<Vec3>(model, primitive.attributes.at("NORMAL"));
        EXPECT_EQ(positions, first.positions(c));
        EXPECT_EQ(normals, first.normals(c));
        expect_bounds(model, primitive.attributes.at("POSITION"));

        EXPECT_EQ(primitive.attributes.count("TEXCOORD_0"), mesh.uvs.empty() ? 0u : 1u);
        EXPECT_EQ(primitive.attributes.count("COLOR_0"), mesh.colors.empty() ? 0u : 1u);
        if (c == 0) {
            const std::vector<Vec2> uvs = values<Vec2>(model, primitive.attributes.at("TEXCOORD_0"));
            for (std::size_t i = 0; i < uvs.size(); ++i) {
                EXPECT_EQ(uvs[i], (Vec2{mesh.uvs[i].x, 1 - mesh.uvs[i].y}));
            }
            EXPECT_EQ(values<Vec4>(model, primitive.attributes.at("COLOR_0")), mesh.colors);
        }

        ASSERT_EQ(primitive.targets.size(), frames - 1);
        for (std::size_t t = 0; t + 1 < frames; ++t) {
            Instant instant(cloths, t + 1, static_cast<double>(t + 1) / rate);
            const auto& target = primitive.targets[t];
            expect_close(positions, values<Vec3>(model, target.at("POSITION")), instant.positions(c));
            expect_close(normals, values<Vec3>(model, target.at("NORMAL")), instant.normals(c));
            expect_bounds(model, target.at("POSITION"));
        }
    }

    ASSERT_EQ(model.animations.size(), 1u);
    const tinygltf::Animation& animation = model.animations[0];
    ASSERT_EQ(animation.samplers.size(), 1u);
    ASSERT_EQ(animation.channels.size(), cloths.size());
    for (std::size_t c = 0; c < cloths.size(); ++c) {
        EXPECT_EQ(animation.channels[c].sampler, 0);
        EXPECT_EQ(animation.channels[c].target_node, static_cast<int>(c));
        EXPECT_EQ(animation.channels[c].target_path, "weights");
    }
    EXPECT_EQ(animation.samplers[0].interpolation, "LINEAR");
    const std::vector<float> times = values<float>(model, animation.samplers[0].input);
    const std::vector<float> weights = values<float>(model, animation.samplers[0].output);
    ASSERT_EQ(times.size(), frames);
    ASSERT_EQ(weights.size(), frames * (frames - 1));
    for (std::size_t i = 0; i < frames; ++i) {
        EXPECT_EQ(times[i], static_cast<float>(static_cast<double>(i) / rate));
        for (std::size_t t = 0; t + 1 < frames; ++t) {
            EXPECT_EQ(weights[i * (frames - 1) + t], i == t + 1 ? 1.0f : 0.0f) << "key " << i << " target " << t;
        }
    }
}

TEST(GlbExport, OneFrameIsAMeshWithoutAnimation) {
    const TestFolder folder;
    ASSERT_TRUE(export_film(folder / "a.glb", {make_cloth("c", 3, 0)}, 1).ok());
    const tinygltf::Model model = load(folder / "a.glb");
    EXPECT_TRUE(model.animations.empty());
    EXPECT_TRUE(model.meshes.at(0).weights.empty());
    EXPECT_TRUE(model.meshes[0].primitives.at(0).targets.empty());
}

TEST(GlbExport, IndicesWidenWhereSixteenBitsEnd) {
    const TestFolder folder;
    const auto index_type = [&](std::uint32_t resolution) {
        EXPECT_TRUE(export_film(folder / "a.glb", {make_cloth("c", resolution, 0)}, 1).ok());
        const tinygltf::Model model = load(folder / "a.glb");
        return model.accessors.at(static_cast<std::size_t>(model.meshes[0].primitives[0].indices)).componentType;
    };
    EXPECT_EQ(index_type(255), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    EXPECT_EQ(index_type(256), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);  // 65536 vertices, the last is 65535
}

TEST(GlbExport, AnOddNumberOfShortIndicesStaysAligned) {
    const TestFolder folder;
    Cloth cloth = make_cloth("c", 3, 0);
    cloth.mesh.triangles.pop_back();
    ASSERT_EQ(cloth.mesh.triangles.size() % 2, 1u);
    ASSERT_TRUE(export_film(folder / "a.glb", {cloth}, 2).ok());
    const tinygltf::Model model = load(folder / "a.glb");
    const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
    EXPECT_EQ(values<std::uint16_t>(model, primitive.indices).size(), 3 * cloth.mesh.triangles.size());
    EXPECT_EQ(values<Vec3>(model, primitive.attributes.at("POSITION")), cloth.at(0).first);
}

TEST(GlbExport, MissingNormalsBecomeUnit) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("c", 3, 0)};
    const auto exporter = make_exporter(folder / "a.glb");
    ASSERT_TRUE(exporter.ok() && (*exporter)->begin({"s", 60, 2}).ok());
    for (std::uint64_t i = 0; i < 2; ++i) {
        Instant instant(cloths, i, static_cast<double>(i));
        instant.normals(0)[4] = i == 0 ? Vec3{} : Vec3{0, 0, 5};
        ASSERT_TRUE((*exporter)->write(instant.frame()).ok());
    }
    ASSERT_TRUE((*exporter)->finish().ok());
    const tinygltf::Model model = load(folder / "a.glb");
    const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
    EXPECT_EQ(values<Vec3>(model, primitive.attributes.at("NORMAL"))[4], (Vec3{0, 1, 0}));
    EXPECT_EQ(values<Vec3>(model, primitive.targets.at(0).at("NORMAL"))[4], (Vec3{0, -1, 1}));
}

TEST(GlbExport, FourGibibytesAreRefusedAtTheFirstFrame) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("c", 300, 0)};
    // 2000 frames of 90 000 vertices: 4.3e9 bytes of deltas. A million frames: the weights alone exceed the limit.
    for (const auto& [frames, cloth] :
         {std::pair{2000u, cloths}, std::pair{1000000u, std::vector{make_cloth("d", 2, 0)}}}) {
        const auto exporter = make_exporter(folder / "a.glb");
        ASSERT_TRUE(exporter.ok() && (*exporter)->begin({"s", 60, frames}).ok());
        const Result<void> written = (*exporter)->write(Instant(cloth, 0, 0).frame());
        ASSERT_FALSE(written.ok());
        EXPECT_THAT(written.error().message(),
                    AllOf(HasSubstr("a.glb: would take"), HasSubstr("cannot be larger than 4 GiB")));
    }
    EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(GlbExport, RefusesFramesThatAreNoFilm) {
    const TestFolder folder;
    const std::vector<Cloth> cloths = {make_cloth("c", 4, 0)}, more = {make_cloth("c", 5, 0)};
    const auto exporter = make_exporter(folder / "a.glb");
    ASSERT_TRUE(exporter.ok() && (*exporter)->begin({"s", 60, 3}).ok());
    ASSERT_TRUE((*exporter)->write(Instant(cloths, 0, 0.5).frame()).ok());
    const auto problem = [&](const std::vector<Cloth>& content, double time) {
        const Instant instant(content, 1, 1);
        const Result<void> written = (*exporter)->write({1, time, instant.surfaces});
        return written ? std::string("none") : written.error().what;
    };
    EXPECT_THAT(problem(cloths, 0.5), HasSubstr("must be later than"));
    EXPECT_THAT(problem(cloths, -1), HasSubstr("at least 0"));
    EXPECT_THAT(problem(cloths, std::numeric_limits<double>::quiet_NaN()), HasSubstr("at least 0"));
    EXPECT_EQ(problem(cloths, 1), "none");
    EXPECT_EQ(
        problem(more, 2),
        "frame 1: cloth \"c\" has 32 triangles instead of 18, so it is not the cloth of the frames before; write a "
        "sequence instead");
}

TEST(GlbExport, AClothThatPartsHasOneListOfTriangles) {
    for (const bool removes : {false, true}) {
        const TestFolder folder;
        const TornFilm film(removes);
        ASSERT_TRUE(film.write(folder / "a.glb").ok());
        EXPECT_THAT(folder.names(), testing::ElementsAre("a.glb"));
        const tinygltf::Model model = load(folder / "a.glb");
        ASSERT_EQ(model.meshes.size(), 2u);
        for (std::size_t c = 0; c < 2; ++c) {
            const tinygltf::Primitive& primitive = model.meshes[c].primitives.at(0);
            const std::vector<std::uint16_t> indices = values<std::uint16_t>(model, primitive.indices);
            std::vector<Triangle> triangles;
            for (std::size_t i = 0; i < indices.size(); i += 3)
                triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
            const auto vectors = [&](const std::map<std::string, int>& accessors, const char* name) {
                expect_bounds_if_any(model, accessors.at(name));
                return values<Vec3>(model, accessors.at(name));
            };
            const std::vector<Vec3> positions = vectors(primitive.attributes, "POSITION");
            const std::vector<Vec3> normals = vectors(primitive.attributes, "NORMAL");
            EXPECT_EQ(positions.size(), c == 0 ? film.vertices() : 9u);
            EXPECT_EQ(values<Vec2>(model, primitive.attributes.at("TEXCOORD_0")).size(), positions.size());
            ASSERT_EQ(primitive.targets.size(), film.size() - 1);
            for (std::size_t f = 0; f < film.size(); ++f) {
                const auto instant = film.at(f);
                const std::vector<Triangle>& surface = film.cloths(f)[c].mesh.triangles;
                if (f == 0) {
                    expect_shows(triangles, positions, surface, instant->positions(c), f);
                    expect_shows(triangles, normals, surface, instant->normals(c), f);
                    continue;
                }
                const auto& target = primitive.targets[f - 1];
                const std::vector<Vec3> moved = vectors(target, "POSITION"), turned = vectors(target, "NORMAL");
                // As the sum of base and difference, rounded to float.
                const auto at_corners = [&](const std::vector<Triangle>& corners, const std::vector<Vec3>& of_vertex) {
                    std::vector<Vec3> all;
                    for (const Triangle& triangle : corners)
                        for (const std::uint32_t v : triangle) all.push_back(of_vertex.at(v));
                    return all;
                };
                expect_close(at_corners(triangles, positions), at_corners(triangles, moved),
                             at_corners(surface, instant->positions(c)));
                expect_close(at_corners(triangles, normals), at_corners(triangles, turned),
                             at_corners(surface, instant->normals(c)));
            }
            // No seam before it opens, to the bit.
            if (c == 0 && !removes) {
                const std::vector<Vec3> moved = vectors(primitive.targets[0], "POSITION");
                const std::vector<Vec3> turned = vectors(primitive.targets[0], "NORMAL");
                for (std::size_t t = 0; t < triangles.size(); ++t) {
                    for (std::size_t k = 0; k < 3; ++k) {
                        const std::uint32_t v = triangles[t][k], original = film.torn(1).triangles[t][k];
                        EXPECT_EQ(moved[v], moved[original]);
                        EXPECT_EQ(turned[v], turned[original]);
                    }
                }
            }
        }
        const std::vector<Vec4> colors = values<Vec4>(model, model.meshes[0].primitives[0].attributes.at("COLOR_0"));
        EXPECT_EQ(colors.size(), film.vertices());
        EXPECT_EQ(colors[16], film.torn(5).colors[16]);
        EXPECT_EQ(model.animations.at(0).channels.size(), 2u);
        EXPECT_EQ(values<float>(model, model.animations[0].samplers.at(0).input).size(), film.size());
    }
}

TEST(GlbExport, IndicesWidenIfVerticesThatPartPassSixteenBits) {
    const TestFolder folder;
    Cloth strip{"strip", make_grid({1, 1}, {2, 32767}, GridDiagonal::alternating)};
    ASSERT_EQ(strip.mesh.positions.size(), 65534u);
    Cloth torn = strip;
    // The last triangle gets three vertices of its own.
    for (std::uint32_t& vertex : torn.mesh.triangles.back()) {
        torn.mesh.positions.push_back(Vec3(torn.mesh.positions[vertex]));
        torn.mesh.uvs.push_back(Vec2(torn.mesh.uvs[vertex]));
        vertex = static_cast<std::uint32_t>(torn.mesh.positions.size() - 1);
    }
    const auto exporter = make_exporter(folder / "a.glb");
    ASSERT_TRUE(exporter.ok() && (*exporter)->begin({"s", 60, 2}).ok());
    const std::vector<Cloth> before = {strip}, after = {torn};
    ASSERT_TRUE((*exporter)->write(Instant(before, 0, 0).frame()).ok());
    Instant last(after, 1, 1);
    last.surfaces[0].topology_version = 2;
    ASSERT_TRUE((*exporter)->write(last.frame()).ok() && (*exporter)->finish().ok());
    const tinygltf::Model model = load(folder / "a.glb");
    const std::vector<std::uint32_t> indices =
        values<std::uint32_t>(model, model.meshes.at(0).primitives.at(0).indices);
    ASSERT_EQ(indices.size(), 3 * torn.mesh.triangles.size());
    std::size_t same = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) same += indices[i] == torn.mesh.triangles[i / 3][i % 3];
    // A corner that no other triangle shared keeps its vertex.
    EXPECT_GE(same, indices.size() - 1);
    EXPECT_GE(std::ranges::max(indices), 65535u);
}

TEST(GlbExport, AFilmThatMayPassFourGibibytesEndsWhereItIsCertain) {
    const TestFolder folder;
    constexpr std::uint64_t frames = 32600;  // their weights alone take 4.25e9 bytes
    const std::vector<Cloth> whole = {make_cloth("c", 4, 0)};
    std::vector<Cloth> torn = whole;  // into single triangles
    for (Triangle& triangle : torn[0].mesh.triangles) {
        for (std::uint32_t& vertex : triangle) {
            torn[0].mesh.positions.push_back(Vec3(torn[0].mesh.positions[vertex]));
            torn[0].mesh.uvs.push_back(Vec2(torn[0].mesh.uvs[vertex]));
            vertex = static_cast<std::uint32_t>(torn[0].mesh.positions.size() - 1);
        }
    }
    const auto exporter = make_exporter(folder / "a.glb");
    ASSERT_TRUE(exporter.ok());
    Instant first(whole, 0, 0);
    const auto certain = (*exporter)->estimate({"s", 60, frames}, first.frame());
    first.surfaces[0].spare_vertices = 54;
    const auto bound = (*exporter)->estimate({"s", 60, frames}, first.frame());
    ASSERT_TRUE(certain.ok() && bound.ok()) << "it may end with fewer vertices";
    EXPECT_GT(bound->bytes, certain->bytes);
    EXPECT_EQ(bound->bytes, 4294967295u);

    ASSERT_TRUE((*exporter)->begin({"s", 60, frames}).ok());
    ASSERT_TRUE((*exporter)->write(first.frame()).ok());
    ASSERT_TRUE((*exporter)->write(Instant(whole, 1, 1).frame()).ok());
    Instant third(torn, 2, 2);
    third.surfaces[0].topology_version = 2;
    const Result<void> written = (*exporter)->write(third.frame());
    ASSERT_FALSE(written.ok());
    EXPECT_THAT(written.error().what, HasSubstr("GiB for 32600 frames, but a .glb cannot be larger than 4 GiB"));
}

TEST(GlbExport, ANameThatIsNotTextIsAnError) {
    const TestFolder folder;
    const Result<void> done = export_film(folder / "a.glb", {make_cloth("\xff\xfe", 3, 0)}, 1);
    ASSERT_FALSE(done.ok());
    EXPECT_THAT(done.error().what, HasSubstr("cannot be written"));
    EXPECT_THAT(folder.names(), IsEmpty());
    EXPECT_TRUE(export_film(folder / "b.glb", {make_cloth("größe \"x\" \n", 3, 0)}, 2).ok());
    EXPECT_EQ(load(folder / "b.glb").nodes.at(0).name, "größe \"x\" \n");
}

}  // namespace
}  // namespace weft
