// How a program embeds weft: the samples of docs/embedding.md and docs/cookbook.md, word by word.
#include <weft/weft.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace {

// The vertices of an engine, as it holds them.
struct EngineVertex {
    weft::Vec3 position, normal;
};

// A strip of cloth along x, 4 cm wide.
weft::TriangleMesh engine_mesh() {
    weft::TriangleMesh mesh;
    for (std::uint32_t i = 0; i <= 20; ++i) {
        mesh.positions.push_back({0.02f * static_cast<float>(i), 0, 0});
        mesh.positions.push_back({0.02f * static_cast<float>(i), 0, 0.04f});
    }
    for (std::uint32_t i = 0; i < 40; i += 2) {
        mesh.triangles.push_back({i, i + 1, i + 2});
        mesh.triangles.push_back({i + 1, i + 3, i + 2});
    }
    return mesh;
}

int embed() {
    auto world = weft::Simulation::create();
    auto hand = world->add(weft::ColliderDesc{.name = "hand", .shape = weft::SphereDesc{0.05f}});
    auto cloth = world->add({.mesh = engine_mesh(), .pins = {{.select = weft::VertexPins{{0}}, .attach = "hand"}}});
    if (!hand || !cloth) return 1;
    std::vector<EngineVertex> vertices(world->surface(*cloth).positions.size());
    for (int frame = 0; frame < 60; ++frame) {
        if (!world->move(*hand, {0.2f * std::sin(0.1f * static_cast<float>(frame)), 0, 0})) return 1;
        world->step();  // 1/60 s
        const weft::Surface surface = world->surface(*cloth);
        for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = {surface.positions[i], surface.normals[i]};
    }
    std::cout << "lowest vertex at " << vertices.back().position.y << " m\n";
    return 0;
}

int handle_errors() {
    auto world = weft::Simulation::create();
    auto cloth = world->add({.fabric = weft::FabricDesc("cotton").set("density", -1)});
    if (!cloth)
        for (const weft::Error& error : cloth.errors()) std::cerr << error.message() << '\n';
    return cloth.ok() ? 1 : 0;  // this one fails: /fabric/density: must be > 0 kg/m², got -1
}

int step_on_a_thread() {
    auto world = weft::Simulation::create();
    auto cloth = world->add({.mesh = weft::GridDesc{.resolution = {32, 32}}});
    if (!cloth) return 1;
    std::thread physics([&] { world->step(); });
    // … the main thread draws the copy of the last frame …
    physics.join();
    const weft::Surface surface = world->surface(*cloth);
    std::vector<weft::Vec3> copy(surface.positions.begin(), surface.positions.end());
    return copy.size() == 1024 ? 0 : 1;
}

int run_two_worlds_on_two_threads() {
    const auto run = [](std::string& hash) {
        auto world = weft::Simulation::create();
        if (!world || !world->add({.mesh = weft::GridDesc{.resolution = {24, 24}}})) return;
        for (int frame = 0; frame < 10; ++frame) world->step();
        hash = world->state_hash();
    };
    std::string here, there, alone;
    run(alone);
    std::thread other([&] { run(there); });
    run(here);
    other.join();
    return here == alone && there == alone && !alone.empty() ? 0 : 1;
}

int go_back_in_time() {
    auto world = weft::Simulation::create();
    auto cloth = world->add({.mesh = weft::GridDesc{.resolution = {16, 16}}});
    if (!cloth) return 1;
    const std::vector<std::byte> state = world->save_state();
    world->step();
    const std::string first = world->state_hash();
    if (!world->restore_state(state)) return 1;
    world->step();
    return world->state_hash() == first ? 0 : 1;  // the same bits
}

int read_own_files() {
    weft::Options options;
    options.read_mesh = [](const std::string& file, const std::filesystem::path&) -> weft::Result<weft::TriangleMesh> {
        if (file != "asset:strip") return weft::Error{file, "is not in the asset store"};
        return engine_mesh();
    };
    auto world = weft::Simulation::create({}, options);
    auto cloth = world->add({.mesh = weft::MeshFileDesc{.file = "asset:strip"}});
    return cloth.ok() ? 0 : 1;
}

}  // namespace

int main() {
    return embed() + handle_errors() + step_on_a_thread() + run_two_worlds_on_two_threads() + go_back_in_time() +
           read_own_files();
}
