#include "collide/distance_field.h"

#include "collide/field_cover.h"
#include "collide/free_way.h"
#include "collide/solid_surface.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace weft {
namespace {

using namespace field;

constexpr std::uint32_t header_blocks = 3;
constexpr std::size_t words_per_block = 4, bytes_per_block = 16;

// Cells between the mesh and the end of the grid. One more than the band, so that the bounds may round.
constexpr double margin_cells = fine_band + 1;

// In m: far from where the floats of contact overflow or vanish.
constexpr double smallest_mesh = 1e-6, largest_mesh = 1e6;

std::string text_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", number);
    return text;
}

std::optional<Error> problem_of(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                const DistanceFieldOptions& options) {
    if (options.cells < DistanceFieldOptions::fewest_cells || options.cells > DistanceFieldOptions::most_cells) {
        return Error{"", "cells must be from " + std::to_string(DistanceFieldOptions::fewest_cells) + " to " +
                             std::to_string(DistanceFieldOptions::most_cells) + ", got " +
                             std::to_string(options.cells)};
    }
    if (triangles.empty()) return Error{"", "the mesh has no triangles"};
    if (triangles.size() >> 31) return Error{"", "the mesh has 2^31 triangles or more"};
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (!finite(positions[v])) return Error{"vertex " + std::to_string(v), "the position is not finite"};
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const std::uint32_t corner : triangles[t]) {
            if (corner < positions.size()) continue;
            return Error{"triangle " + std::to_string(t), "has vertex " + std::to_string(corner) + ", but there are " +
                                                              std::to_string(positions.size()) + " vertices"};
        }
    }
    return std::nullopt;
}

Result<FieldGrid> make_grid_around(const Bounds& bounds, std::uint32_t cells) {
    const double low[] = {bounds.min.x, bounds.min.y, bounds.min.z};
    const double high[] = {bounds.max.x, bounds.max.y, bounds.max.z};
    double longest = 0, farthest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        longest = std::max(longest, high[k] - low[k]);
        farthest = std::max({farthest, std::abs(low[k]), std::abs(high[k])});
    }
    if (!(longest >= smallest_mesh && longest <= largest_mesh)) {
        return Error{"", "the mesh is " + text_of(longest) + " m long; it must be from " + text_of(smallest_mesh) +
                             " m to " + text_of(largest_mesh) + " m"};
    }
    FieldGrid grid;
    grid.cell = static_cast<float>(longest / cells);
    // Floats of the positions would distort the surface by more than a hundredth of a cell.
    if (farthest * std::numeric_limits<float>::epsilon() > 0.01 * double{grid.cell}) {
        return Error{"", "the mesh is " + text_of(longest) + " m long and up to " + text_of(farthest) +
                             " m away from its origin, too far for floats; move its vertices closer to the origin, or "
                             "use fewer cells"};
    }
    float origin[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const double inside = (high[k] - low[k]) / double{grid.cell};
        grid.places[k] = static_cast<std::uint32_t>(std::ceil((inside + 2 * margin_cells - 1e-3) / side));
        origin[k] = static_cast<float>(0.5 * (low[k] + high[k]) - 0.5 * side * grid.places[k] * double{grid.cell});
    }
    grid.origin = {origin[0], origin[1], origin[2]};
    return grid;
}

// Akenine-Möller, "Fast 3D Triangle-Box Overlap Testing", Journal of Graphics Tools 6(1), 2001, for a cube around the
// origin. Its test of the bounds is left to the caller.
bool may_meet_cube(const std::array<Vec3, 3>& corners, float half) {
    const auto apart = [&](Vec3 axis) {
        const float a = dot(axis, corners[0]), b = dot(axis, corners[1]), c = dot(axis, corners[2]);
        const float reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z)) * 1.00001f;
        return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
    };
    const Vec3 sides[] = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
    if (apart(cross(sides[0], sides[1]))) return false;
    for (const Vec3 s : sides) {
        if (apart({0, -s.z, s.y}) || apart({s.z, 0, -s.x}) || apart({-s.y, s.x, 0})) return false;
    }
    return true;
}

// Runs work(i) for all i below `count` on all workers, in chunks of unknown order.
template <class Work>
void for_all(WorkerTeam& team, std::size_t count, std::size_t chunk, Work&& work) {
    std::atomic<std::size_t> next{0};
    team.run([&](unsigned) {
        for (std::size_t begin; (begin = next.fetch_add(chunk)) < count;) {
            for (std::size_t i = begin; i < std::min(begin + chunk, count); ++i) work(i);
        }
    });
}

class FieldBuilder {
  public:
    FieldBuilder(const FieldGrid& grid, const SolidSurface& surface, WorkerTeam& team)
        : grid_(grid), surface_(surface), team_(team) {}

    // Gives a brick to every place that has a point of the surface within the band.
    void find_bricks_near_surface() {
        has_brick_.assign(grid_.count(), 0);
        for_all(team_, surface_.triangles().size(), 1024, [&](std::size_t t) { mark_places_near(t); });
    }

    // Distances at the corners of all places. Places without a triangle, but with corners inside and outside, are those
    // in the middle of a hole. They get a brick too, so that the sign changes within a cell.
    void sample_corners() {
        const Counts rows{1, grid_.places[1] + 1, grid_.places[2] + 1};
        corners_.resize(std::size_t{grid_.places[0] + 1} * rows[1] * rows[2]);
        for_all(team_, std::size_t{rows[1]} * rows[2], 1, [&](std::size_t row) {
            const auto y = static_cast<std::uint32_t>(row % rows[1]), z = static_cast<std::uint32_t>(row / rows[1]);
            SignedDistanceWalk walk(surface_,
                                    surface_.winding_gradient_bound({}, std::numeric_limits<double>::infinity()));
            for (std::uint32_t x = 0; x <= grid_.places[0]; ++x) {
                const Vec3 p = Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} * float{side};
                corners_[grid_.corner(x, y, z)] = static_cast<float>(walk.distance_at(p));
            }
        });
        for (std::uint32_t place = 0; place < grid_.count(); ++place) {
            const auto distances = corners_of(place);
            const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
            if (*least < 0 && *most > 0) has_brick_[place] = 1;
        }
    }

    std::uint32_t number_bricks() {
        bricks_.clear();
        for (std::uint32_t place = 0; place < grid_.count(); ++place) {
            if (has_brick_[place]) bricks_.push_back(place);
        }
        return static_cast<std::uint32_t>(bricks_.size());
    }

    std::size_t bytes() const { return (first_brick_block() + blocks_per_brick * bricks_.size()) * bytes_per_block; }

    // Distances at the corners of all cells of the bricks, lowered so that the field covers the surface.
    void sample_bricks() {
        nodes_.resize(bricks_.size());
        const std::vector<std::uint32_t> brick_of = brick_of_places();
        for_all(team_, bricks_.size(), 1, [&](std::size_t b) { sample_brick(bricks_[b], brick_of, nodes_[b]); });
        for_all(team_, bricks_.size(), 16, [&](std::size_t b) { copy_shared_nodes(b, brick_of); });
        cover_surface(grid_, surface_, brick_of, nodes_);
        for_all(team_, bricks_.size(), 16, [&](std::size_t b) { copy_shared_nodes(b, brick_of); });
    }

    // Gives a brick to every place that is less than a cell away from where the field is zero. Near triangles all such
    // places have one. In a hole, the surface that closes it may come close to others. Returns whether there were any.
    bool find_bricks_near_zero() {
        bool found = false;
        for_each_zero_cell([&](Counts cell) {
            Counts first, last;
            for (std::size_t k = 0; k < 3; ++k) {
                first[k] = (std::max(cell[k], 1u) - 1) / side;
                last[k] = std::min((cell[k] + 1) / side, grid_.places[k] - 1);
            }
            for (std::uint32_t z = first[2]; z <= last[2]; ++z) {
                for (std::uint32_t y = first[1]; y <= last[1]; ++y) {
                    for (std::uint32_t x = first[0]; x <= last[0]; ++x) {
                        std::uint8_t& mark = has_brick_[grid_.number(x, y, z)];
                        found = found || !mark;
                        mark = 1;
                    }
                }
            }
        });
        return found;
    }

    bool has_inside() const {
        return std::any_of(corners_.begin(), corners_.end(),
                           [&](float distance) { return to_short(double{distance}, coarse_unit()) < 0; }) ||
               std::any_of(nodes_.begin(), nodes_.end(), [](const BrickNodes& nodes) {
                   return std::any_of(nodes.begin(), nodes.end(), [](std::int16_t n) { return n < 0; });
               });
    }

    // The greatest slope in a cell that is not inside as a whole. Its gradient changes linearly along each axis, so it
    // is longest at a corner.
    double steepness() const {
        std::int64_t most = 0;  // squared, in units of fine values
        for (const BrickNodes& nodes : nodes_) {
            for (std::uint32_t cell = 0; cell < blocks_per_brick; ++cell) {
                const auto n = cell_nodes(nodes, cell);
                if (*std::max_element(n.begin(), n.end()) <= 0) continue;
                for (std::uint32_t k = 0; k < 8; ++k) {
                    std::int64_t squared = 0;
                    for (const std::uint32_t axis : {1u, 2u, 4u}) {
                        const std::int64_t difference = n[k | axis] - n[k & ~axis];
                        squared += difference * difference;
                    }
                    most = std::max(most, squared);
                }
            }
        }
        // More than 1 even if all cells are exact: the solid need not be convex.
        return std::max(1.0001, 1.0001 * fine_unit * std::sqrt(double(most)));  // the kernel rounds
    }

    void write(AlignedVector<float>& words) const {
        words.assign(bytes() / sizeof(float), 0);
        const auto number = [](auto n) { return static_cast<float>(n); };
        const float header[] = {grid_.origin.x,           grid_.origin.y,
                                grid_.origin.z,           number(1 / double{grid_.cell}),
                                number(grid_.places[0]),  number(grid_.places[1]),
                                number(grid_.places[2]),  grid_.cell,
                                number(first_table_word), number(first_coarse_block()),
                                number(fine_unit),        number(coarse_unit())};
        std::copy(std::begin(header), std::end(header), words.begin());
        for (std::size_t b = 0; b < bricks_.size(); ++b) {
            words[first_table_word + bricks_[b]] = number(first_brick_block() + blocks_per_brick * b);
        }
        const CellDistance zero_cells(boxes_of_zero_cells());
        for_all(team_, grid_.count(), 16, [&](std::size_t place) {
            write_coarse_block(static_cast<std::uint32_t>(place), zero_cells,
                               &words[words_per_block * (first_coarse_block() + place)]);
        });
        for_all(team_, bricks_.size(), 16, [&](std::size_t b) {
            write_brick(nodes_[b], &words[words_per_block * (first_brick_block() + blocks_per_brick * b)]);
        });
    }

    // One sample of the surface per cell.
    std::vector<SurfaceSample> samples() const {
        const std::vector<std::uint32_t> brick_of = brick_of_places();
        std::vector<bool> taken(bricks_.size() * blocks_per_brick, false);
        return sample_surface(surface_, [&](Vec3 p) {
            const auto x = static_cast<std::uint32_t>(p.x), y = static_cast<std::uint32_t>(p.y),
                       z = static_cast<std::uint32_t>(p.z);
            const std::size_t brick = brick_of[grid_.number(x / side, y / side, z / side)];
            const std::size_t cell = brick * blocks_per_brick + x % side + side * (y % side + side * (z % side));
            const bool first = !taken[cell];
            taken[cell] = true;
            return first;
        });
    }

  private:
    static constexpr std::uint32_t first_table_word = header_blocks * words_per_block;
    std::size_t first_coarse_block() const {
        return header_blocks + (grid_.count() + words_per_block - 1) / words_per_block;
    }
    std::size_t first_brick_block() const { return first_coarse_block() + grid_.count(); }

    std::vector<std::uint32_t> brick_of_places() const {
        std::vector<std::uint32_t> brick_of(grid_.count(), none);
        for (std::uint32_t b = 0; b < bricks_.size(); ++b) brick_of[bricks_[b]] = b;
        return brick_of;
    }

    void mark_places_near(std::size_t t) {
        std::array<Vec3, 3> corners;
        Bounds bounds;
        for (std::size_t k = 0; k < 3; ++k)
            bounds.include(corners[k] = surface_.positions()[surface_.triangles()[t][k]]);
        const auto band = static_cast<float>(fine_band);
        const auto first = [&](float x) { return static_cast<std::uint32_t>(std::max(0.0f, (x - band) / side)); };
        const auto last = [&](float x, std::size_t k) {
            return std::min(static_cast<std::uint32_t>((x + band) / side), grid_.places[k] - 1);
        };
        for (std::uint32_t z = first(bounds.min.z); z <= last(bounds.max.z, 2); ++z) {
            for (std::uint32_t y = first(bounds.min.y); y <= last(bounds.max.y, 1); ++y) {
                for (std::uint32_t x = first(bounds.min.x); x <= last(bounds.max.x, 0); ++x) {
                    const std::atomic_ref<std::uint8_t> mark(has_brick_[grid_.number(x, y, z)]);
                    if (mark.load(std::memory_order_relaxed)) continue;
                    const Vec3 center =
                        Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} * float{side} +
                        Vec3{0.5f, 0.5f, 0.5f} * float{side};
                    if (may_meet_cube({corners[0] - center, corners[1] - center, corners[2] - center},
                                      0.5f * side + band)) {
                        mark.store(1, std::memory_order_relaxed);
                    }
                }
            }
        }
    }

    std::array<float, 8> corners_of(std::uint32_t place) const {
        const auto [x, y, z] = grid_.at(place);
        std::array<float, 8> distances;
        for (std::uint32_t k = 0; k < 8; ++k) {
            distances[k] = corners_[grid_.corner(x + k % 2, y + k / 2 % 2, z + k / 4)];
        }
        return distances;
    }

    double coarse_unit() const {
        double diagonal2 = 0;
        for (const std::uint32_t n : grid_.places) diagonal2 += double(side * n) * double(side * n);
        return std::sqrt(diagonal2) / largest_short;
    }

    static void store_shorts(const std::array<std::int16_t, 8>& shorts, float* block) {
        const auto words = std::bit_cast<std::array<float, 4>>(shorts);
        std::copy(words.begin(), words.end(), block);
    }
    // Outside, the values of places without a brick do not exceed the distance to the surface. So a point that moves by
    // its value does not pass through the surface.
    void write_coarse_block(std::uint32_t place, const CellDistance& zero_cells, float* block) const {
        const double unit = coarse_unit();
        std::array<float, 8> distances = corners_of(place);
        if (!has_brick_[place] && *std::min_element(distances.begin(), distances.end()) > 0) {
            const Counts at = grid_.at(place);
            const Vec3 low{static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])};
            distances = lower_to_free_way(zero_cells, low * float{side}, side, distances, unit);
        }
        std::array<std::int16_t, 8> shorts;
        for (std::size_t k = 0; k < 8; ++k) shorts[k] = to_short(double{distances[k]}, unit);
        store_shorts(shorts, block);
    }

    // The brick of `place` or of the next ones, as far as the node is on the side between them; none if there is none.
    std::uint32_t owner(std::uint32_t place, std::span<const std::uint32_t> brick_of, std::uint32_t x, std::uint32_t y,
                        std::uint32_t z) const {
        auto [px, py, pz] = grid_.at(place);
        px += x / side, py += y / side, pz += z / side;
        const bool in_grid = px < grid_.places[0] && py < grid_.places[1] && pz < grid_.places[2];
        return in_grid ? brick_of[grid_.number(px, py, pz)] : none;
    }

    // All nodes but those of other bricks.
    void sample_brick(std::uint32_t place, std::span<const std::uint32_t> brick_of, BrickNodes& nodes) const {
        const auto [px, py, pz] = grid_.at(place);
        const Vec3 low = Vec3{static_cast<float>(px), static_cast<float>(py), static_cast<float>(pz)} * float{side};
        constexpr float half = 0.5f * side;
        SignedDistanceWalk walk(surface_, surface_.winding_gradient_bound(low + Vec3{half, half, half}, 1.7321 * half));
        // There and back, so that the next node is always a neighbor.
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            const std::uint32_t row = i / nodes_side, z = row / nodes_side;
            const std::uint32_t y = z % 2 ? side - row % nodes_side : row % nodes_side;
            const std::uint32_t x = row % 2 ? side - i % nodes_side : i % nodes_side;
            const bool shared = x == side || y == side || z == side;
            if (shared && owner(place, brick_of, x, y, z) != none) continue;
            const double distance =
                walk.distance_at(low + Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
            nodes[node(x, y, z)] = to_short(distance, fine_unit);
        }
    }

    // Reads only nodes that sample_brick() has written.
    void copy_shared_nodes(std::size_t brick, std::span<const std::uint32_t> brick_of) {
        for (std::uint32_t z = 0; z < nodes_side; ++z) {
            for (std::uint32_t y = 0; y < nodes_side; ++y) {
                for (std::uint32_t x = z == side || y == side ? 0 : side; x < nodes_side; ++x) {
                    const std::uint32_t other = owner(bricks_[brick], brick_of, x, y, z);
                    if (other == none) continue;
                    nodes_[brick][node(x, y, z)] = nodes_[other][node(x % side, y % side, z % side)];
                }
            }
        }
    }

    static void write_brick(const BrickNodes& nodes, float* blocks) {
        for (std::uint32_t cell = 0; cell < blocks_per_brick; ++cell) {
            store_shorts(cell_nodes(nodes, cell), blocks + words_per_block * cell);
        }
    }

    static std::array<std::int16_t, 8> cell_nodes(const BrickNodes& nodes, std::uint32_t cell) {
        const std::uint32_t x = cell % side, y = cell / side % side, z = cell / side / side;
        std::array<std::int16_t, 8> values;
        for (std::uint32_t k = 0; k < 8; ++k) values[k] = nodes[node(x + k % 2, y + k / 2 % 2, z + k / 4)];
        return values;
    }

    // Calls visit(cell) for cells of bricks in which the field may be zero, next to points outside. In cells from the
    // grid's corner.
    template <class Visit>
    void for_each_zero_cell(Visit&& visit) const {
        for (std::size_t b = 0; b < bricks_.size(); ++b) {
            const auto [px, py, pz] = grid_.at(bricks_[b]);
            for (std::uint32_t cell = 0; cell < blocks_per_brick; ++cell) {
                const auto values = cell_nodes(nodes_[b], cell);
                const auto [least, most] = std::minmax_element(values.begin(), values.end());
                if (*least > 0 || *most <= 0) continue;
                visit(Counts{side * px + cell % side, side * py + cell / side % side, side * pz + cell / side / side});
            }
        }
    }

    // Neighbors along x share a box.
    std::vector<Bounds> boxes_of_zero_cells() const {
        std::vector<Bounds> boxes;
        for_each_zero_cell([&](Counts cell) {
            const Vec3 low{static_cast<float>(cell[0]), static_cast<float>(cell[1]), static_cast<float>(cell[2])};
            if (!boxes.empty() && boxes.back().max == low + Vec3{0, 1, 1}) {
                boxes.back().max.x += 1;
            } else {
                boxes.push_back({low, low + Vec3{1, 1, 1}});
            }
        });
        return boxes;
    }

    const FieldGrid& grid_;
    const SolidSurface& surface_;
    WorkerTeam& team_;
    std::vector<std::uint8_t> has_brick_;
    std::vector<float> corners_;         // distances in cells, see FieldGrid::corner
    std::vector<std::uint32_t> bricks_;  // their places, ascending
    std::vector<BrickNodes> nodes_;      // of each brick
};

std::optional<Error> memory_problem(std::size_t needed, const DistanceFieldOptions& options) {
    const std::size_t allowed = std::min(options.largest_bytes, largest_distance_field);
    if (needed <= allowed) return std::nullopt;
    // Most of the memory is for bricks, whose number grows with the square of the cells.
    const double cells = 0.95 * options.cells * std::sqrt(double(allowed) / double(needed));
    const auto megabytes = [](std::size_t bytes) { return text_of(double(bytes) / (1 << 20)) + " MiB"; };
    std::string what = "the distance field of " + std::to_string(options.cells) + " cells needs " + megabytes(needed) +
                       ", but " + megabytes(allowed) + " are allowed; use at most about " +
                       std::to_string(static_cast<int>(std::max(cells, 1.0))) + " cells";
    if (options.largest_bytes < largest_distance_field) what += ", or allow more memory";
    return Error{"", what};
}

}  // namespace

Result<DistanceField> build_distance_field(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                           const DistanceFieldOptions& options) {
    if (auto problem = problem_of(positions, triangles, options)) return *problem;
    OrientedTriangles oriented = orient_triangles(positions, triangles);
    if (oriented.triangles.empty()) return Error{"", "no triangle of the mesh has an area"};

    DistanceField field;
    field.zero_area = oriented.zero_area;
    field.flipped = oriented.flipped;
    field.closed = oriented.boundary.empty();
    for (const Triangle& t : oriented.triangles) {
        for (const std::uint32_t corner : t) field.data.bounds.include(positions[corner]);
    }
    auto grid = make_grid_around(field.data.bounds, options.cells);
    if (!grid) return grid.errors();
    field.cell = grid->cell;
    field.places = grid->places;

    const unsigned threads = options.threads ? options.threads : std::max(1u, std::thread::hardware_concurrency());
    WorkerTeam team(threads - 1);
    std::vector<Vec3> in_cells(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) in_cells[v] = grid->to_cells(positions[v]);
    const SolidSurface surface(std::move(in_cells), std::move(oriented), team);

    FieldBuilder builder(*grid, surface, team);
    builder.find_bricks_near_surface();
    builder.number_bricks();
    if (auto problem = memory_problem(builder.bytes(), options)) return *problem;
    builder.sample_corners();
    do {
        field.bricks = builder.number_bricks();
        if (auto problem = memory_problem(builder.bytes(), options)) return *problem;
        builder.sample_bricks();
    } while (builder.find_bricks_near_zero());
    builder.write(field.data.words);
    field.data.steepness = static_cast<float>(builder.steepness());
    field.data.width = field_width(field.cell);
    field.is_sheet = surface.is_sheet();
    field.has_inside = builder.has_inside();

    field.thin = find_thin_parts(surface, builder.samples(), team);
    if (field.thin.thin > 0) field.thin.place = grid->to_meters(field.thin.place);
    field.thin.least_thickness *= grid->cell;
    return field;
}

}  // namespace weft
