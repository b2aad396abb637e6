// Reads any bytes as a scene file. The result is either readable errors, or a scene that passes its checks, is the same
// after writing and reading, and, if its mesh files exist, builds a world that stays finite.
#include "io/scenes/scene_file.h"
#include "io/scenes/scene_writer.h"
#include "scene/check.h"
#include "weft/drawn_frame.h"
#include "weft/scene_world.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using namespace weft;

void require(bool targets, const char* what) {
    if (targets) return;
    std::fprintf(stderr, "scene fuzzer: %s\n", what);
    std::abort();
}

void require_readable(const Errors& errors) {
    require(!errors.empty(), "refused without an error");
    for (const Error& error : errors) {
        require(!error.what.empty(), "an error that says nothing");
        require(error.message().find('\n') == std::string::npos, "an error of several lines");
    }
}

bool is_finite(const DrawnSurface& surface) {
    const auto all = [](std::span<const Vec3> vectors) {
        return std::ranges::all_of(vectors, [](Vec3 v) { return finite(v); });
    };
    return all(surface.positions) && all(surface.normals);
}

/// Any made mesh with few vertices: pins that then name none are one more error to report. Returns whether it is one.
bool shrink(MeshDesc& mesh) {
    const auto at_most = [](auto& numbers, std::uint32_t most) {
        for (std::uint32_t& number : numbers) number = std::min(number, most);
    };
    if (auto* grid = std::get_if<GridDesc>(&mesh)) at_most(grid->resolution, 6);
    if (auto* box = std::get_if<BoxMeshDesc>(&mesh)) at_most(box->resolution, 3);
    if (auto* sphere = std::get_if<SphereMeshDesc>(&mesh)) sphere->subdivisions = std::min(sphere->subdivisions, 1u);
    return !std::holds_alternative<MeshFileDesc>(mesh);
}

/// Shrinks the scene for hundreds of worlds per second; false if that is not possible.
bool shrink(SceneDesc& scene) {
    scene.solver.substeps = std::min(scene.solver.substeps, 3u);
    scene.solver.iterations = std::min(scene.solver.iterations, 2u);
    if (scene.cloths.size() > 4 || scene.colliders.size() > 8) return false;
    return std::ranges::all_of(scene.cloths, [](SceneCloth& cloth) {
        return shrink(cloth.mesh) && (!cloth.render_mesh || shrink(*cloth.render_mesh));
    });
}

void simulate(SceneDesc scene) {
    auto session = SceneWorld::create(std::move(scene), {});
    if (!session) return require_readable(session.errors());
    DrawnFrame drawn;
    for (int i = 0; i < 2; ++i) {
        session->step();
        drawn.update(session->world().frame());
        require(std::ranges::all_of(drawn.surfaces(), is_finite), "a frame is not finite");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Result<SceneDesc> scene = parse_scene(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
    if (!scene) {
        require_readable(scene.errors());
        return 0;
    }
    require(check_scene(*scene).empty(), "a scene that was read does not pass its checks");
    require(!scene->cloths.empty(), "a scene without cloths was read");
    const Result<std::string> text = write_scene(*scene);
    require(text.ok(), "a scene that was read cannot be written");
    const Result<SceneDesc> again = parse_scene(*text, "written.json");
    require(again.ok() && *again == *scene, "a scene that was written is another one");
    if (shrink(*scene)) simulate(std::move(*scene));
    return 0;
}
