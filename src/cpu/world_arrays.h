// The particles of all cloths, in one address space.
#pragma once

#include "base/aligned.h"
#include "cpu/passes.h"

#include <weft/vector.h>

#include <cstdint>
#include <span>

namespace weft::cpu {

/// What a step goes on from, of a range of particles: as in ParticleView.
struct Particles {
    std::span<Vec4> position, start, velocity, carry;

    ParticleView view() const { return {&position[0].x, &start[0].x, &velocity[0].x, &carry[0].x}; }
};

/// One element per particle of the world, dummies and anchors included.
struct WorldArrays {
    AlignedVector<Vec4> position, start, velocity, carry;
    AlignedVector<Vec4> normals;
    AlignedVector<float> weight;  ///< 1/kg: inverse masses, 0 for pinned particles
    /// What the current frame found, to go back to. The fourth floats of `good_position` are those of `start`: weights
    /// are kept above, and nothing asks where the last substep started.
    AlignedVector<Vec4> good_position, good_velocity, good_carry;

    /// Keeps what is there; what is new is zero.
    void resize(std::size_t count) {
        for (auto* array :
             {&position, &start, &velocity, &carry, &normals, &good_position, &good_velocity, &good_carry})
            array->resize(count);
        weight.resize(count);
    }
    std::size_t size() const { return position.size(); }

    Particles range(std::size_t begin, std::size_t count) {
        const auto part = [&](AlignedVector<Vec4>& array) { return std::span(array).subspan(begin, count); };
        return {part(position), part(start), part(velocity), part(carry)};
    }
};

}  // namespace weft::cpu
