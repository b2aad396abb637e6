#include "cpu/particle_contact/particle_loops.h"
#include "physics/scalar.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace weft::scalar {
namespace {

using namespace weft::cpu;

#include "collide/particle_search.inl"
#include "cpu/particle_contact/particle_loops.inl"

}  // namespace
}  // namespace weft::scalar

namespace weft::cpu {

const ParticleLoops& scalar_particle_loops() {
    static constexpr ParticleLoops table = scalar::particle_loops;
    return table;
}

}  // namespace weft::cpu
