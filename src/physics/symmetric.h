// Symmetric matrices of three rows without negative eigenvalues, for constraint builders.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace weft {

using SymmetricMatrix = std::array<std::array<double, 3>, 3>;

/// Also of matrices that are not symmetric.
inline double cofactor(const SymmetricMatrix& m, std::size_t i, std::size_t j) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
}
inline double determinant_of(const SymmetricMatrix& m) {
    return m[0][0] * cofactor(m, 0, 0) + m[0][1] * cofactor(m, 0, 1) + m[0][2] * cofactor(m, 0, 2);
}

/// Of a symmetric matrix.
inline double least_eigenvalue(const SymmetricMatrix& m) {
    const double mean = (m[0][0] + m[1][1] + m[2][2]) / 3;
    double off = 0, spread = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        off += m[i][(i + 1) % 3] * m[i][(i + 1) % 3];
        spread += (m[i][i] - mean) * (m[i][i] - mean);
    }
    const double size = std::sqrt((spread + 2 * off) / 6);
    if (!(size > 0)) return mean;
    SymmetricMatrix b = m;
    for (std::size_t i = 0; i < 3; ++i) b[i][i] -= mean;
    const double angle = std::acos(std::clamp(determinant_of(b) / (2 * size * size * size), -1.0, 1.0)) / 3;
    return mean + 2 * size * std::cos(angle + 2 * std::numbers::pi / 3);
}

/// L with L Lᵀ = M, lower triangular. A column is zero if its pivot is below `tolerance` of the diagonal: 0 up to
/// rounding.
inline SymmetricMatrix root_of(const SymmetricMatrix& m, double tolerance) {
    SymmetricMatrix l{};
    for (int k = 0; k < 3; ++k) {
        double pivot = m[k][k];
        for (int j = 0; j < k; ++j) pivot -= l[k][j] * l[k][j];
        if (!(pivot > tolerance * m[k][k])) continue;
        l[k][k] = std::sqrt(pivot);
        for (int i = k + 1; i < 3; ++i) {
            double rest = m[i][k];
            for (int j = 0; j < k; ++j) rest -= l[i][j] * l[k][j];
            l[i][k] = rest / l[k][k];
        }
    }
    return l;
}

}  // namespace weft
