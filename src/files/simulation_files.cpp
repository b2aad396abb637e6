// The part of the public Simulation that reads and writes files.
#include "files/open_scene.h"
#include "io/exports/exporter.h"
#include "io/exports/scene_export.h"
#include "io/meshes/mesh_file.h"
#include "io/scenes/scene_file.h"
#include "weft/simulation_access.h"

#include <weft/files.h>
#include <weft/simulation.h>

#ifdef WEFT_VULKAN
#include <weft/vulkan.h>
#endif

namespace weft {
namespace {

Result<Simulation> load_with(const std::filesystem::path& file, const Options& options, const MakeBackend& make) {
    auto scene = load_scene(file);
    if (!scene) return scene.errors();
    auto simulation = SimulationAccess::create(std::move(*scene), with_mesh_files(options), file.parent_path(), make);
    if (!simulation) return in_scene_file(file, simulation.errors());
    return simulation;
}

}  // namespace

Result<TriangleMesh> read_mesh_file(const std::string& file, const std::filesystem::path& folder) {
    const auto path = find_asset(file, folder);
    if (!path) return path.errors();
    return load_mesh(*path);
}

Result<Simulation> Simulation::load(const std::filesystem::path& scene, const Options& options) {
    return load_with(scene, options, {});
}

#ifdef WEFT_VULKAN
Result<Simulation> load_on(const VulkanHost& host, const std::filesystem::path& scene, const Options& options) {
    return load_with(scene, options, SimulationAccess::backend_on(host));
}
#endif

Result<void> Simulation::save(const std::filesystem::path& file, const SaveOptions& options) const {
    auto exporter = make_exporter(file);
    if (!exporter) return exporter.errors();
    const SceneDesc& scene = SimulationAccess::scene(*this);
    if (auto begun = (*exporter)->begin({scene.name, scene.frame_rate, 1, SimulationAccess::folder(*this)}); !begun)
        return begun;
    const ExportFrame shown{frame(), time(), SimulationAccess::surfaces(*this),
                            SimulationAccess::solids(*this, options.colliders)};
    if (auto written = (*exporter)->write(shown); !written) return written;
    return (*exporter)->finish();
}

Result<void> Simulation::save_scene(const std::filesystem::path& file) const {
    const auto written = export_scene(SimulationAccess::scene(*this), SimulationAccess::folder(*this), file);
    if (!written) return written.errors();
    return {};
}

}  // namespace weft
