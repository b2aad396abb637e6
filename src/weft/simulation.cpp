#include "weft/session.h"

#include <weft/weft.h>

namespace weft {

struct Simulation::Impl {
    Session session;
    DrawnFrame drawn;
};

const char* version() {
    return WEFT_VERSION;
}

Simulation::Simulation(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<Simulation> Simulation::load(const std::filesystem::path& scene, const Options& options) {
    auto session = Session::open(scene, options);
    if (!session) return session.errors();
    auto impl = std::make_unique<Impl>(Impl{std::move(*session), {}});
    impl->drawn.update(impl->session.world().frame());
    return Simulation(std::move(impl));
}

void Simulation::step() {
    impl_->drawn.update(impl_->session.step());
}

std::uint64_t Simulation::frame() const {
    return impl_->session.world().frame().index;
}
double Simulation::time() const {
    return impl_->session.world().frame().time;
}
std::size_t Simulation::cloth_count() const {
    return impl_->drawn.surfaces().size();
}

Surface Simulation::cloth(std::size_t index) const {
    const ExportSurface& surface = impl_->drawn.surfaces()[index];
    return {surface.name, surface.positions, surface.normals, surface.mesh->uvs, surface.mesh->triangles};
}

std::vector<std::string_view> Simulation::reports() const {
    return report_names(impl_->session.world().frame().reports);
}
std::string Simulation::state_hash() const {
    return impl_->session.world().state_hash();
}

Result<Done> Simulation::save(const std::filesystem::path& file) const {
    auto exporter = make_exporter(file);
    if (!exporter) return exporter.errors();
    const Session& session = impl_->session;
    if (auto begun = (*exporter)->begin({session.scene().name, session.scene().frame_rate, 1}); !begun) return begun;
    if (auto written = (*exporter)->write({frame(), time(), impl_->drawn.surfaces()}); !written) return written;
    return (*exporter)->finish();
}

}  // namespace weft
