// Square sheets on a Vulkan device, timed with the device's clock: milliseconds per frame by method, compared with the
// time of their memory traffic. Needs only a driver at run time.

#include "cli/bench/bench_reference.h"
#include "gpu/device.h"
#include "gpu_pipelines.h"
#include "gpu_probes.h"
#include "mesh/procedural.h"
#include "solver/world/world.h"
#include "vulkan/vulkan_backend.h"

#include <charconv>
#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

namespace {

using namespace weft;
using bench::median;

struct Options {
    std::vector<std::uint32_t> sizes = {64, 128, 256, 512, 1024};
    std::string device;
    bool quick = false, pipelines = false;
};

struct Method {
    const char* name;
    SolverDesc solver;
    const char* execution = "auto";
    std::uint32_t largest = 4096;  ///< particles along a side of the largest sheet that is measured
};
// Executing a whole cloth in one workgroup is for small cloths.
constexpr std::uint32_t largest_fused = 64;
constexpr SolverDesc jacobi{.substeps = 6, .iterations = 42, .projection = Projection::jacobi, .hierarchy = false};
constexpr SolverDesc jacobi_fixed{.substeps = 6,
                                  .iterations = 42,
                                  .projection = Projection::jacobi,
                                  .accumulate = Accumulate::fixed_point,
                                  .hierarchy = false};
constexpr SolverDesc gauss_seidel(std::uint32_t substeps) {
    return {.substeps = substeps, .projection = Projection::gauss_seidel, .hierarchy = false};
}
constexpr SolverDesc lines_and_levels(std::uint32_t substeps) {
    return {.substeps = substeps, .projection = Projection::lines};
}
constexpr Method methods[] = {{"jacobi", jacobi, "streamed"},
                              {"jacobi", jacobi, "fused", largest_fused},
                              {"jacobi, fixed", jacobi_fixed, "streamed"},
                              {"jacobi, fixed", jacobi_fixed, "fused", largest_fused},
                              {"gauss-seidel", gauss_seidel(20)},
                              {"gauss-seidel", gauss_seidel(30)},
                              {"lines+hierarchy", lines_and_levels(20)},
                              {"lines+hierarchy", lines_and_levels(30)}};
// For many small cloths at once.
constexpr Method methods_of_many[] = {{"gauss-seidel", gauss_seidel(20)}, {"lines+hierarchy", lines_and_levels(20)}};

// Numbers of frames, the same on every device, so that hashes can be compared.
struct Frames {
    unsigned warmup, runs, per_run;
    std::uint32_t most_iterations;
};
constexpr Frames usual_frames{20, 5, 10, 10000}, quick_frames{1, 2, 2, 4};

constexpr double frame_seconds = 1.0 / 60;

WorldSettings settings_of(const Method& method) {
    return {.solver = method.solver, .surface = false};
}

// 1 m of rigid sheet of 0.2 kg that hangs by two neighboring corners, as in bench/scenes.
Result<std::shared_ptr<const ClothModel>> make_sheet(std::uint32_t side, bool bends, const ClothLayout& layout) {
    TriangleMesh mesh = make_grid({1, 1}, {side, side}, GridDiagonal::uniform);
    auto topology = build_topology(mesh, {.reorder = false});
    if (!topology) return topology.errors();
    Fabric fabric;
    fabric.body.density = 0.2f;
    fabric.body.damping = 0;
    fabric.stretch.inextensible = true;
    fabric.tether.use = Tethers::off;
    if (!bends) std::ranges::fill(fabric.bend.bend, 0.0f);
    return build_cloth_model({.name = "sheet",
                              .mesh = std::move(mesh),
                              .fabric = fabric,
                              .pins = {.particles = {0, side - 1}},
                              .layout = layout},
                             std::move(*topology));
}

// Bytes that an iteration of averaged Jacobi moves if each particle gathers its constraints itself and nothing is
// written in between: its position read and written, and for each of its constraints the indices of the other particles
// and the fields. The positions of its neighbors come from a cache.
double gathered_bytes(const ClothModel& model) {
    double bytes = 32.0 * model.point_count();
    for (const ConstraintTable& table : model.constraints) {
        const double numbers = 4.0 * (table.arity - 1) + 4.0 * table.field_count;
        bytes += static_cast<double>(table.rows) * constraint_info(table.kind).moved * numbers;
    }
    return bytes;
}

struct Floor {
    double frame_bytes = 0, iteration_bytes = 0;  ///< per frame; of its iterations, per particle and iteration
};

Floor floor_of(const World& world, const Method& method) {
    const cli::FrameTraffic traffic = cli::frame_traffic(world);
    const ClothModel& model = *world.summary().cloths[0].model;
    const double iterations = static_cast<double>(method.solver.substeps) * method.solver.iterations;
    const auto cloths = static_cast<double>(world.summary().cloths.size());
    double projection = 0;  // everything that is repeated in each iteration
    for (std::uint32_t stage = 0; stage < stage_count; ++stage) {
        const std::string_view name = stage_name(stage);
        if (stage < constraint_kind_count || name == "average" || name == "hierarchy")
            projection += traffic.bytes[stage];
    }
    const double rest = traffic.all() - projection;
    if (method.solver.projection == Projection::jacobi) projection = cloths * iterations * gathered_bytes(model);
    return {rest + projection, projection / iterations / (model.point_count() * cloths)};
}

struct Line {
    double device_ms = 0, wall_ms = 0;
    double spread = 0;  ///< of the runs' medians, largest over smallest - 1
    double stretch = 0;
    Floor floor;
    std::string hash;
    std::string reports;  ///< of any frame
    bool failed = false;  ///< whether the device failed or values became non-finite
};

Result<Line> measure(World& world, const std::shared_ptr<const ClothModel>& model, std::uint32_t cloths,
                     const Method& method, const Frames& frames) {
    world.configure(settings_of(method));
    std::vector<ClothId> ids;
    const auto clear = [&] {
        for (const ClothId id : ids) world.remove(id);
    };
    for (std::uint32_t i = 0; i < cloths; ++i) {
        auto id = world.try_add(model);
        if (!id) return clear(), id.errors();
        ids.push_back(*id);
    }
    Line line;
    std::uint32_t reports = report_none;
    std::string detail;
    const auto step = [&] {
        world.advance(frame_seconds);
        const Frame& frame = world.summary();
        if (detail.empty()) detail = frame.cloths[0].detail;
        reports |= frame.reports;
        return std::accumulate(frame.stage_ms.begin(), frame.stage_ms.end(), 0.0);
    };
    for (unsigned i = 0; i < frames.warmup; ++i) step();
    std::vector<double> device, wall, medians;
    for (unsigned run = 0; run < frames.runs; ++run) {
        const auto begin = device.size();
        for (unsigned i = 0; i < frames.per_run; ++i) {
            device.push_back(step());
            wall.push_back(world.summary().step_ms);
        }
        medians.push_back(median({device.begin() + static_cast<std::ptrdiff_t>(begin), device.end()}));
    }
    line.device_ms = median(device);
    line.wall_ms = median(wall);
    const auto [least, most] = std::ranges::minmax(medians);
    line.spread = least > 0 ? most / least - 1 : 0;
    line.stretch = world.stretch_residual().mean;
    line.floor = floor_of(world, method);
    line.hash = world.state_hash();
    for (const std::string_view name : report_names(reports)) line.reports += "  " + std::string(name);
    if (!detail.empty()) line.reports += "  " + detail;
    line.failed = reports & (report_non_finite | report_device_failed);
    clear();
    return line;
}

void print_head(const gpu::DeviceInfo& info, const bench::Probes& probes, const Frames& frames) {
    std::printf("%s\n", gpu::describe(info).c_str());
    std::printf("dispatch and barrier  %.2f us; dispatches alone %.2f us\n", probes.dispatch_us, probes.unordered_us);
    std::printf("barrier() of %u invocations  %.3f us, with a number to and from shared memory\n", probes.invocations,
                probes.barrier_us);
    std::printf("copying %.0f MiB  %.1f GB/s by command, %.1f GB/s by shader, read and written bytes\n",
                static_cast<double>(probes.copied_bytes) / (1 << 20), probes.copy_rate * 1e-9,
                probes.stream_rate * 1e-9);
    std::printf(
        "1 m of rigid sheet by two corners, 60 frames a second; %u frames after %u, medians; floor: bytes over "
        "the better rate\n\n",
        frames.runs * frames.per_run, frames.warmup);
    std::printf("%-8s %-4s %-15s %-8s %6s %11s %7s %10s %7s %10s %7s %9s  %s\n", "sheet", "bend", "method", "executed",
                "steps", "device ms", "runs +%", "wall ms", "B/p/it", "floor ms", "ratio", "stretch %", "state hash");
}

/// Sheets of one size.
struct Sheets {
    std::uint32_t side = 0;
    bool bends = false;
    std::uint32_t count = 1;
};

void print_line(const Sheets& sheets, const Method& method, const Result<Line>& result, double rate) {
    const std::string many = sheets.count > 1 ? std::to_string(sheets.count) + "x" : "",
                      sheet = many + std::to_string(sheets.side) + "^2",
                      steps = std::to_string(method.solver.substeps) + "x" + std::to_string(method.solver.iterations);
    std::printf("%-8s %-4s %-15s %-8s %6s ", sheet.c_str(), sheets.bends ? "yes" : "no", method.name, method.execution,
                steps.c_str());
    if (result) {
        const double floor = result->floor.frame_bytes / rate * 1e3;
        std::printf("%11.3f %7.1f %10.3f %7.0f %10.4f %7.2f %9.4f  %s%s\n", result->device_ms, result->spread * 100,
                    result->wall_ms, result->floor.iteration_bytes, floor, result->device_ms / floor,
                    result->stretch * 100, result->hash.c_str(), result->reports.c_str());
    } else {
        std::printf("  %s\n", result.error().message().c_str());
    }
    std::fflush(stdout);
}

// One world per execution mode, because the mode belongs to the backend.
class Worlds {
  public:
    explicit Worlds(std::string device) : device_(std::move(device)) {}
    Result<World*> get(const std::string& execution) {
        std::unique_ptr<World>& world = worlds_[execution];
        if (!world) {
            auto backend = make_vulkan_backend({.execution = execution, .device = device_, .timings = true});
            if (!backend) return backend.errors();
            world = std::make_unique<World>(std::move(*backend), WorldSettings{});
        }
        return world.get();
    }

  private:
    std::string device_;
    std::map<std::string, std::unique_ptr<World>> worlds_;
};

// Prints every method for sheets of one size. False if one failed.
bool print_sheets(Worlds& worlds, const Sheets& sheets, std::span<const Method> all, const Frames& frames,
                  double rate) {
    bool fine = true;
    std::optional<Result<std::shared_ptr<const ClothModel>>> model;
    ClothLayout last;
    for (Method method : all) {
        if (sheets.side > method.largest) continue;
        method.solver.iterations = std::min(method.solver.iterations, frames.most_iterations);
        const ClothLayout layout = settings_of(method).layout();
        if (!model || layout != last) model = make_sheet(sheets.side, sheets.bends, layout);
        last = layout;
        const auto world = worlds.get(method.execution);
        if (!world) {
            print_line(sheets, method, world.errors(), rate);
            fine = false;
            continue;
        }
        const Result<Line> line = *model ? measure(**world, **model, sheets.count, method, frames) : (*model).errors();
        print_line(sheets, method, line, rate);
        fine &= line.ok() && !line->failed;
    }
    return fine;
}

Result<int> run(const Options& options) {
    auto instance = gpu::Instance::create();
    if (!instance) return instance.errors();
    auto info = gpu::choose_device((*instance)->devices(), options.device, true);
    if (!info) return info.errors();
    if (options.pipelines) {
        if (auto printed = bench::print_pipelines(*instance, *info); !printed) return printed.errors();
        return 0;
    }
    const Frames& frames = options.quick ? quick_frames : usual_frames;
    bench::Probes probes;
    {
        auto device = gpu::Device::create(*instance, *info);
        if (!device) return device.errors();
        auto probed = bench::probe(**device, options.quick);
        if (!probed) return probed.errors();
        probes = *probed;
    }
    print_head(*info, probes, frames);
    Worlds worlds(options.device);
    bool fine = true;
    for (const std::uint32_t side : options.sizes) {
        for (const bool bends : {false, true})
            fine &= print_sheets(worlds, {.side = side, .bends = bends}, methods, frames, probes.best_rate());
    }
    const std::uint32_t many = options.quick ? 4 : 256, small = options.quick ? 16 : 32;
    for (const bool bends : {false, true})
        fine &= print_sheets(worlds, {.side = small, .bends = bends, .count = many}, methods_of_many, frames,
                             probes.best_rate());
    return fine ? 0 : 1;
}

constexpr const char* usage =
    "usage: weft_gpu_bench [--sizes N,N...] [--quick] [--device NAME] [--pipelines]\n"
    "  --sizes   particles along each side, 4 to 4096; without, 64,128,256,512,1024\n"
    "  --quick   few frames of small sheets (32,64): whether it works, not how fast it is\n"
    "  --device  part of the device's name; without, the best GPU, or else a CPU that plays one\n"
    "  --pipelines  only how long the shaders take to compile, each alone and all side by side\n";

std::optional<std::vector<std::uint32_t>> parse_sizes(std::string_view text) {
    std::vector<std::uint32_t> sizes;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        std::uint32_t size = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + comma, size);
        if (error != std::errc() || end != text.data() + comma || size < 4 || size > 4096) return std::nullopt;
        sizes.push_back(size);
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    if (sizes.empty()) return std::nullopt;
    return sizes;
}

// Nothing if the arguments are invalid.
std::optional<Options> parse(std::span<char* const> arguments) {
    Options options;
    std::optional<std::vector<std::uint32_t>> sizes;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string_view argument = arguments[i];
        const bool has_value = i + 1 < arguments.size();
        if (argument == "--quick") {
            options.quick = true;
        } else if (argument == "--pipelines") {
            options.pipelines = true;
        } else if (argument == "--sizes" && has_value) {
            sizes = parse_sizes(arguments[++i]);
            if (!sizes) return std::nullopt;
        } else if (argument == "--device" && has_value) {
            options.device = arguments[++i];
        } else {
            return std::nullopt;
        }
    }
    if (options.quick) options.sizes = {32, 64};
    if (sizes) options.sizes = std::move(*sizes);
    return options;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
    if (!options) {
        std::fputs(usage, stderr);
        return 64;
    }
    const auto result = run(*options);
    if (result) return *result;
    std::fprintf(stderr, "weft_gpu_bench: %s\n", result.error().message().c_str());
    return 2;
}
