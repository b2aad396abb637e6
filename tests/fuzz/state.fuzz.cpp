// Reads any bytes as a saved state: the result is a readable error, or a world that continues and stays finite.
//
// The first byte chooses. 'w': the input as it is. 'b': the rest under a right header and checksum. Any other: a true
// state, whose words are changed at the places that the input names, under a right checksum again; so everything behind
// the checksum is reached too.
#include "base/hash.h"
#include "cpu/cpu_backend.h"
#include "mesh/procedural.h"
#include "solver/measures/statistics.h"
#include "solver/state/snapshot.h"
#include "solver/world/world.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace weft;

void require(bool targets, const char* what) {
    if (targets) return;
    std::fprintf(stderr, "state fuzzer: %s\n", what);
    std::abort();
}

bool is_sound(const World& world) {
    const auto all = [](std::span<const Vec4> vectors) {
        return std::ranges::all_of(vectors, [](const Vec4& v) { return finite(v.xyz()); });
    };
    return std::ranges::all_of(world.frame().cloths, [&](const ClothFrame& cloth) {
        return all(cloth.positions) && all(cloth.velocities) && all(cloth.normals);
    });
}

/// A world whose state has anchors, several kinds of constraints and a moving collider.
World make_world() {
    auto backend = make_cpu_backend();
    require(backend.ok(), "no backend");
    World world(std::move(*backend),
                {.solver = {.substeps = 2, .iterations = 2}, .air = AirDesc{.wind = {{.velocity = {1, 0, 0}}}}});
    world.add(make_collider(
        {.name = "ball", .shape = SphereDesc{0.2f}, .motion = {{0, {}, {}}, {2, {0, 1, 0}, {90, 0, 0}}}}));
    TriangleMesh mesh = make_grid({0.5f, 0.5f}, {4, 3}, GridDiagonal::alternating);
    auto topology = build_topology(mesh, {.reorder = false});
    require(topology.ok(), "no topology");
    auto model = build_cloth_model({.name = "cloth",
                                    .mesh = std::move(mesh),
                                    .pins = {.particles = {0}, .attachments = {{3, 1e-3f, {0.2f, 0, -0.2f}}}}},
                                   std::move(*topology));
    require(model.ok(), "no model");
    world.add(*model);
    world.grab(world.cloth_id(0), 5, {0.2f, 0.3f, 0.5f}, {0, 0.1f, 0});
    for (int i = 0; i < 3; ++i) world.step(1.0 / 60);
    return world;
}

constexpr std::size_t head_size = 16, checksum_at = 8;

/// The same as in snapshot.cpp.
void sign(std::vector<std::byte>& bytes) {
    StateHash hash;
    for (std::size_t i = head_size; i + 4 <= bytes.size(); i += 4) {
        std::uint32_t word;
        std::memcpy(&word, bytes.data() + i, 4);
        hash.add(word);
    }
    const std::uint64_t sum = hash.value();
    std::memcpy(bytes.data() + checksum_at, &sum, sizeof sum);
}

std::vector<std::byte> state_of(std::span<const std::byte> input, const std::vector<std::byte>& whole) {
    const char first = input.empty() ? '\0' : static_cast<char>(input.front());
    if (first == 'w') return {input.begin() + 1, input.end()};
    std::vector<std::byte> bytes = whole;
    if (first == 'b') {
        bytes.resize(head_size);
        bytes.insert(bytes.end(), input.begin() + 1, input.end());
    } else {
        struct Change {
            std::uint16_t place;
            std::uint32_t word;
        };
        constexpr std::size_t size = sizeof(Change::place) + sizeof(Change::word);
        const std::size_t words = (whole.size() - head_size) / 4;
        for (auto rest = input.subspan(std::min<std::size_t>(1, input.size())); rest.size() >= size;
             rest = rest.subspan(size)) {
            Change change{};
            std::memcpy(&change.place, rest.data(), sizeof change.place);
            std::memcpy(&change.word, rest.data() + sizeof change.place, sizeof change.word);
            std::memcpy(bytes.data() + head_size + change.place % words * 4, &change.word, sizeof change.word);
        }
    }
    sign(bytes);
    return bytes;
}

void require_readable(const Errors& errors) {
    require(!errors.empty(), "refused without an error");
    for (const Error& error : errors) {
        require(!error.what.empty(), "an error that says nothing");
        require(error.message().find('\n') == std::string::npos, "an error of several lines");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static World world = make_world();
    static const Snapshot good = world.save();
    static const std::vector<std::byte> whole = to_bytes(good);
    static const std::string hash = world.state_hash();

    const std::vector<std::byte> bytes = state_of(std::as_bytes(std::span(data, size)), whole);
    const Result<Snapshot> snapshot = snapshot_from_bytes(bytes);
    if (!snapshot) {
        require_readable(snapshot.errors());
        return 0;
    }
    require(std::ranges::equal(to_bytes(*snapshot), bytes), "what was read is written otherwise");
    const Result<void> restored = world.restore(*snapshot);
    if (!restored) {
        require_readable(restored.errors());
        require(world.state_hash() == hash, "refused, and yet the world is another");
        return 0;
    }
    require(is_sound(world), "restored, and not finite");
    for (int i = 0; i < 2; ++i) {
        world.step(1.0 / 60);
        require(is_sound(world), "not finite after a step");
    }
    require(world.restore(good).ok() && world.state_hash() == hash, "there is no way back to a good state");
    return 0;
}
