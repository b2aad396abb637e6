#include "solver/lines.h"

#include "mesh/paths.h"

#include <algorithm>
#include <array>

namespace weft {
namespace {

// No stiffness on either side.
constexpr std::array<float, 3> inert = {0, -1, -1};

struct Lines {
    Paths paths;
    std::vector<std::vector<std::uint32_t>> colors;  // paths, the longest first
    std::vector<std::uint32_t> overflow;             // rows, ascending
};

// Greedy, the longest first: what is left over then are single rows, of which many fit into a block.
Lines color_lines(const RowList& rows, Paths paths, std::uint32_t particle_count, const ColoringOptions& options) {
    Lines lines{.paths = std::move(paths), .colors = {}, .overflow = {}};
    std::vector<std::uint32_t> order(lines.paths.size());
    for (std::uint32_t path = 0; path < order.size(); ++path) order[path] = path;
    std::ranges::stable_sort(order, std::ranges::greater(),
                             [&](std::uint32_t path) { return lines.paths.length(path); });

    ColorPool pool(particle_count, options.max_colors);
    lines.colors.resize(ColorPool::size);
    std::array<std::uint32_t, ColorPool::size> row_count{};
    const auto for_each_row = [&](std::uint32_t path, auto&& f) {
        for (std::uint32_t i = lines.paths.offsets[path]; i < lines.paths.offsets[path + 1]; ++i)
            f(lines.paths.links[i]);
    };
    std::vector<std::uint32_t> particles;
    for (const std::uint32_t path : order) {
        particles.clear();
        for_each_row(path, [&](std::uint32_t row) {
            const auto ends = std::span(rows.particles).subspan(2 * std::size_t{row}, 2);
            particles.insert(particles.end(), ends.begin(), ends.end());
        });
        const std::uint32_t color = pool.take(particles);
        if (color == ColorPool::size) {
            for_each_row(path, [&](std::uint32_t row) { lines.overflow.push_back(row); });
            continue;
        }
        lines.colors[color].push_back(path);
        row_count[color] += lines.paths.length(path);
    }
    for (std::uint32_t color = 0; color < ColorPool::size; ++color) {
        if (row_count[color] >= options.min_rows) continue;
        for (const std::uint32_t path : lines.colors[color]) {
            for_each_row(path, [&](std::uint32_t row) { lines.overflow.push_back(row); });
        }
        lines.colors[color].clear();
    }
    std::ranges::sort(lines.overflow);
    return lines;
}

// Batches and blocks, and with them the length of the table.
void lay_out(const Lines& lines, ConstraintTable& table) {
    const auto block_of = [&](std::span<const std::uint32_t> paths) {
        return LineBlock{table.stride, lines.paths.length(paths.front())};
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
    LineWriter(const RowList& rows, std::uint32_t particle_count, ConstraintTable& table)
        : rows_(rows), particle_count_(particle_count), table_(table) {}

    void write_row(std::uint32_t at, std::uint32_t row, bool turned) {
        const std::uint32_t* ends = &rows_.particles[2 * std::size_t{row}];
        table_.source[at] = row;
        place(at, ends[turned], ends[!turned], &rows_.fields[std::size_t{table_.field_count} * row]);
    }
    void write_line(std::uint32_t at, const Paths& paths, std::uint32_t path, std::uint32_t length) {
        std::uint32_t k = 0, end = dummy(particle_count_, 0, at);
        for (std::uint32_t i = paths.offsets[path]; i < paths.offsets[path + 1]; ++i, ++k) {
            write_row(at + k * lane_padding, paths.links[i], paths.turned[i]);
            end = table_.particles[table_.stride + at + k * lane_padding];
        }
        write_padding(at, k, length, end);
    }
    // From the line's last particle to itself: what is beyond the end stays with the lane, and so with one thread.
    void write_padding(std::uint32_t at, std::uint32_t from, std::uint32_t length, std::uint32_t end) {
        for (std::uint32_t k = from; k < length; ++k) place(at + k * lane_padding, end, end, inert.data());
    }

  private:
    void place(std::uint32_t at, std::uint32_t first, std::uint32_t second, const float* fields) {
        table_.particles[at] = first;
        table_.particles[table_.stride + at] = second;
        for (std::uint32_t field = 0; field < table_.field_count; ++field) {
            table_.fields[std::size_t{field} * table_.stride + at] = fields[field];
        }
    }

    const RowList& rows_;
    std::uint32_t particle_count_;
    ConstraintTable& table_;
};

}  // namespace

ConstraintTable pack_lines(const RowList& stretch, std::span<const Vec3> positions, std::uint32_t particle_count,
                           const ColoringOptions& options) {
    const Lines lines =
        color_lines(stretch, find_paths(stretch.particles, positions, longest_line), particle_count, options);
    ConstraintTable table{.kind = ConstraintKind::stretch,
                          .arity = stretch.arity,
                          .field_count = stretch.field_count,
                          .rows = stretch.size(),
                          .stride = 0,
                          .particles = {},
                          .fields = {},
                          .source = {},
                          .batches = {},
                          .blocks = {}};
    lay_out(lines, table);
    table.particles.resize(std::size_t{table.arity} * table.stride);
    table.fields.resize(std::size_t{table.field_count} * table.stride);
    table.source.assign(table.stride, none);

    LineWriter writer(stretch, particle_count, table);
    std::size_t block = 0;
    for (const auto& color : lines.colors) {
        for (std::size_t i = 0; i < color.size(); i += lane_padding, ++block) {
            const auto [begin, length] = table.blocks[block];
            for (std::uint32_t lane = 0; lane < lane_padding; ++lane) {
                if (i + lane < color.size()) {
                    writer.write_line(begin + lane, lines.paths, color[i + lane], length);
                } else {
                    writer.write_padding(begin + lane, 0, length, dummy(particle_count, 0, lane));
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
                writer.write_padding(batch.begin + i, 0, 1, dummy(particle_count, 0, i));
            }
        }
    }
    return table;
}

}  // namespace weft
