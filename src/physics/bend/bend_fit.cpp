#include "physics/bend/bend_fit.h"

#include "physics/bend/hinge_at_rest.h"
#include "physics/symmetric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace weft {
namespace {

using Three = std::array<double, 3>;
using Tensor = SymmetricMatrix;

/// Sizes in edges from the middle of a patch.
struct PatchSize {
    std::uint32_t radius = 6;
    std::uint32_t held_from() const { return radius - 1; }
    std::uint32_t core() const { return radius - 3; }
};
constexpr std::uint32_t least_radius = 4;

/// A hinge of a flat patch: its angle is a linear function of the heights of its four vertices.
struct FlatHinge {
    std::array<std::uint32_t, 4> vertex{};
    std::array<double, 4> slope{};  ///< rad per height
    double stiffness = 0;           ///< of a sheet with B = 1: ℓ²/(A₁ + A₂)
    Three direction{};              ///< parts of the factors of warp, bias and weft
    double weight = 0;              ///< part of it that lies in the core
};

/// A part of the mesh around a particle, laid flat. The heights of its rim are held at those of a curved sheet.
struct Patch {
    std::vector<std::array<double, 2>> place;  ///< along warp and weft, in mean edges
    std::vector<std::uint32_t> free;           ///< vertex → unknown, or `none` where it is held
    std::uint32_t unknowns = 0;
    std::vector<FlatHinge> hinges;
    double core_area = 0;
    /// The core reaches the border of the mesh, so curvature across it is not that of a wide sheet.
    bool narrow = false;
    double along_warp = 0, along_weft = 0;  ///< extent
    double extent() const { return std::max(along_warp, along_weft); }
    /// Whether the rim is whole at the lower and the upper end along each axis.
    std::array<std::array<bool, 2>, 2> rim{};
    bool is_held() const {
        const auto along = [&](std::size_t axis) { return rim[axis][0] && rim[axis][1]; };
        return narrow ? along(along_warp > along_weft ? 0 : 1) : along(0) && along(1);
    }
};

std::vector<std::uint32_t> rings_around(const Topology& topology, std::uint32_t middle, const PatchSize& size,
                                        std::vector<std::uint32_t>& found) {
    std::vector<std::uint32_t> ring(topology.particle_count, none);
    ring[middle] = 0;
    found = {middle};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::uint32_t at = found[i];
        if (ring[at] == size.radius) break;
        for (const std::uint32_t e : topology.particle_edges[at]) {
            const std::uint32_t other = topology.edges[e].a == at ? topology.edges[e].b : topology.edges[e].a;
            if (ring[other] != none) continue;
            ring[other] = ring[at] + 1;
            found.push_back(other);
        }
    }
    return ring;
}

/// The angle across edge a-b between the triangles with the tips c and d, by the heights of a, b, c and d.
std::optional<FlatHinge> flat_hinge(const std::vector<std::array<double, 2>>& place,
                                    const std::array<std::uint32_t, 4>& vertex) {
    const auto& [a, b] = std::pair(place[vertex[0]], place[vertex[1]]);
    const double ex = b[0] - a[0], ey = b[1] - a[1], squared = ex * ex + ey * ey, length = std::sqrt(squared);
    FlatHinge hinge{.vertex = vertex};
    double area = 0;
    for (const std::size_t tip : {std::size_t{2}, std::size_t{3}}) {
        const double cx = place[vertex[tip]][0] - a[0], cy = place[vertex[tip]][1] - a[1];
        const double height = std::abs(ex * cy - ey * cx) / length, along = (ex * cx + ey * cy) / squared;
        if (!(height > 1e-3 * length)) return std::nullopt;
        area += height * length / 2;
        hinge.slope[tip] = 1 / height;
        hinge.slope[0] -= (1 - along) / height, hinge.slope[1] -= along / height;
    }
    hinge.stiffness = squared / area;
    return hinge;
}

std::optional<Patch> patch_around(const RestShape& rest, std::uint32_t middle, const PatchSize& size) {
    const Topology& topology = rest.topology;
    std::vector<std::uint32_t> vertices;
    const std::vector<std::uint32_t> ring = rings_around(topology, middle, size, vertices);
    const Vec3 origin = topology.rest_positions[middle], normal = rest.frames[middle].normal,
               warp = rest.frames[middle].warp, weft = cross(normal, warp);
    double edges = 0, length_of_edges = 0;
    for (const std::uint32_t e : topology.particle_edges[middle]) {
        ++edges;
        length_of_edges +=
            double{length(topology.rest_positions[topology.edges[e].b] - topology.rest_positions[topology.edges[e].a])};
    }
    const double scale = edges / length_of_edges;
    if (!std::isfinite(scale)) return std::nullopt;

    Patch patch;
    std::vector<std::uint32_t> number(topology.particle_count, none);
    Three least{}, most{};
    for (const std::uint32_t p : vertices) {
        if (dot(rest.frames[p].normal, normal) < 0.9f) return std::nullopt;
        const Vec3 from = topology.rest_positions[p] - origin;
        number[p] = static_cast<std::uint32_t>(patch.place.size());
        patch.place.push_back({scale * double{dot(from, warp)}, scale * double{dot(from, weft)}});
        for (std::size_t k = 0; k < 2; ++k)
            least[k] = std::min(least[k], patch.place.back()[k]), most[k] = std::max(most[k], patch.place.back()[k]);
        patch.free.push_back(ring[p] < size.held_from() ? patch.unknowns++ : none);
        if (ring[p] == size.radius)
            for (std::size_t k = 0; k < 2; ++k)
                if (std::abs(patch.place.back()[k]) > 0.5) patch.rim[k][patch.place.back()[k] > 0] = true;
        patch.narrow |= topology.boundary[p] != 0 && ring[p] <= size.core();
    }
    patch.along_warp = most[0] - least[0], patch.along_weft = most[1] - least[1];

    const auto in_core = [&](std::uint32_t triangle) {
        return std::ranges::all_of(topology.triangles[triangle],
                                   [&](std::uint32_t p) { return ring[p] <= size.core(); });
    };
    for (const std::uint32_t p : vertices) {
        if (ring[p] > size.core()) continue;
        for (const std::uint32_t t : topology.particle_triangles[p]) {
            const auto& [a, b, c] = topology.triangles[t];
            if (p != std::min({a, b, c}) || !in_core(t)) continue;
            const auto &pa = patch.place[number[a]], &pb = patch.place[number[b]], &pc = patch.place[number[c]];
            patch.core_area += 0.5 * std::abs((pb[0] - pa[0]) * (pc[1] - pa[1]) - (pb[1] - pa[1]) * (pc[0] - pa[0]));
        }
    }
    for (const std::uint32_t p : vertices) {
        for (const std::uint32_t e : topology.particle_edges[p]) {
            const auto h = std::ranges::lower_bound(topology.hinges, e, {}, &Hinge::edge);
            if (h == topology.hinges.end() || h->edge != e || h->a != p) continue;
            if (number[h->b] == none || number[h->c] == none || number[h->d] == none) continue;
            auto hinge = flat_hinge(patch.place, {number[h->a], number[h->b], number[h->c], number[h->d]});
            if (!hinge) return std::nullopt;
            const float across = shape_of(rest, *h).across;
            hinge->direction = {directional(1, 0, 0, across), directional(0, 1, 0, across),
                                directional(0, 0, 1, across)};
            hinge->weight = 0.5 * (in_core(h->triangle0) + in_core(h->triangle1));
            patch.hinges.push_back(*hinge);
        }
    }
    if (patch.unknowns == 0 || !(patch.core_area > 0)) return std::nullopt;
    return patch;
}

double factor_of(const FlatHinge& hinge, const Three& factors) {
    return hinge.direction[0] * factors[0] + hinge.direction[1] * factors[1] + hinge.direction[2] * factors[2];
}

/// Solves A x = b in place for three right sides, A with positive eigenvalues. False if it has others.
bool solve(std::vector<double>& a, std::uint32_t n, std::vector<Three>& b) {
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j <= i; ++j) {
            double sum = a[i * n + j];
            for (std::uint32_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
            if (i == j && !(sum > 1e-12 * a[i * n + i])) return false;
            a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
        }
    }
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::uint32_t i = 0; i < n; ++i) {
            for (std::uint32_t k = 0; k < i; ++k) b[i][r] -= a[i * n + k] * b[k][r];
            b[i][r] /= a[i * n + i];
        }
        for (std::uint32_t i = n; i-- > 0;) {
            for (std::uint32_t k = i + 1; k < n; ++k) b[i][r] -= a[k * n + i] * b[k][r];
            b[i][r] /= a[i * n + i];
        }
    }
    return true;
}

/// The solution of C x = m; zeros if C has no inverse.
Three solved(const Tensor& c, const Three& m) {
    const double determinant = determinant_of(c);
    Three x{};
    if (!(determinant > 1e-9 * c[0][0] * c[1][1] * c[2][2])) return x;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) x[i] += cofactor(c, j, i) / determinant * m[j];
    return x;
}

/// Energy ½ κ·C κ per area of the core in equilibrium, κ the curvatures along warp and weft and the twist, and how C
/// changes with each factor.
struct Stiffness {
    Tensor tensor{};
    std::array<Tensor, 3> by_factor{};
};

bool add_stiffness(const Patch& patch, const Three& factors, double part, Stiffness& sum) {
    const std::uint32_t n = patch.unknowns;
    std::vector<double> matrix(std::size_t{n} * n);
    std::vector<Three> heights(n);
    const auto curved = [&](std::uint32_t vertex) {
        const auto& [x, y] = patch.place[vertex];
        return Three{0.5 * x * x, 0.5 * y * y, x * y};
    };
    for (const FlatHinge& hinge : patch.hinges) {
        const double k = hinge.stiffness * factor_of(hinge, factors);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t row = patch.free[hinge.vertex[i]];
            if (row == none) continue;
            for (std::size_t j = 0; j < 4; ++j) {
                const double entry = k * hinge.slope[i] * hinge.slope[j];
                const std::uint32_t column = patch.free[hinge.vertex[j]];
                if (column != none) {
                    matrix[std::size_t{row} * n + column] += entry;
                } else {
                    const Three held = curved(hinge.vertex[j]);
                    for (std::size_t r = 0; r < 3; ++r) heights[row][r] -= entry * held[r];
                }
            }
        }
    }
    if (!solve(matrix, n, heights)) return false;
    for (const FlatHinge& hinge : patch.hinges) {
        if (hinge.weight == 0) continue;
        Three angle{};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t row = patch.free[hinge.vertex[i]];
            const Three height = row == none ? curved(hinge.vertex[i]) : heights[row];
            for (std::size_t r = 0; r < 3; ++r) angle[r] += hinge.slope[i] * height[r];
        }
        const double k = part * hinge.weight * hinge.stiffness / patch.core_area;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                sum.tensor[i][j] += k * factor_of(hinge, factors) * angle[i] * angle[j];
                // The shape has the least energy, so only the factor itself changes the energy.
                for (std::size_t f = 0; f < 3; ++f)
                    sum.by_factor[f][i][j] += k * hinge.direction[f] * angle[i] * angle[j];
            }
        }
    }
    return true;
}

/// Bending stiffness against a moment in one direction alone, over that of the fabric, and its change by each factor.
struct Uniaxial {
    double stiffness = 0;
    Three by_factor{};
};

Uniaxial along(const Stiffness& all, double c, double s) {
    const Three moment = {c * c, s * s, 2 * c * s}, curvature = solved(all.tensor, moment);
    double give = 0;
    for (std::size_t i = 0; i < 3; ++i) give += moment[i] * curvature[i];
    if (!(give > 0)) return {};
    Uniaxial found{.stiffness = 1 / give};
    for (std::size_t f = 0; f < 3; ++f) {
        double change = 0;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) change += curvature[i] * all.by_factor[f][i][j] * curvature[j];
        found.by_factor[f] = change * found.stiffness * found.stiffness;
    }
    return found;
}

/// Along warp, bias and weft; the bias is the mean of both diagonals.
std::array<Uniaxial, 3> uniaxial(const Stiffness& all, double& unlike) {
    const double r = std::sqrt(0.5);
    const Uniaxial one = along(all, r, r), other = along(all, r, -r);
    unlike = std::max(one.stiffness, other.stiffness) / std::max(1e-9, std::min(one.stiffness, other.stiffness));
    Uniaxial bias{.stiffness = (one.stiffness + other.stiffness) / 2};
    for (std::size_t f = 0; f < 3; ++f) bias.by_factor[f] = (one.by_factor[f] + other.by_factor[f]) / 2;
    return {along(all, 1, 0), bias, along(all, 0, 1)};
}

constexpr double least_factor = 0.4, most_factor = 2.5;

std::optional<Stiffness> stiffness_of(const std::vector<Patch>& patches, const Three& factors) {
    Stiffness sum;
    for (const Patch& patch : patches)
        if (!add_stiffness(patch, factors, 1.0 / static_cast<double>(patches.size()), sum)) return std::nullopt;
    return sum;
}

/// Newton's method for factors that make all three stiffnesses those of the fabric.
std::optional<BendFit> fit_all(const std::vector<Patch>& patches) {
    Three factors = {1, 1, 1};
    for (int i = 0; i < 12; ++i) {
        const auto all = stiffness_of(patches, factors);
        if (!all) return std::nullopt;
        double unlike = 1, farthest = 0;
        const auto now = uniaxial(*all, unlike);
        // The two diagonals of a grid of uniform ones differ by a factor of three; no factors can change that.
        if (unlike > 1.5) return std::nullopt;
        Tensor slopes{};
        Three off{};
        for (std::size_t k = 0; k < 3; ++k) {
            off[k] = 1 - now[k].stiffness;
            slopes[k] = now[k].by_factor;
            farthest = std::max(farthest, std::abs(off[k]));
        }
        if (farthest < 1e-4) {
            const auto f = [](double v) { return static_cast<float>(v); };
            return BendFit{f(factors[0]), f(factors[1]), f(factors[2])};
        }
        const Three step = solved(slopes, off);
        double largest = 0;
        for (const double one : step) largest = std::max(largest, std::abs(one));
        if (!(largest > 0)) return std::nullopt;
        for (std::size_t k = 0; k < 3; ++k) {
            factors[k] += step[k] * std::min(1.0, 0.3 / largest);
            if (!(factors[k] > least_factor && factors[k] < most_factor)) return std::nullopt;
        }
    }
    return std::nullopt;
}

/// Stiffness of a strip along this axis, which is free to twist.
double without_twist(const Stiffness& all, std::size_t axis) {
    const double twist = all.tensor[2][2], coupled = all.tensor[axis][2];
    return all.tensor[axis][axis] - (twist > 0 ? coupled * coupled / twist : 0);
}

/// One factor for all directions, from warp and weft; from one of them on a strip.
BendFit fit_alike(const std::vector<Patch>& patches) {
    const auto all = stiffness_of(patches, {1, 1, 1});
    if (!all) return {};
    double warp = 0, weft = 0, sum = 0, count = 0;
    bool narrow = false;
    for (const Patch& patch : patches) {
        narrow |= patch.narrow;
        warp += patch.along_warp, weft += patch.along_weft;
    }
    const auto add = [&](double stiffness) {
        if (stiffness > 0) sum += stiffness, ++count;
    };
    if (!narrow) {
        double unlike = 1;
        const auto now = uniaxial(*all, unlike);
        add(now[0].stiffness), add(now[2].stiffness);
    } else if (warp > 1.5 * weft) {
        add(without_twist(*all, 0));
    } else if (weft > 1.5 * warp) {
        add(without_twist(*all, 1));
    }
    if (!(count > 0)) return {};
    const auto factor = static_cast<float>(std::clamp(count / sum, least_factor, most_factor));
    return {factor, factor, factor};
}

}  // namespace

namespace {

/// Edges from each particle to the border of the mesh, at most `most`.
std::vector<std::uint32_t> rings_from_border(const Topology& topology, std::uint32_t most) {
    std::vector<std::uint32_t> ring(topology.particle_count, most), found;
    for (std::uint32_t p = 0; p < topology.particle_count; ++p)
        if (topology.boundary[p]) ring[p] = 0, found.push_back(p);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::uint32_t at = found[i];
        if (ring[at] + 1 >= most) break;
        for (const std::uint32_t e : topology.particle_edges[at]) {
            const std::uint32_t other = topology.edges[e].a == at ? topology.edges[e].b : topology.edges[e].a;
            if (ring[other] <= ring[at] + 1) continue;
            ring[other] = ring[at] + 1;
            found.push_back(other);
        }
    }
    return ring;
}

/// Some of the particles that are farthest from the border, and `farthest`: how far, in edges, up to this number.
std::vector<std::uint32_t> middles_of(const Topology& topology, std::size_t count, std::uint32_t& farthest) {
    const std::vector<std::uint32_t> ring = rings_from_border(topology, farthest);
    farthest = 0;
    for (const std::uint32_t r : ring) farthest = std::max(farthest, r);
    std::vector<std::uint32_t> inner, middles;
    for (std::uint32_t p = 0; p < topology.particle_count; ++p)
        if (ring[p] == farthest && !topology.particle_triangles[p].empty()) inner.push_back(p);
    for (std::size_t i = 0; i < std::min(count, inner.size()); ++i)
        middles.push_back(inner[(2 * i + 1) * inner.size() / (2 * std::min(count, inner.size()))]);
    return middles;
}

}  // namespace

BendFit fit_bend(const RestShape& rest) {
    constexpr std::size_t most_patches = 3;
    std::vector<Patch> patches;
    std::optional<Patch> longest;
    std::uint32_t farthest = PatchSize{}.radius;
    const std::vector<std::uint32_t> middles = middles_of(rest.topology, most_patches, farthest);
    // Smaller ones where the mesh ends within the largest; on strips they say too little.
    for (PatchSize size; size.radius >= least_radius && patches.empty() && !longest; --size.radius) {
        if (farthest >= least_radius && size.radius > farthest) continue;
        for (const std::uint32_t middle : middles) {
            auto patch = patch_around(rest, middle, size);
            if (!patch || !patch->is_held()) continue;
            if (!patch->narrow) {
                patches.push_back(std::move(*patch));
            } else if (size.radius == PatchSize{}.radius && (!longest || patch->extent() > longest->extent())) {
                longest = std::move(patch);
            }
        }
    }
    if (!patches.empty()) {
        const auto fit = fit_all(patches);
        return fit ? *fit : fit_alike(patches);
    }
    return longest ? fit_alike({*longest}) : BendFit{};
}

}  // namespace weft
