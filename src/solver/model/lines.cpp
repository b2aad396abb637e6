#include "solver/model/lines.h"

#include "mesh/paths.h"
#include "physics/change_rows.h"
#include "physics/stretch/stretch.data.h"

#include <weft/bounds.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

namespace weft {
namespace {

// No stiffness on either side.
constexpr float inert[] = {0, -1, -1, WEFT_NEVER_STRAIGHT};

struct Lines {
    Paths paths;
    std::vector<std::vector<std::uint32_t>> colors;  // paths, longest first
    std::vector<std::uint32_t> overflow;             // constraints, ascending
};

// Directions of the lines, in a projection of the mesh along its thinnest axis.
class Directions {
  public:
    Directions(const RowList& rows, const Paths& paths, std::span<const Vec3> positions)
        : rows_(rows), paths_(paths), positions_(positions) {
        const Vec3 size = bounds_of(positions).size();
        const std::array<float, 3> extents = {size.x, size.y, size.z};
        thinnest_ = static_cast<std::size_t>(std::ranges::min_element(extents) - extents.begin());
        std::uint32_t longest = 0;
        for (std::uint32_t path = 1; path < paths.size(); ++path)
            if (paths.length(path) > paths.length(longest)) longest = path;
        if (paths.size() > 0) reference_ = angle(longest);
    }

    /// Index 0…3 of the direction, in steps of 45°; 0 is the direction of the longest line. Parallel lines have the
    /// same index.
    std::uint32_t family(std::uint32_t path) const {
        const double eighths = (angle(path) - reference_) * 4 / std::numbers::pi;
        return static_cast<std::uint32_t>(static_cast<int>(std::floor(eighths + 0.5)) & 3);
    }

  private:
    double angle(std::uint32_t path) const {
        const auto end = [&](std::uint32_t i, bool second) {
            return positions_[rows_.particles[2 * std::size_t{paths_.links[i]} + second]];
        };
        const std::uint32_t first = paths_.offsets[path], last = paths_.offsets[path + 1] - 1;
        const Vec3 d = end(last, !paths_.turned[last]) - end(first, paths_.turned[first]);
        const std::array<float, 3> along = {d.x, d.y, d.z};
        return std::atan2(static_cast<double>(along[(thinnest_ + 2) % 3]),
                          static_cast<double>(along[(thinnest_ + 1) % 3]));
    }

    const RowList& rows_;
    const Paths& paths_;
    std::span<const Vec3> positions_;
    std::size_t thinnest_ = 0;
    double reference_ = 0;
};

// Greedy coloring of lines. Parallel lines do not cross, so each direction gets its own color. On a grid nearly all
// constraints fit into these colors, and each thread works on the same region in every color. The remaining lines take
// any color that is free, longest first, so that mostly single constraints remain, and many of them fit into a block.
class LineColoring {
  public:
    LineColoring(const RowList& rows, Paths paths, std::uint32_t particle_count, const ColoringOptions& options)
        : rows_(rows), pool_(particle_count, options.max_colors) {
        lines_.paths = std::move(paths);
        lines_.colors.resize(ColorPool::size);
    }

    void run(const Directions& directions) {
        const Paths& paths = lines_.paths;
        std::vector<std::uint32_t> order(paths.size());
        for (std::uint32_t path = 0; path < order.size(); ++path) order[path] = path;
        std::ranges::stable_sort(order, std::ranges::greater(), [&](std::uint32_t path) { return paths.length(path); });
        std::vector<std::uint32_t> rest;
        for (const std::uint32_t path : order) {
            if (!color(path, std::uint64_t{1} << directions.family(path))) rest.push_back(path);
        }
        for (const std::uint32_t path : rest) {
            if (!color(path, ~std::uint64_t{0})) overflow(path);
        }
    }

    Lines take(std::uint32_t min_rows) {
        for (auto& color : lines_.colors) {
            std::size_t row_count = 0;
            for (const std::uint32_t path : color) row_count += lines_.paths.length(path);
            if (row_count >= min_rows) continue;
            for (const std::uint32_t path : color) overflow(path);
            color.clear();
        }
        std::ranges::sort(lines_.overflow);
        return std::move(lines_);
    }

  private:
    std::span<const std::uint32_t> links(std::uint32_t path) const {
        return std::span(lines_.paths.links).subspan(lines_.paths.offsets[path], lines_.paths.length(path));
    }
    bool color(std::uint32_t path, std::uint64_t allowed) {
        particles_.clear();
        for (const std::uint32_t row : links(path)) {
            const auto ends = std::span(rows_.particles).subspan(2 * std::size_t{row}, 2);
            particles_.insert(particles_.end(), ends.begin(), ends.end());
        }
        const std::uint32_t color = pool_.take(particles_, allowed);
        if (color == ColorPool::size) return false;
        lines_.colors[color].push_back(path);
        return true;
    }
    void overflow(std::uint32_t path) {
        lines_.overflow.insert(lines_.overflow.end(), links(path).begin(), links(path).end());
    }

    const RowList& rows_;
    ColorPool pool_;
    Lines lines_;
    std::vector<std::uint32_t> particles_;
};

// Rounds up a length, so that lines of one class differ in length by at most an eighth and can share a block.
std::uint32_t length_class(std::uint32_t length) {
    const auto steps = static_cast<std::uint32_t>(std::bit_width(length - 1));
    const std::uint32_t width = steps > 4 ? 1u << (steps - 4) : 1;
    return (length + width - 1) / width * width;
}

// Sorts lines into blocks of similar length, and lines and blocks by position. Each thread takes a range of blocks, so
// from color to color it works mostly on the same particles.
void sort_by_place(const RowList& rows, Lines& lines) {
    const Paths& paths = lines.paths;
    const auto place = [&](std::uint32_t path) {
        const std::size_t first = paths.links[paths.offsets[path]], last = paths.links[paths.offsets[path + 1] - 1];
        return std::uint64_t{rows.particles[2 * first]} + rows.particles[2 * last];
    };
    struct Block {
        std::uint64_t place;
        std::span<const std::uint32_t> paths;
    };
    for (auto& color : lines.colors) {
        std::ranges::sort(color, {}, [&](std::uint32_t path) {
            return std::tuple(~length_class(paths.length(path)), place(path), path);
        });
        std::vector<Block> blocks;
        for (std::size_t i = 0; i < color.size(); i += lane_padding) {
            const auto some = std::span(color).subspan(i, std::min<std::size_t>(lane_padding, color.size() - i));
            blocks.push_back({place(some[some.size() / 2]), some});
        }
        // The last block may have fewer lines, so it stays last.
        if (blocks.size() > 1) std::ranges::stable_sort(blocks.begin(), blocks.end() - 1, {}, &Block::place);
        std::vector<std::uint32_t> sorted;
        for (const Block& block : blocks) sorted.insert(sorted.end(), block.paths.begin(), block.paths.end());
        color = std::move(sorted);
    }
}

// Computes batches, blocks and the length of the table.
void lay_out(const Lines& lines, ConstraintTable& table) {
    const auto block_of = [&](std::span<const std::uint32_t> paths) {
        const auto lanes = paths.first(std::min<std::size_t>(lane_padding, paths.size()));
        std::uint32_t longest = 0;
        for (const std::uint32_t path : lanes) longest = std::max(longest, lines.paths.length(path));
        return LineBlock{table.stride, longest};
    };
    for (const auto& color : lines.colors) {
        if (color.empty()) continue;
        Batch batch{.begin = table.stride, .first_block = static_cast<std::uint32_t>(table.blocks.size())};
        for (std::size_t i = 0; i < color.size(); i += lane_padding) {
            table.blocks.push_back(block_of(std::span(color).subspan(i)));
            table.stride = table.blocks.back().end();
        }
        batch.rows = table.stride - batch.begin;
        batch.blocks = static_cast<std::uint32_t>(table.blocks.size()) - batch.first_block;
        table.batches.push_back(batch);
    }
    if (lines.overflow.empty()) return;
    table.batches.push_back({table.stride, static_cast<std::uint32_t>(lines.overflow.size()), true});
    table.stride = table.batches.back().padded_end();
}

class LineWriter {
  public:
    LineWriter(const RowList& rows, std::uint32_t particle_count, std::uint32_t stride)
        : rows_(rows),
          particle_count_(particle_count),
          stride_(stride),
          particles_(rows.arity * stride_),
          fields_(rows.field_count * stride_),
          geometry_(rows.geometry_count * stride_, no_area) {}

    void write_row(std::uint32_t at, std::uint32_t row, bool turned) {
        const std::uint32_t* ends = &rows_.particles[2 * std::size_t{row}];
        place(at, ends[turned], ends[!turned],
              std::span(rows_.fields).subspan(std::size_t{rows_.field_count} * row, rows_.field_count));
        for (std::uint32_t number = 0; number < rows_.geometry_count; ++number)
            geometry_[number * stride_ + at] = rows_.geometry[std::size_t{rows_.geometry_count} * row + number];
    }
    void write_line(std::uint32_t at, const Paths& paths, std::uint32_t path, std::uint32_t length) {
        std::uint32_t k = 0, end = dummy(first_dummy(particle_count_), 0, at);
        for (std::uint32_t i = paths.offsets[path]; i < paths.offsets[path + 1]; ++i, ++k) {
            write_row(at + k * lane_padding, paths.links[i], paths.turned[i]);
            end = particles_[stride_ + at + k * lane_padding];
        }
        write_padding(at, k, length, end);
    }
    // Padding uses the line's last particle twice, so that it is accessed only by the lane, and thread, of the line.
    void write_padding(std::uint32_t at, std::uint32_t from, std::uint32_t length, std::uint32_t end) {
        for (std::uint32_t k = from; k < length; ++k) place(at + k * lane_padding, end, end, inert);
    }
    void move_to(ConstraintTable& table) {
        table.particles = std::move(particles_);
        table.fields = std::move(fields_);
        table.geometry = std::move(geometry_);
    }

  private:
    void place(std::uint32_t at, std::uint32_t first, std::uint32_t second, std::span<const float> fields) {
        assert(fields.size() == rows_.field_count);
        particles_[at] = first;
        particles_[stride_ + at] = second;
        for (std::uint32_t field = 0; field < rows_.field_count; ++field) fields_[field * stride_ + at] = fields[field];
    }

    const RowList& rows_;
    std::uint32_t particle_count_;
    std::size_t stride_;
    AlignedVector<std::uint32_t> particles_;
    AlignedVector<float> fields_, geometry_;
};

}  // namespace

ConstraintTable pack_lines(const RowList& stretch, std::span<const Vec3> positions, std::uint32_t particle_count,
                           const ColoringOptions& options) {
    Paths paths = find_paths(stretch.particles, positions, longest_line);
    const Directions directions(stretch, paths, positions);
    LineColoring coloring(stretch, paths, particle_count, options);
    coloring.run(directions);
    Lines lines = coloring.take(options.min_rows);
    sort_by_place(stretch, lines);
    ConstraintTable table{.kind = ConstraintKind::stretch,
                          .arity = stretch.arity,
                          .field_count = stretch.field_count,
                          .rows = stretch.size(),
                          .stride = 0,
                          .particles = {},
                          .fields = {},
                          .first_dummy = first_dummy(particle_count),
                          .batches = {},
                          .blocks = {}};
    lay_out(lines, table);
    table.left_out = std::vector<float>(stretch.left_out);

    LineWriter writer(stretch, particle_count, table.stride);
    std::size_t block = 0;
    for (const auto& color : lines.colors) {
        for (std::size_t i = 0; i < color.size(); i += lane_padding, ++block) {
            const std::uint32_t begin = table.blocks[block].begin, length = table.blocks[block].length;
            for (std::uint32_t lane = 0; lane < lane_padding; ++lane) {
                if (i + lane < color.size()) {
                    writer.write_line(begin + lane, lines.paths, color[i + lane], length);
                } else {
                    writer.write_padding(begin + lane, 0, length, dummy(first_dummy(particle_count), 0, lane));
                }
            }
        }
    }
    if (!lines.overflow.empty()) {
        const Batch& batch = table.batches.back();
        for (std::uint32_t i = 0; i < padded(batch.rows); ++i) {
            if (i < batch.rows) {
                writer.write_row(batch.begin + i, lines.overflow[i], false);
            } else {
                writer.write_padding(batch.begin + i, 0, 1, dummy(first_dummy(particle_count), 0, i));
            }
        }
    }
    writer.move_to(table);
    return table;
}

}  // namespace weft
