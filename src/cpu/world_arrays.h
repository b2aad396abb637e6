// The particles of all cloths, in shared arrays.
#pragma once

#include "base/aligned.h"
#include "cpu/passes.h"

#include <weft/vector.h>

#include <cstdint>
#include <span>

namespace weft::cpu {

/// The state that a step continues from, for a range of particles; members as in ParticleView.
struct Particles {
    std::span<Vec4> position, start, velocity, compensation;

    ParticleView view() const { return {&position[0].x, &start[0].x, &velocity[0].x, &compensation[0].x}; }
};

/// One element per particle of the world, dummies and anchors included.
struct WorldArrays {
    AlignedVector<Vec4> position, start, velocity, compensation;
    AlignedVector<Vec4> normals;
    AlignedVector<float> weight;  ///< 1/kg: inverse masses, 0 for pinned particles
    /// The state before the current frame, for rolling back. The fourth floats of `good_position` are those of `start`:
    /// inverse masses are stored above, and the rest of `start` is not needed.
    AlignedVector<Vec4> good_position, good_velocity, good_compensation;

    /// Keeps existing elements; new ones are zero.
    void resize(std::size_t count) {
        for (auto* array : {&position, &start, &velocity, &compensation, &normals, &good_position, &good_velocity,
                            &good_compensation})
            array->resize(count);
        weight.resize(count);
    }
    std::size_t size() const { return position.size(); }

    Particles range(std::size_t begin, std::size_t count) {
        const auto part = [&](AlignedVector<Vec4>& array) { return std::span(array).subspan(begin, count); };
        return {part(position), part(start), part(velocity), part(compensation)};
    }
};

}  // namespace weft::cpu
