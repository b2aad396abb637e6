#include "cpu/passes.h"

#include "physics/scalar.h"

namespace weft::cpu {

void normals_pass(const SurfaceView& s, Range range) {
    using namespace scalar;
    for (std::size_t i = range.begin; i < range.end; ++i) {
        vec3 sum(0.0f);
        for (std::uint32_t k = s.offsets[i]; k < s.offsets[i + 1]; ++k) {
            const float* n = s.face_normals + std::size_t{4} * s.triangles[k];
            sum = sum + vec3(n[0], n[1], n[2]);
        }
        store_blocks(unit_normal(sum), 0.0f, s.normals + 4 * i);
    }
}

}  // namespace weft::cpu

namespace weft::scalar {

using namespace weft::cpu;

#include "cpu/passes.inl"

static constexpr Passes passes = make_passes("scalar");

}  // namespace weft::scalar

namespace weft::cpu {

const Passes& scalar_passes() {
    return scalar::passes;
}

}  // namespace weft::cpu
