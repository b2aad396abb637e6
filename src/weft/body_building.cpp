#include "weft/body_building.h"

#include "collide/body_features.h"
#include "collide/body_mass.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace weft {
namespace {

/// The parts of the description that the mass follows from.
bool same_mass(const BodyDesc& a, const BodyDesc& b) {
    return a.mass == b.mass && a.density == b.density && a.center == b.center && a.inertia == b.inertia;
}

const Collider* find_twin(const Collider& collider, const BodyDesc& desc, std::span<const Collider> others) {
    if (!collider.data) return nullptr;
    const auto twin = std::ranges::find_if(others, [&](const Collider& other) {
        return other.body && other.data == collider.data && other.numbers == collider.numbers &&
               same_mass(other.body->desc, desc);
    });
    return twin != others.end() ? &*twin : nullptr;
}

Errors errors_in_body(const std::string& pointer, const Errors& errors) {
    Errors placed;
    for (const Error& error : errors)
        placed.push_back({pointer + "/motion/dynamic" + error.where, error.what, error.fault});
    return placed;
}

}  // namespace

Result<void> add_body(Collider& collider, const ColliderDesc& desc, std::span<const Collider> others,
                      const std::string& pointer, std::vector<std::string>& notes) {
    const bool mesh = std::holds_alternative<SolidMeshDesc>(desc.shape);
    const ShapeData* data = collider.data.get();
    if (!desc.body) {
        if (mesh && !desc.motion.empty()) collider.features.points = features_of(desc.shape, data).points;
        return {};
    }
    Body body;
    body.desc = *desc.body;
    if (const Collider* twin = find_twin(collider, *desc.body, others)) {
        body.mass = body.own = twin->body->own;
        collider.features = twin->features;
    } else {
        std::string note;
        const auto mass = body_mass_of(*desc.body, desc.shape, data, &note);
        if (!mass) return errors_in_body(pointer, mass.errors());
        body.mass = body.own = *mass;
        if (mesh) collider.features = features_of(desc.shape, data);
        if (!note.empty()) notes.push_back("collider '" + desc.name + "': " + note);
    }
    if (mesh)
        notes.push_back("collider '" + desc.name + "': other bodies meet the convex hull of the mesh, with " +
                        std::to_string(collider.features.points.size()) + " corners; cloth meets the mesh itself");
    collider.body = std::move(body);
    return {};
}

}  // namespace weft
