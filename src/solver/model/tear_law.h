// What a cloth that tears by itself needs to find its load (physics/tear/tear.md), as arrays for backends.
#pragma once

#include "base/aligned.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace weft {

struct ClothModel;
struct TearPaint;

/// A triangle with this part of the largest load that its particles can have is looked at in every substep of a frame.
inline constexpr float watched_part_of_load = 0.5f;

/// Numbers of the whole cloth at rest, which openings do not change. Triangles and corners are numbered as in
/// ClothModel::faces, entries as in TearTable.
struct TearLaw {
    std::uint32_t stride = 0;  ///< of triangles
    /// [(WEFT_TEAR_SIDE_NUMBERS · side + number) · stride + triangle]: the numbers of TearSide in their order. Side k
    /// runs from corner k to the next one. A triangle without stress has sides of length 0.
    AlignedVector<float> sides;
    /// [number · stride + triangle]: the numbers of TearCoupling in their order. Empty unless the cloth has membranes.
    AlignedVector<float> couplings;
    AlignedVector<float> area;  ///< m², per triangle; 0 if it has no stress
    struct Entry {
        /// Cosine and sine of twice the angle from the vertex's axes to the triangle's.
        std::array<float, 2> turn{1, 0};
        float angle = 0;               ///< rad: of the triangle at the vertex
        float length = 0;              ///< m: of the link's edge
        std::array<float, 2> along{};  ///< direction of the link's edge from the vertex, in the vertex's axes
    };
    std::vector<Entry> entries;
    /// Per entry: 1 over the strength of the seam that the link's edge belongs to, m/N, its tear energy, J/m, and the
    /// direction across it in the vertex's axes. 0 elsewhere. Empty if the cloth has no seams.
    std::vector<std::array<float, 4>> seams;
    std::vector<float> inverse_resistance;  ///< per vertex: factor on the load
    /// [triangle], then [stride + triangle]: the largest 1/limit of tension at its corners, m/N, and that of strain.
    AlignedVector<float> watch;
    std::array<float, 2> inverse_strength{};  ///< m/N, along warp and weft; 0: no limit
    float tear_energy = 0;                    ///< J/m; 0: `inverse_strength` holds at the ends of cuts too
    float inverse_stretch = 0;                ///< 1 over the largest strain of an edge; 0: no limit
};

/// For the model's fabric and its `tear_paint`. The model must have a tear table.
std::shared_ptr<const TearLaw> make_tear_law(const ClothModel& model);

/// The same model with other strengths at places.
std::shared_ptr<const ClothModel> with_tear_paint(const ClothModel& from, std::shared_ptr<const TearPaint> paint);

}  // namespace weft
