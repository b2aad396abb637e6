// Reads any bytes as a mesh, builds topology and model, and simulates some frames on the CPU. Accepted input must stay
// finite.
//
// The first byte chooses what load_mesh makes of the whole input, see `ending_of`; any other is followed by numbers as
// `ByteReader` takes them.
#include "cpu/cpu_backend.h"
#include "io/meshes/mesh_file.h"
#include "scene/check.h"
#include "scene/scene_keys.h"
#include "solver/measures/statistics.h"
#include "solver/world/world.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>

namespace {

using namespace weft;

void require(bool targets, const std::string& what) {
    if (targets) return;
    std::fprintf(stderr, "mesh fuzzer: %s\n", what.c_str());
    std::abort();
}

bool all_finite(const std::vector<Vec3>& vectors) {
    return std::ranges::all_of(vectors, [](Vec3 v) { return finite(v); });
}

/// Takes values from the front; zeros after the end.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    template <class T>
    T take() {
        T value{};
        const std::size_t count = std::min(sizeof(T), bytes_.size());
        std::memcpy(&value, bytes_.data(), count);
        bytes_ = bytes_.subspan(count);
        return value;
    }
    bool flag() { return take<std::uint8_t>() & 1; }

  private:
    std::span<const std::uint8_t> bytes_;
};

// Large enough for every kind of neighborhood, and small enough for thousands of inputs per second.
constexpr std::uint32_t most_vertices = 40, most_triangles = 60;

/// Mostly coordinates on a small lattice, so that vertices coincide and areas vanish; sometimes any float.
TriangleMesh take_mesh(ByteReader& in) {
    const std::uint8_t style = in.take<std::uint8_t>();
    const bool any_float = style & 1, any_index = style & 2, uvs = style & 4, far = style & 8;
    const std::uint32_t vertices = in.take<std::uint8_t>() % (most_vertices + 1);
    const std::uint32_t triangles = in.take<std::uint8_t>() % (most_triangles + 1);
    const auto number = [&] {
        if (any_float) return in.take<float>();
        const float step = far ? 1000.0f : 0.125f;
        return step * static_cast<float>(in.take<std::int8_t>() % 8);
    };
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const float x = number(), y = number(), z = number();
        mesh.positions.push_back({x, y, z});
        if (!uvs) continue;
        const float u = number(), v = number();
        mesh.uvs.push_back({u, v});
    }
    for (std::uint32_t i = 0; i < triangles; ++i) {
        Triangle& triangle = mesh.triangles.emplace_back();
        for (std::uint32_t& corner : triangle) {
            corner = any_index ? in.take<std::uint32_t>() : in.take<std::uint8_t>() % std::max(1u, vertices);
        }
    }
    return mesh;
}

/// Every number of the tables at its default, an end of its range, or anywhere between.
Fabric take_fabric(ByteReader& in) {
    Fabric fabric;
    fabric.tether.use = in.flag() ? Tethers::on : Tethers::automatic;
    if (!in.flag()) return fabric;
    for (const FabricTable& table : fabric_tables()) {
        for (const Parameter& p : table.parameters) {
            if (p.kind != ParameterKind::number && p.kind != ParameterKind::angle_or_mesh) continue;
            auto* value = reinterpret_cast<std::byte*>(&fabric) + table.offset + p.offset;
            for (unsigned i = 0; i < p.count; ++i, value += sizeof(float)) {
                const std::uint8_t at = in.take<std::uint8_t>();
                if (at == 0) continue;
                const double lowest = p.min_excluded ? std::max(p.min, 1e-6) : p.min;
                const auto chosen = static_cast<float>(lowest + (p.max - lowest) * (at - 1) / 254);
                if (range_problem(p, chosen).empty()) std::memcpy(value, &chosen, sizeof chosen);
            }
        }
    }
    return fabric;
}

void add_colliders(World& world, ByteReader& in) {
    const std::uint8_t which = in.take<std::uint8_t>();
    if (which & 1) world.add(make_collider({.name = "ground", .shape = PlaneDesc{}}));
    if (which & 2) world.add(make_collider({.name = "ball", .shape = SphereDesc{.radius = 0.3f}}));
    if (which & 4) world.add(make_collider({.name = "crate", .shape = BoxDesc{{0.2f, 0.3f, 0.1f}}}));
    if (which & 8) world.add(make_collider({.name = "limb", .shape = CapsuleDesc{}}));
    if (which & 16) world.add(make_collider({.name = "thigh", .shape = TaperedCapsuleDesc{}}));
}

void simulate(TriangleMesh mesh, ByteReader& in) {
    constexpr std::array distances = {0.0f, 0.0f, 1e-6f, 0.1f};
    auto topology = build_topology(
        mesh, {.weld_distance = distances[in.take<std::uint8_t>() % distances.size()], .reorder = in.flag()});
    if (!topology) return require(!topology.errors().empty(), "a topology refused without an error");
    std::vector<std::uint32_t> pinned;
    if (in.flag()) pinned.push_back(in.take<std::uint8_t>() % (topology->particle_count + 1));
    std::optional<TriangleMesh> drawn;
    if (in.flag()) drawn = take_mesh(in);
    auto model = build_cloth_model({.name = "fuzz",
                                    .mesh = std::move(mesh),
                                    .render_mesh = std::move(drawn),
                                    .fabric = take_fabric(in),
                                    .pins = {.particles = std::move(pinned)}},
                                   std::move(*topology));
    if (!model) return require(!model.errors().empty(), "a model refused without an error");

    auto backend = make_cpu_backend();
    require(backend.ok(), "no backend");
    World world(std::move(*backend), {.solver = {.substeps = 1u + in.take<std::uint8_t>() % 4,
                                                 .iterations = 1u + in.take<std::uint8_t>() % 2}});
    add_colliders(world, in);
    world.add(*model);
    std::vector<Vec3> positions, normals;
    for (int i = 0; i < 3; ++i) {
        const Frame& frame = world.step(1.0 / 60);
        require(all_finite(frame), "frame " + std::to_string(i) + " is not finite");
        draw_surface(frame.cloths.front(), positions, normals);
        require(all_finite(positions), "a drawn position is not finite");
        require(all_finite(normals), "a drawn normal is not finite");
    }
}

/// File ending for the first bytes of each format; null if they match none.
const char* ending_of(std::uint8_t first) {
    switch (first) {
        case 'p':
            return ".ply";
        case 'o':
        case 'v':
        case '#':
            return ".obj";
        case '{':
            return ".gltf";
        case 'g':
            return ".glb";
        case 's':
        case ' ':
            return ".stl";
        case ';':
        case 'K':
            return ".fbx";
        case 'M':
            return ".3ds";
        default:
            return nullptr;
    }
}

std::optional<TriangleMesh> read_as_file(std::span<const std::uint8_t> bytes, const char* ending) {
    static const std::string stem =
        (std::filesystem::temp_directory_path() / ("weft_fuzz_" + std::to_string(::getpid()))).string();
    const std::string path = stem + ending;
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    Result<TriangleMesh> mesh = load_mesh(path);
    std::filesystem::remove(path);
    if (mesh) return std::move(*mesh);
    for (const Error& error : mesh.errors()) {
        require(!error.what.empty() && error.message().find('\n') == std::string::npos, "an error is not one line");
    }
    return std::nullopt;
}

/// Checks the guarantees of load_mesh.
void check_loaded(const TriangleMesh& mesh) {
    require(!mesh.triangles.empty(), "a mesh without triangles was loaded");
    require(all_finite(mesh.positions), "a position that is not finite was loaded");
    const auto one_each = [&](std::size_t count) { return count == 0 || count == mesh.positions.size(); };
    require(one_each(mesh.uvs.size()) && one_each(mesh.normals.size()) && one_each(mesh.colors.size()),
            "vertex data was loaded for some vertices only");
    for (const Triangle& triangle : mesh.triangles) {
        require(std::ranges::max(triangle) < mesh.positions.size(), "an index out of range was loaded");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(data, size);
    ByteReader in(bytes);
    const char* ending = ending_of(bytes.empty() ? 0 : bytes.front());
    if (!ending) {
        simulate(take_mesh(in), in);
        return 0;
    }
    std::optional<TriangleMesh> mesh = read_as_file(bytes, ending);
    if (!mesh) return 0;
    check_loaded(*mesh);
    if (mesh->triangles.size() <= most_triangles * 4) simulate(std::move(*mesh), in);
    return 0;
}
