// What contact between cloths keeps for every particle of the world, for all islands: an island uses the elements of
// its own particles.
#pragma once

#include "cpu/cloth_contact/contact_loops.h"

#include <weft/vector.h>

#include <cstdint>
#include <vector>

namespace weft::cpu {

struct ContactArrays {
    AlignedVector<Vec4> reached;   ///< where the constraints left the particles
    AlignedVector<Vec4> asked;     ///< before the limit
    AlignedVector<Vec4> farthest;  ///< from the listed trajectories
    /// Static and kinetic friction; m: how far pushes may move a particle from where the constraints left it, with and
    /// without what is added while surfaces move.
    AlignedVector<Vec4> numbers;
    AlignedVector<ContactSums> sums, unscaled;            ///< 0 between two uses
    std::vector<AlignedVector<ContactSums>> worker_sums;  ///< by worker, if several share an island; likewise
    std::vector<float> part;                              ///< of its motion that the brake leaves to a particle
    std::vector<Vec3> slide;                              ///< motion that the limit leaves to a particle that slides
    std::vector<std::uint8_t> retreats;                   ///< how often the limit has sent the particle back
    std::vector<std::uint8_t> sent_back;
    /// The moving surface that carries the particle along, or to which it belongs, counted from 1; 0: none.
    std::vector<std::uint32_t> carrier;
    std::vector<std::uint32_t> next_carrier;  ///< that the limit asks to carry the particle; 0: none
    std::vector<std::uint32_t> marks;         ///< ContactMark, without mark_touches

    /// Makes room for so many particles.
    void reserve(std::size_t particles, unsigned workers) {
        worker_sums.resize(workers > 1 ? workers : 0);
        for (auto& of_worker : worker_sums) of_worker.resize(particles);
        if (part.size() >= particles) return;
        for (auto* array : {&reached, &asked, &farthest, &numbers}) array->resize(particles);
        sums.resize(particles), unscaled.resize(particles), marks.resize(particles);
        part.resize(particles), slide.resize(particles), retreats.resize(particles), sent_back.resize(particles);
        carrier.resize(particles), next_carrier.resize(particles);
    }
};

}  // namespace weft::cpu
