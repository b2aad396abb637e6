#include "vulkan/measures/measure.h"

#include "vulkan/cloth_state.h"
#include "vulkan/measures/args.data.h"
#include "vulkan/primitives/recorder.h"

#include <bit>
#include <cmath>
#include <vector>

namespace weft::vulkan {
namespace {

constexpr std::uint64_t words_of_edge = 4, words_of_tile = 2;
constexpr std::uint64_t word_bytes = sizeof(std::uint32_t);

// A double as the sum of two floats.
struct TwoFloats {
    explicit TwoFloats(double value) : high(static_cast<float>(value)), low(static_cast<float>(value - high)) {}
    float high, low;
};

void add_edge(const ClothModel& model, const EdgeEnds& ends, std::vector<std::uint32_t>& list) {
    const auto [a, b] = ends;
    const double rest = distance(model.rest_position(a), model.rest_position(b));
    if (rest <= 0) return;
    const TwoFloats square(rest * rest);
    list.insert(list.end(),
                {a, b, std::bit_cast<std::uint32_t>(square.high), std::bit_cast<std::uint32_t>(square.low)});
}

// One reduction over tiles.
struct Part {
    std::uint32_t count = 0;
    std::uint64_t first_tile = 0;
    std::uint64_t end() const { return first_tile + tiles_of(count); }
};

struct Found {
    double sum = 0, largest = 0;
};

// There are few tiles, so the host adds them up, in double.
Found sum_up(const Part& part, std::span<const std::uint32_t> words) {
    Found found;
    for (std::uint64_t tile = part.first_tile; tile < part.end(); ++tile) {
        found.sum += std::bit_cast<float>(words[words_of_tile * tile]);
        found.largest = larger(found.largest, std::bit_cast<float>(words[words_of_tile * tile + 1]));
    }
    return found;
}

class Measuring {
  public:
    Measuring(const ClothState& cloth, const MeasureLists& lists) : cloth_(cloth), lists_(lists) {
        const ConstraintTable& table = model().table(ConstraintKind::stretch);
        particles_ = {.count = model().particle_count, .first_tile = 0};
        stretch_ = {.count = lists.stretch_edges, .first_tile = particles_.end()};
        shear_ = {.count = lists.shear_edges, .first_tile = stretch_.end()};
        rows_ = {.count = table.stride, .first_tile = shear_.end()};
    }

    std::uint64_t bytes() const { return rows_.end() * words_of_tile * word_bytes; }

    void record(Recorder& passes, std::uint64_t found) const {
        const auto place = [&](const Part& part) { return found + part.first_tile * words_of_tile * word_bytes; };
        const std::uint64_t position = cloth_.address(PointArray::position);
        passes.run("measure_particles",
                   MeasureParticlesArgs{.position = position,
                                        .velocity = cloth_.address(PointArray::velocity),
                                        .masses = lists_.arena.address(lists_.masses),
                                        .found = place(particles_),
                                        .count = particles_.count,
                                        .unused = 0},
                   tiles_of(particles_.count));
        for (const auto& [part, edges] : {std::pair(stretch_, lists_.stretch), std::pair(shear_, lists_.shear)}) {
            if (part.count == 0) continue;
            passes.run("measure_edges",
                       MeasureEdgesArgs{.position = position,
                                        .edges = lists_.arena.address(edges),
                                        .found = place(part),
                                        .count = part.count,
                                        .unused = 0},
                       tiles_of(part.count));
        }
        if (rows_.count > 0) passes.run("measure_rows", rows(place(rows_)), tiles_of(rows_.count));
    }

    MeasureSums sums(std::span<const std::uint32_t> words) const {
        const Found particles = sum_up(particles_, words), stretch = sum_up(stretch_, words),
                    shear = sum_up(shear_, words), rows = sum_up(rows_, words);
        MeasureSums sums;
        sums.kinetic_energy = particles.sum;
        sums.max_speed2 = particles.largest;
        sums.stretch.add(stretch.sum, stretch_.count, stretch.largest);
        sums.shear.add(shear.sum, shear_.count, shear.largest);
        sums.residual.add(rows.sum, model().table(ConstraintKind::stretch).rows, rows.largest);
        for (const Found& one : {particles, stretch, shear, rows})
            sums.finite = sums.finite && std::isfinite(one.sum) && std::isfinite(one.largest);
        return sums;
    }

  private:
    const ClothModel& model() const { return cloth_.model(); }

    MeasureRowsArgs rows(std::uint64_t found) const {
        const ConstraintTable& table = model().table(ConstraintKind::stretch);
        const TableBuffers& buffers = cloth_.buffers().tables[static_cast<std::uint32_t>(ConstraintKind::stretch)];
        const double h = cloth_.substep_seconds;
        const TwoFloats inv_h2(h > 0 ? 1 / (h * h) : 0);
        return {.position = cloth_.address(PointArray::position),
                .particles = cloth_.buffers().address(buffers.particles),
                .fields = cloth_.buffers().address(buffers.fields),
                .lambda = cloth_.address(cloth_.kept),
                .found = found,
                .inv_h2 = inv_h2.high,
                .inv_h2_low = inv_h2.low,
                .stride = table.stride,
                .count = table.stride,
                .first_dummy = table.first_dummy,
                .unused = 0};
    }

    const ClothState& cloth_;
    const MeasureLists& lists_;
    Part particles_, stretch_, shear_, rows_;
};

}  // namespace

Result<std::unique_ptr<const MeasureLists>> MeasureLists::create(gpu::Device& device, const ClothModel& model) {
    auto lists = std::make_unique<MeasureLists>();
    std::vector<std::uint32_t> stretch, shear;
    const EdgesByDirection edges = edges_by_direction(model);
    for (const EdgeEnds& edge : edges.axial) add_edge(model, edge, stretch);
    for (const EdgeEnds& edge : edges.others) add_edge(model, edge, shear);
    lists->stretch_edges = static_cast<std::uint32_t>(stretch.size() / words_of_edge);
    lists->shear_edges = static_cast<std::uint32_t>(shear.size() / words_of_edge);
    lists->masses = lists->arena.add_array(model.mass);
    lists->stretch = lists->arena.add_array(stretch);
    lists->shear = lists->arena.add_array(shear);
    if (auto built = lists->arena.build(device, "measures of " + model.name); !built) return built.errors();
    return std::unique_ptr<const MeasureLists>(std::move(lists));
}

Result<std::optional<MeasureSums>> measure(gpu::Device& device, Programs& programs, const ClothState& cloth) {
    const auto lists = cloth.buffers().measure_lists(device);
    if (!lists) return lists.errors();
    const Measuring measuring(cloth, **lists);
    auto found = device.memory().buffer(measuring.bytes(), gpu::MemoryKind::readback, "measures");
    if (!found) return found.errors();
    Result<void> recorded;
    auto done = gpu::run_once(device, [&](gpu::Commands& commands) {
        Recorder passes(device, programs, commands);
        measuring.record(passes, found->address());
        commands.host_barrier();
        recorded = passes.end();
    });
    if (!recorded) return recorded.errors();
    if (!done) return done.errors();
    const MeasureSums sums = measuring.sums(found->as<std::uint32_t>());
    return sums.finite ? std::optional(sums) : std::nullopt;
}

}  // namespace weft::vulkan
