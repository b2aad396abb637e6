#include "physics/membrane/membrane_split.h"

#include "physics/scalar.h"

#include <algorithm>
#include <numbers>

namespace weft {
namespace {

using reference::vec3;
using Three = std::array<double, 3>;

MembraneShape shape_of(const RestShape& rest, std::uint32_t triangle) {
    const Triangle& corners = rest.topology.triangles[triangle];
    std::array<vec3, 3> x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = reference::to_double(rest.topology.rest_positions[corners[i]]);
    const vec3 normal = reference::cross(x[1] - x[0], x[2] - x[0]);
    const vec3 warp = reference::to_double(rest.warp[triangle]);
    const vec3 weft = reference::cross(normal, warp) * (1 / std::sqrt(reference::dot(normal, normal)));
    MembraneShape shape;
    for (std::size_t i = 0; i < 3; ++i) {
        const vec3 edge = x[(i + 2) % 3] - x[(i + 1) % 3];
        shape.along_warp[i] = reference::dot(edge, warp), shape.along_weft[i] = reference::dot(edge, weft);
    }
    return shape;
}

/// Inverse of a matrix given by rows; zeros if it has none.
SymmetricMatrix inverse(const SymmetricMatrix& m) {
    SymmetricMatrix inverse{};
    const double determinant = determinant_of(m);
    if (determinant == 0) return inverse;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) inverse[i][j] = cofactor(m, j, i) / determinant;
    return inverse;
}

SymmetricMatrix membrane_of(const MembraneShape& shape, const float (&moduli)[2], float shear) {
    // The measure of an edge is e·ε e, with ε in the coordinates warp, weft and the angle between them.
    SymmetricMatrix strains{};
    for (std::size_t i = 0; i < 3; ++i) {
        strains[i] = {shape.along_warp[i] * shape.along_warp[i], shape.along_weft[i] * shape.along_weft[i],
                      shape.along_warp[i] * shape.along_weft[i]};
    }
    const SymmetricMatrix of_measures = inverse(strains);
    const double area =
        0.5 * std::abs(shape.along_warp[0] * shape.along_weft[1] - shape.along_weft[0] * shape.along_warp[1]);
    const Three stiffness = {moduli[0], moduli[1], shear};
    SymmetricMatrix m{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) m[i][j] += area * stiffness[k] * of_measures[k][i] * of_measures[k][j];
    return m;
}

/// The most that can be taken from m[i][i] before the matrix has a negative eigenvalue: the stiffness of measure i
/// while the other two are free.
double with_others_free(const SymmetricMatrix& m, std::size_t i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double jj = m[j][j], kk = m[k][k], jk = m[j][k], ij = m[i][j], ik = m[i][k];
    const double determinant = jj * kk - jk * jk;
    double taken = 0;
    if (determinant > 1e-10 * jj * kk) {
        taken = (ij * ij * kk - 2 * ij * ik * jk + ik * ik * jj) / determinant;
    } else if (jj + kk > 0) {  // of rank 1
        taken = (ij * ij * jj + 2 * ij * ik * jk + ik * ik * kk) / ((jj + kk) * (jj + kk));
    }
    const double left = m[i][i] - taken;
    return left > 1e-10 * m[i][i] ? left : 0;
}

/// Takes from the diagonal in this order.
Three take_in_order(SymmetricMatrix m, const std::array<std::size_t, 3>& order) {
    Three taken{};
    for (const std::size_t i : order) {
        taken[i] = with_others_free(m, i);
        m[i][i] -= taken[i];
    }
    return taken;
}

/// The same part of each measure's stiffness with the others free, as large as possible.
Three take_alike(const SymmetricMatrix& m) {
    Three taken{};
    for (std::size_t i = 0; i < 3; ++i) taken[i] = with_others_free(m, i);
    if (!(taken[0] > 0 && taken[1] > 0 && taken[2] > 0)) return {};
    SymmetricMatrix scaled{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) scaled[i][j] = m[i][j] / std::sqrt(taken[i] * taken[j]);
    const double part = std::clamp(least_eigenvalue(scaled), 0.0, 1.0) * (1 - 1e-9);
    for (double& one : taken) one *= part;
    return taken;
}

/// Diagonal that leaves no negative eigenvalue in M: among a few, the one with most of the stiffness against strains.
Three best_springs(const SymmetricMatrix& m, const Three& length2) {
    static constexpr std::array<std::size_t, 3> orders[] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                                            {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    const auto worth = [&](const Three& taken) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += taken[i] * length2[i] * length2[i];
        return sum;
    };
    Three best = take_alike(m);
    double most = worth(best);
    for (const auto& order : orders) {
        const Three taken = take_in_order(m, order);
        const double sum = worth(taken);
        if (sum > most * (1 + 1e-9)) best = taken, most = sum;
    }
    return best;
}

}  // namespace

MembraneSplit split_membrane(const MembraneShape& shape, const StretchMaterial& material, double weight) {
    Three length2{};
    for (std::size_t i = 0; i < 3; ++i)
        length2[i] = shape.along_warp[i] * shape.along_warp[i] + shape.along_weft[i] * shape.along_weft[i];
    MembraneSplit split;
    split.remainder = membrane_of(shape, material.stretch, material.shear);
    const Three pulled = best_springs(split.remainder, length2);
    const bool alike = std::ranges::equal(material.stretch, material.compression);
    const Three pushed =
        alike ? pulled : best_springs(membrane_of(shape, material.compression, material.shear), length2);
    for (std::size_t i = 0; i < 3; ++i) {
        const double all = split.remainder[i][i];
        split.remainder[i][i] -= pulled[i];
        if (!(split.remainder[i][i] > 1e-9 * all))  // rounding of what was taken
            for (std::size_t j = 0; j < 3; ++j) split.remainder[i][j] = split.remainder[j][i] = 0;
        split.stretched[i] = pulled[i] * length2[i], split.compressed[i] = pushed[i] * length2[i];
    }
    if (weight == 1) return split;
    for (std::size_t i = 0; i < 3; ++i) {
        split.stretched[i] *= weight, split.compressed[i] *= weight;
        for (double& number : split.remainder[i]) number *= weight;
    }
    return split;
}

MembraneSplit split_membrane(const RestShape& rest, std::uint32_t triangle, const StretchMaterial& material) {
    return split_membrane(shape_of(rest, triangle), material, weight_at(rest.stretch_weight, triangle));
}

}  // namespace weft
