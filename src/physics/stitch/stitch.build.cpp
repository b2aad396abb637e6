#include "physics/stitch/stitch.h"

namespace weft {

bool add_stitch(RowList& rows, const StitchPoint& a, const StitchPoint& b, float gap, float compliance) {
    constexpr std::uint32_t most = 6;
    std::array<std::uint32_t, most> particles;
    std::array<float, most> shares{};
    particles.fill(no_particle);
    std::uint32_t count = 0;
    const auto add = [&](std::uint32_t particle, float share) {
        if (share == 0) return;
        std::uint32_t at = 0;
        while (at < count && particles[at] != particle) ++at;
        if (at == count) particles[count++] = particle;
        shares[at] += share;
    };
    for (std::uint32_t k = 0; k < 3; ++k) add(a.particles[k], a.shares[k]);
    for (std::uint32_t k = 0; k < 3; ++k) add(b.particles[k], -b.shares[k]);
    bool any = false;
    for (std::uint32_t k = 0; k < count; ++k) any = any || shares[k] != 0;
    if (!any) return false;
    const auto& [p0, p1, p2, p3, p4, p5] = particles;
    const auto& [c0, c1, c2, c3, c4, c5] = shares;
    rows.add({p0, p1, p2, p3, p4, p5}, {c0, c1, c2, c3, c4, c5, gap, compliance});
    return true;
}

}  // namespace weft
