// Malformed input from files and programs gives a clear error, or cloth that stays finite and a report.
// tests/physics/malformed.test.cpp tests malformed input of the solver itself.
#include "base/temporary_folder.test.h"

#include <weft/weft.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace weft {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

bool is_finite(const Simulation& simulation) {
    for (std::size_t i = 0; i < simulation.cloth_count(); ++i) {
        const Surface cloth = simulation.cloth(i);
        if (!std::ranges::all_of(cloth.positions, [](Vec3 p) { return finite(p); })) return false;
        if (!std::ranges::all_of(cloth.normals, [](Vec3 n) { return std::abs(length(n) - 1) < 1e-3f; })) return false;
    }
    return true;
}

class MalformedScene : public testing::Test {
  protected:
    Result<Simulation> load(const std::string& cloth_keys, const std::string& scene_keys = "") {
        return Simulation::load(folder.write("s.json", R"({"weft": 1, "cloths": [{"name": "c", )" + cloth_keys +
                                                           R"(}], "colliders": [{"name": "ball", "sphere": {}}])" +
                                                           scene_keys + "}"));
    }
    std::string problem(const std::string& cloth_keys, const std::string& scene_keys = "") {
        const auto simulation = load(cloth_keys, scene_keys);
        if (simulation) return "none";
        EXPECT_EQ(simulation.errors().size(), 1u);
        const std::string message = simulation.error().message(), place = (folder.path() / "s.json: ").string();
        EXPECT_THAT(message, StartsWith(place));
        return message.substr(std::min(place.size(), message.size()));
    }
    void expect_to_last(const std::string& cloth_keys, const std::string& scene_keys = "", int frames = 5) {
        auto simulation = load(cloth_keys, scene_keys);
        ASSERT_TRUE(simulation.ok()) << simulation.error().message();
        for (int i = 0; i < frames; ++i) {
            simulation->step();
            ASSERT_TRUE(is_finite(*simulation)) << cloth_keys << scene_keys << " frame " << i;
        }
    }

    TemporaryFolder folder;
};

const std::string grid = R"("mesh": {"grid": {"resolution": [8, 8]}})",
                  hung = grid + R"(, "pins": [{"vertices": [0, 7]}])";

TEST_F(MalformedScene, frame_rates_at_their_ends) {
    for (const char* rate : {"1e-38", "1e-3", "0.1", "100000"})
        expect_to_last(hung, R"(, "frame_rate": )" + std::string(rate));
    expect_to_last(hung, R"(, "frame_rate": 100000, "solver": {"substeps": 10000})", 1);
    EXPECT_EQ(problem(hung, R"(, "frame_rate": 0)"), "/frame_rate: must be > 0 frames/s, got 0");
    EXPECT_EQ(problem(hung, R"(, "frame_rate": 1e9)"), "/frame_rate: must be ≤ 100000 frames/s, got 1e9");
}

TEST_F(MalformedScene, gravity_and_air_at_their_ends) {
    expect_to_last(hung, R"(, "gravity": [0, -1e6, 0])");
    expect_to_last(hung, R"(, "gravity": [1e6, 1e6, 1e6], "solver": {"method": "pbd", "projection": "jacobi"})");
    EXPECT_EQ(problem(hung, R"(, "gravity": [0, -1e7, 0])"), "/gravity/1: must be ≥ -1000000 m/s², got -10000000");
    for (const char* scale : {"1e-38", "1e6"}) {
        for (const char* velocity : {"[1e4, -1e4, 1e4]", "[0, 0, 0]", "[0, 1e-38, 0]"}) {
            expect_to_last(
                hung, R"(, "air": {"density": 1e4, "wind": [{"velocity": )" + std::string(velocity) +
                          R"(, "gust": {"amplitude": 100, "frequency": 1000, "phase": "scattered", "scale": )" + scale +
                          R"(}, "turbulence": {"strength": 100, "period": 1e-38, "scale": )" + scale + "}}]}");
        }
    }
    for (const char* wind :
         {R"("kind": "jet", "diameter": 1e-6, "shelter": 1e6)", R"("kind": "jet", "diameter": 1e6)",
          R"("kind": "vortex", "swirl": 1e4, "inflow": -1e4, "radius": 1e-6)",
          R"("kind": "vortex", "radius": 1e6, "box": {"half_extents": [1e-9, 1e-9, 1e-9], "border": 0})"}) {
        expect_to_last(hung, R"(, "air": {"density": 1e4, "wind": [{"velocity": [1e4, 1e4, 1e4],
            "motion": {"keys": [{"strength": 100}]}, )" +
                                 std::string(wind) + "}]}");
    }
    EXPECT_EQ(problem(hung, R"(, "air": {"density": -1})"), "/air/density: must be ≥ 0 kg/m³, got -1");
}

TEST_F(MalformedScene, pins_that_name_nothing) {
    const auto pins = [&](const std::string& pin) { return problem(grid + R"(, "pins": [)" + pin + "]"); };
    EXPECT_EQ(pins(R"({"vertices": []})"), "/cloths/0/pins/0/vertices: must name at least one vertex");
    EXPECT_EQ(pins(R"({"vertices": [64]})"),
              "/cloths/0/pins/0/vertices/0: must be less than 64, the number of particles, got 64");
    EXPECT_EQ(pins(R"({"box": {"min": [7, 7, 7], "max": [8, 8, 8]}})"), "/cloths/0/pins/0/box: no vertex lies in it");
    EXPECT_EQ(pins(R"({"vertices": [0], "attach": "bell"})"),
              "/cloths/0/pins/0/attach: unknown collider \"bell\"; did you mean \"ball\"?");
}

TEST_F(MalformedScene, everything_held_nothing_held_and_held_by_springs) {
    const std::string all = R"(, "pins": [{"box": {"min": [-9, -9, -9], "max": [9, 9, 9]})";
    auto still = load(grid + all + "}]");
    ASSERT_TRUE(still.ok());
    const std::string before = still->state_hash();
    for (int i = 0; i < 5; ++i) still->step();
    EXPECT_EQ(still->state_hash(), before);
    expect_to_last(grid);
    for (const char* compliance : {"1e-12", "1e6"}) {
        for (const char* rate : {R"(, "frame_rate": 1e-3)", "", R"(, "frame_rate": 100000)"}) {
            expect_to_last(grid + all + R"(, "compliance": )" + compliance + "}]", rate);
            expect_to_last(grid + all + R"(, "attach": "ball", "compliance": )" + compliance + "}]",
                           rate + std::string(R"(, "solver": {"projection": "jacobi", "iterations": 3})"));
        }
    }
    EXPECT_EQ(problem(grid + all + R"(, "compliance": 1e7}])"),
              "/cloths/0/pins/0/compliance: must be ≤ 1000000 m/N, got 10000000");
}

TEST_F(MalformedScene, cloth_of_any_size_and_weight) {
    const auto sheet = [](const char* size, const char* scale) {
        return R"("mesh": {"grid": {"resolution": [4, 4], "size": [)" + std::string(size) + ", " + size +
               R"(]}}, "transform": {"scale": )" + scale + "}";
    };
    expect_to_last(sheet("1e-9", "1"));
    expect_to_last(sheet("1e6", "1"));
    expect_to_last(sheet("1e6", "1e3"));
    EXPECT_EQ(problem(sheet("1e6", "1e6")),
              "/cloths/0: particle 0: its mass of infinity kg has no finite inverse in single precision");
    EXPECT_THAT(problem(sheet("1e-30", "1e-6")), AllOf(StartsWith("/cloths/0: particle 0: its mass of "),
                                                       EndsWith(" kg has no finite inverse in single precision")));
    EXPECT_EQ(problem(grid + R"(, "fabric": {"density": -1})"), "/cloths/0/fabric/density: must be > 0 kg/m², got -1");
}

TEST_F(MalformedScene, mesh_files_name_themselves_in_the_error) {
    const auto file = [&](const std::string& name, const std::string& content) {
        folder.write(name, content);
        return problem(R"("mesh": {"file": ")" + name + "\"}");
    };
    const std::string place = "/cloths/0/mesh/file: " + folder.path().string() + "/";
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n";
    EXPECT_THAT(problem(R"("mesh": {"file": "none.obj"})"),
                StartsWith("/cloths/0/mesh/file: none.obj: not found; tried "));
    EXPECT_EQ(file("a.obj", ""), place + "a.obj: is empty");
    EXPECT_EQ(file("a.obj", square + "f 1 2 9\n"), place + "a.obj: line 5: a face uses number 9 of 4 vertices");
    EXPECT_EQ(file("a.obj", square + "v nan 0 0\nf 1 2 3\n"), place + "a.obj: line 5: vertex 4 is not finite");
    EXPECT_THAT(file("a.obj", square + "f 1 1 2\n"), HasSubstr("a.obj: must have at least one triangle with an area"));
    EXPECT_EQ(file("a.obj", square + "v 5 5 5\nf 1 2 3\nf 1 2 3\nf 3 2 1\nf 1 1 2\n"), "none");
}

TEST(MalformedSimulation, time_steps) {
    for (const char* method : {"xpbd", "pbd"}) {
        for (const char* projection : {"gauss-seidel", "jacobi"}) {
            auto simulation =
                Simulation::create({.air = AirDesc{}}, {.solver = {{"method", method}, {"projection", projection}}});
            ASSERT_TRUE(simulation.ok());
            ASSERT_TRUE(simulation->add(ColliderDesc{.shape = SphereDesc{0.2f}}).ok());
            ASSERT_TRUE(
                simulation->add({.mesh = GridDesc{.resolution = {9, 9}}, .pins = {{.select = VertexPins{{0}}}}}).ok());
            for (const double dt : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()})
                EXPECT_THAT(simulation->step(dt).error().message(), StartsWith("dt: must be > 0 s and ≤ 1000 s, got "));
            EXPECT_EQ(simulation->frame(), 0u);
            for (const double dt : {1e-300, 1e-40, 1e-9, 10.0, 1000.0}) {
                for (int i = 0; i < 3; ++i) {
                    ASSERT_TRUE(simulation->step(dt).ok());
                    ASSERT_TRUE(is_finite(*simulation)) << dt;
                }
            }
        }
    }
}

TEST(MalformedSimulation, bytes_that_are_not_a_saved_state) {
    auto simulation = Simulation::create();
    ASSERT_TRUE(simulation->add({.mesh = GridDesc{.resolution = {5, 5}}}).ok());
    simulation->step();
    const std::string before = simulation->state_hash();
    const auto refusal = [&](std::span<const std::byte> bytes) {
        const auto restored = simulation->restore_state(bytes);
        EXPECT_EQ(simulation->state_hash(), before);
        return restored ? "none" : restored.error().message();
    };
    EXPECT_EQ(refusal({}), "state: is not a saved state of weft");
    std::mt19937 random(3);
    std::vector<std::byte> garbage(5000);
    for (std::byte& b : garbage) b = static_cast<std::byte>(random());
    EXPECT_EQ(refusal(garbage), "state: is not a saved state of weft");
    const std::vector<std::byte> whole = simulation->save_state();
    std::copy(whole.begin(), whole.begin() + 8, garbage.begin());
    EXPECT_EQ(refusal(garbage), "state: is damaged: its checksum does not fit");
    EXPECT_EQ(refusal(std::span(whole).first(whole.size() / 2)), "state: is damaged: its checksum does not fit");
    std::vector<std::byte> later = whole;
    later[4] = std::byte{77};
    EXPECT_EQ(refusal(later), "state: has version 77, this weft reads 7");
    EXPECT_EQ(refusal(whole), "none");
}

TEST(MalformedSimulation, pins_of_nothing) {
    auto simulation = Simulation::create();
    const auto cloth = simulation->add({.mesh = GridDesc{.resolution = {5, 5}}, .pins = {{}}});
    ASSERT_FALSE(cloth.ok());
    EXPECT_EQ(cloth.error().message(), "/pins/0/vertices: must name at least one vertex");
    const auto other = simulation->add({.mesh = GridDesc{.resolution = {5, 5}}});
    EXPECT_FALSE(simulation->set_pins(*other, {{}}).ok());
    EXPECT_TRUE(simulation->set_pins(*other, {}).ok()) << "no pins are no mistake";
}

// Smaller with sanitizers, which are slow.
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr std::uint32_t side = 1000;
#else
constexpr std::uint32_t side = 200;
#endif

template <class T>
void append(std::string& out, const T& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string large_ply() {
    const std::uint32_t cells = side - 1;
    std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(side * side) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(2 * cells * cells) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (std::uint32_t z = 0; z < side; ++z)
        for (std::uint32_t x = 0; x < side; ++x)
            append(out, std::array{static_cast<float>(x) / side, 0.0f, static_cast<float>(z) / side});
    for (std::uint32_t z = 0; z < cells; ++z) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = z * side + x, b = a + 1, c = a + side, d = c + 1;
            for (const std::array<std::uint32_t, 3>& triangle : {std::array{a, c, b}, std::array{b, c, d}}) {
                out.push_back(3);
                append(out, triangle);
            }
        }
    }
    return out;
}

class MillionVertices : public MalformedScene {
  protected:
    void expect_to_run(const std::string& mesh) {
        auto simulation =
            load(R"("mesh": {)" + mesh + R"(}, "pins": [{"vertices": [0]}])", R"(, "solver": {"substeps": 1})");
        ASSERT_TRUE(simulation.ok()) << simulation.error().message();
        simulation->step();
        EXPECT_EQ(simulation->cloth(0).positions.size(), std::size_t{side} * side);
        EXPECT_TRUE(is_finite(*simulation));
        EXPECT_LT(simulation->cloth(0).positions.back().y, 0);
    }
};

// Labels: long no-asan
TEST_F(MillionVertices, of_a_file) {
    folder.write("large.ply", large_ply());
    expect_to_run(R"("file": "large.ply")");
}

// Labels: slow no-asan
TEST_F(MillionVertices, of_a_grid) {
    expect_to_run(R"("grid": {"resolution": [)" + std::to_string(side) + ", " + std::to_string(side) + "]}");
}

}  // namespace
}  // namespace weft
