#include "vulkan/topology/find_edges.h"

#include "vulkan/arena.h"
#include "vulkan/primitives/radix_sort.h"
#include "vulkan/primitives/scan.h"
#include "vulkan/topology/args.data.h"

#include <array>
#include <chrono>

namespace weft::vulkan {
namespace {

using gpu::Buffer;
using gpu::MemoryKind;

constexpr std::uint64_t word = sizeof(std::uint32_t);

// Shaders write these structs as words.
static_assert(sizeof(Triangle) == 3 * word && sizeof(Edge) == 4 * word && sizeof(Hinge) == 7 * word);

class EdgeBuilder {
  public:
    EdgeBuilder(gpu::Device& device, Programs& programs, std::span<const Triangle> triangles,
                std::uint32_t vertex_count)
        : device_(device),
          programs_(programs),
          triangles_(triangles),
          vertex_count_(vertex_count),
          triangle_count_(static_cast<std::uint32_t>(triangles.size())),
          sides_(3 * triangle_count_) {}

    Result<EdgesAndHinges> run() {
        if (auto made = make_arrays(); !made) return made.errors();
        auto sorted = run_passes(
            device_, programs_, [&](Recorder& passes) { sort_sides(passes); }, &device_ms);
        if (!sorted) return sorted.errors();
        if (auto counted = read_counts(); !counted) return counted.errors();
        if (auto made = make_lists(); !made) return made.errors();
        auto written = run_passes(
            device_, programs_, [&](Recorder& passes) { write_lists(passes); }, &device_ms);
        if (!written) return written.errors();
        return read_lists();
    }

    double device_ms = 0;

  private:
    // Bytes of an array of one word per side, plus one.
    std::uint64_t array_bytes() const { return (std::uint64_t{sides_} + 1) * word; }

    Result<void> make(Buffer& buffer, std::uint64_t bytes, const std::string& name) {
        auto made = device_.memory().buffer(bytes, MemoryKind::device, name);
        if (!made) return made.errors();
        buffer = std::move(*made);
        return {};
    }

    Result<void> make_arrays() {
        for (Buffer& one : arrays_)
            if (auto made = make(one, array_bytes(), "sides of triangles"); !made) return made;
        const SortScratch sizes = sort_scratch(sides_);
        if (auto made = make(places_, sizes.places, "places of digits"); !made) return made;
        const std::uint64_t sums = std::max(sizes.sums, scan_scratch(sides_ + 1));
        if (auto made = make(sums_, sums, "sums of tiles"); !made) return made;
        if (auto made = make(indices_, triangles_.size_bytes(), "triangles"); !made) return made;
        return upload(device_, indices_, 0, std::as_bytes(triangles_));
    }

    KeyArrays addresses(std::uint32_t first) const {
        return {arrays_[first].address(), arrays_[first + 1].address(), arrays_[first + 2].address()};
    }

    /// Sorts the sides, and numbers edges, hinges and non-manifold edges.
    void sort_sides(Recorder& passes) {
        const KeyArrays sides = addresses(0), spare = addresses(3);
        const SideArgs args{.triangles = indices_.address(),
                            .high = sides.high,
                            .low = sides.low,
                            .value = sides.value,
                            .count = triangle_count_,
                            .unused = 0};
        passes.run("sides", args, groups_of(triangle_count_, WEFT_GROUP));
        const KeyArrays sorted =
            record_sort(passes, sides, spare, sides_, bits_below(vertex_count_), {places_.address(), sums_.address()});
        // One of the two sets of arrays holds the sorted sides. The other one is free and takes the flags.
        flags_ = sorted.high == sides.high ? 3 : 0;
        const KeyArrays flags = addresses(flags_);
        edge_args_ = {};
        edge_args_.high = sorted.high, edge_args_.low = sorted.low, edge_args_.value = sorted.value;
        edge_args_.heads = flags.high, edge_args_.hinges = flags.low, edge_args_.crowded = flags.value;
        edge_args_.triangles = indices_.address();
        edge_args_.count = sides_;
        passes.run("flags", edge_args_, groups_of(sides_ + 1, WEFT_GROUP));
        for (const std::uint64_t list : {flags.high, flags.low, flags.value})
            record_scan(passes, list, list, sides_ + 1, sums_.address());
    }

    /// Reads the lengths of the lists: the last elements of the scans.
    Result<void> read_counts() {
        auto back = device_.memory().buffer(3 * word, MemoryKind::readback, "lengths of lists");
        if (!back) return back.errors();
        auto done = gpu::run_once(device_, [&](gpu::Commands& commands) {
            for (std::uint32_t list = 0; list < 3; ++list)
                commands.copy(arrays_[flags_ + list], *back, word, sides_ * word, list * word);
            commands.host_barrier();
        });
        if (!done) return done;
        const auto counts = back->as<std::uint32_t>();
        edges_ = counts[0], hinges_ = counts[1], crowded_ = counts[2];
        return {};
    }

    Result<void> make_lists() {
        if (auto made = make(to_edges_, edges_ * sizeof(Edge), "edges"); !made) return made;
        if (auto made = make(to_hinges_, hinges_ * sizeof(Hinge), "hinges"); !made) return made;
        if (auto made = make(to_crowded_, crowded_ * word, "non-manifold edges"); !made) return made;
        if (auto made = make(inconsistent_, word, "inconsistent hinges"); !made) return made;
        return gpu::run_once(device_, [&](gpu::Commands& commands) { commands.fill(inconsistent_, 0, word); });
    }

    void write_lists(Recorder& passes) {
        edge_args_.to_edges = to_edges_.address();
        edge_args_.to_hinges = to_hinges_.address();
        edge_args_.to_crowded = to_crowded_.address();
        edge_args_.to_inconsistent = inconsistent_.address();
        passes.run("edges", edge_args_, groups_of(sides_, WEFT_GROUP));
    }

    template <class Array>
    Result<void> read(const Buffer& buffer, Array& array, std::uint32_t count) {
        array.resize(count);
        return download(device_, buffer, 0, std::as_writable_bytes(std::span(array)));
    }

    Result<EdgesAndHinges> read_lists() {
        EdgesAndHinges found;
        std::vector<std::uint32_t> inconsistent;
        if (auto done = read(to_edges_, found.edges.edges, edges_); !done) return done.errors();
        if (auto done = read(to_crowded_, found.edges.non_manifold, crowded_); !done) return done.errors();
        if (auto done = read(to_hinges_, found.hinges.hinges, hinges_); !done) return done.errors();
        if (auto done = read(inconsistent_, inconsistent, 1); !done) return done.errors();
        found.hinges.inconsistent = inconsistent.front();
        return found;
    }

    gpu::Device& device_;
    Programs& programs_;
    std::span<const Triangle> triangles_;
    std::uint32_t vertex_count_, triangle_count_, sides_;
    Buffer indices_, places_, sums_;
    std::array<Buffer, 6> arrays_;  // two sets of high, low and value
    std::uint32_t flags_ = 0;       // first of the three arrays that hold flags, and then their sums
    EdgeArgs edge_args_{};
    std::uint32_t edges_ = 0, hinges_ = 0, crowded_ = 0;
    Buffer to_edges_, to_hinges_, to_crowded_, inconsistent_;
};

}  // namespace

Result<EdgesAndHinges> build_edges_and_hinges(gpu::Device& device, Programs& programs,
                                              std::span<const Triangle> triangles, std::uint32_t vertex_count,
                                              EdgeTimes* times) {
    if (triangles.empty()) return EdgesAndHinges{};
    if (triangles.size() > most_elements / 3) return too_many(triangles.size() * 3, "sides of triangles");
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    EdgeBuilder builder(device, programs, triangles, vertex_count);
    auto found = builder.run();
    if (times) {
        times->device_ms = builder.device_ms;
        times->wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    }
    return found;
}

}  // namespace weft::vulkan
