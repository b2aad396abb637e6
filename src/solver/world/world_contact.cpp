// The part of World that concerns contact between cloths: seams, crossings, marks.
#include "solver/plan/cloth_contact_numbers.h"
#include "solver/plan/particle_contact_numbers.h"
#include "solver/world/world.h"

#include <algorithm>

namespace weft {

std::shared_ptr<const Seams> World::seams_of(std::span<const std::uint32_t> cloths,
                                             std::span<const PlacedStitch> stitches) const {
    if (stitches.empty()) return {};
    const bool fast = std::ranges::any_of(
        cloths, [&](std::uint32_t place) { return cloths_[place].model->collision.with_cloth == SelfCollision::fast; });
    std::vector<SeamedCloth> seamed;
    for (const std::uint32_t place : cloths) {
        const ClothModel& model = *cloths_[place].model;
        if (model.collision.with_cloth == SelfCollision::off) continue;
        const float thickness = pair_thickness(model);
        seamed.push_back({.rest = model.start.data(),
                          .base = cloths_[place].base,
                          .count = model.particle_count,
                          .thickness = fast ? std::max(thickness, particle_diameter(model)) : thickness});
    }
    std::vector<SeamTie> ties;
    for (const PlacedStitch& stitch : stitches) ties.push_back({stitch.from, stitch.to, stitch.gap});
    auto seams = std::make_shared<const Seams>(ties, seamed);
    return seams->empty() ? nullptr : std::move(seams);
}

// Looks for crossings of cloths that collide with cloth. A frame that starts without any ends without any, except where
// pins leave no room, which the backend reports; so one search at the start and after changes is enough.
void World::watch_tangle() const {
    std::vector<WatchedCloth> watched;
    for (const Cloth& cloth : cloths_)
        if (cloth.model->tiles) watched.push_back({cloth.model.get(), cloth.base, {}});
    if (watched.empty()) return tangle_.search(watched);
    auto next = watched.begin();
    for (const ClothFrame& cloth : frame().cloths)
        if (cloth.model->tiles) (next++)->positions = cloth.positions;
    for (Surface& surface : surfaces_) {
        surface.positions.clear();
        for (const Vec3 place : places_of(surface)) surface.positions.push_back({place.x, place.y, place.z, 0});
        watched.push_back({surface.model.get(), surface.base, surface.positions});
    }
    std::vector<const Seams*> seams;
    for (const Island& island : islands_)
        if (island.seams) seams.push_back(island.seams.get());
    tangle_.search(watched, seams);
}

void World::collect_contact_marks() const {
    for (std::size_t i = 0; i < cloths_.size(); ++i) {
        std::vector<std::uint32_t>& marks = frame_.cloths[i].contact_marks;
        marks.assign(cloths_[i].model->particle_count, 0);
        backend_->add_contact_marks(cloths_[i].handle, marks);
    }
    if (!tangle_.tangle()) return;
    for (const TangledPair& pair : tangle_.tangle()->pairs) {
        for (const std::uint32_t p : pair.particle)
            if (const auto place = place_of(p))
                frame_.cloths[place->cloth].contact_marks[place->particle] |= mark_tangled;
    }
}

std::optional<ParticlePlace> World::place_of(std::uint32_t particle) const {
    for (std::uint32_t i = 0; i < cloths_.size(); ++i) {
        const Cloth& cloth = cloths_[i];
        if (particle >= cloth.base && particle - cloth.base < cloth.model->particle_count)
            return ParticlePlace{i, particle - cloth.base};
    }
    return {};
}

}  // namespace weft
