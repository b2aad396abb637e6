#include "cli/bench/bench_measure.h"

#include "cli/bench/bench_reference.h"
#include "cli/run/stats.h"
#include "cli/shell/progress.h"
#include "cpu/cpu_backend.h"
#include "files/open_scene.h"

#include <algorithm>
#include <chrono>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace weft::cli {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// Bytes that the program has allocated and not freed: unlike the size of the process, this excludes free memory that
// the allocator keeps. 0 if unknown.
double heap_bytes() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
#else
    return 0;
#endif
}

// --- Built-in scenes

SceneDesc sheet_scene(std::uint32_t side) {
    SceneCloth sheet{
        .name = "sheet",
        .mesh = GridDesc{.size = {1, 1}, .resolution = {side, side}},
        .transform = {.position = {0, 1, 0}, .rotation_degrees = {85, 0, 0}},  // tilted, so that it can leave its plane
        .pins = {{.select = VertexPins{{0, side - 1}}}}};
    return {.name = "sheet " + std::to_string(side), .cloths = {std::move(sheet)}};
}

// --- Runs

struct Plan {
    std::uint64_t warmup = 0, frames = 0;
    std::uint64_t all() const { return warmup + frames; }
};

struct Average {
    MeanMax sum;
    void add(double mean, double max) { sum.mean += mean, sum.max += max; }
    MeanMax over(double count) const { return {sum.mean / count, sum.max / count}; }
};

// The strain of a swinging sheet oscillates; a window of one second would depend on the phase of the swing.
constexpr double longest_quality_seconds = 2;

std::uint64_t quality_frames(const SceneWorld& session, const Plan& plan) {
    const auto frames = static_cast<std::uint64_t>(longest_quality_seconds / session.frame_seconds() + 0.5);
    return std::clamp<std::uint64_t>(frames, 1, plan.all());
}

using GoOn = std::function<bool(std::uint64_t frames)>;

// The run without a clock. `heap_before`: size of the heap before the session was opened. Returns whether the run was
// completed.
bool run_for_quality(SceneWorld& session, const Plan& plan, double heap_before, const GoOn& go_on,
                     SceneFigures& figures) {
    const std::uint64_t window = quality_frames(session, plan);
    Average stretch, shear, residual;
    std::uint32_t reports = report_none;
    std::uint64_t device_bytes = 0;
    for (std::uint64_t i = 0; i < plan.all(); ++i) {
        session.advance();
        reports |= session.world().summary().reports;
        if (!go_on(i + 1)) return false;
        if (i + window < plan.all()) continue;
        if (i + window == plan.all()) device_bytes = session.world().backend().device_bytes();  // what steps need
        const ClothMeasures now = session.world().measure();
        stretch.add(now.strain.stretch.mean, now.strain.stretch.max);
        shear.add(now.strain.shear.mean, now.strain.shear.max);
        residual.add(now.residual.mean, now.residual.max);
    }
    const auto count = static_cast<double>(window);
    figures.quality_seconds = count * session.frame_seconds();
    figures.stretch = stretch.over(count);
    figures.shear = shear.over(count);
    figures.residual = residual.over(count);
    for (const std::string_view name : report_names(reports)) figures.reports.emplace_back(name);
    figures.state_hash = session.world().state_hash();
    if (figures.particles == 0) return true;
    const auto particles = static_cast<double>(figures.particles);
    if (const double heap_used = heap_bytes() - heap_before; heap_used > 0)
        figures.bytes_per_particle = heap_used / particles;
    figures.device_bytes_per_particle = static_cast<double>(device_bytes) / particles;
    return true;
}

struct Timings {
    std::vector<double> step_ms, this_run;
    std::array<std::vector<double>, stage_count> stage_ms;
    std::vector<double> run_medians, load_ms, build_ms, first_frame_ms;
    std::array<std::vector<double>, build_part_count> part_ms;

    void add(const Frame& frame) {
        this_run.push_back(frame.step_ms);
        for (std::uint32_t s = 0; s < stage_count; ++s) stage_ms[s].push_back(frame.stage_ms[s]);
    }
    void end_run() {
        step_ms.insert(step_ms.end(), this_run.begin(), this_run.end());
        run_medians.push_back(median_of(std::move(this_run)));
        this_run.clear();
    }
};

void add_build_times(const SceneWorld& session, Timings& timings) {
    BuildTimes sum;
    for (const ClothFrame& cloth : session.world().frame().cloths) {
        for (std::uint32_t part = 0; part < build_part_count; ++part) sum.ms[part] += cloth.model->build_times.ms[part];
    }
    timings.build_ms.push_back(sum.total());
    for (std::uint32_t part = 0; part < build_part_count; ++part) timings.part_ms[part].push_back(sum.ms[part]);
}

/// Returns the state hash at the end of the run.
Result<std::string> run_for_time(const BenchSubject& subject, const Options& options, const Plan& plan,
                                 std::uint64_t frames_before, Progress& progress, Timings& timings) {
    const auto begin = Clock::now();
    auto session = subject.open(options);
    if (!session) return session.errors();
    timings.load_ms.push_back(ms_since(begin));
    add_build_times(*session, timings);
    for (std::uint64_t i = 0; i < plan.all(); ++i) {
        session->advance();
        if (i == 0) timings.first_frame_ms.push_back(ms_since(begin));
        if (i >= plan.warmup) timings.add(session->world().summary());
        progress.update(frames_before + i + 1);
    }
    timings.end_run();
    return session->world().state_hash();
}

// --- Figures

void describe(const SceneWorld& session, const Options& options, SceneFigures& figures) {
    const World& world = session.world();
    figures.backend = world.backend().name();
    figures.device = world.backend().device();
    figures.isa = options.isa.empty() ? std::string(cpu_instruction_sets().front()) : options.isa;
    figures.threads = world.backend().threads();
    figures.solver = solver_text(world.settings());
    figures.substeps = world.settings().solver.substeps;
    figures.iterations = world.settings().solver.iterations;
    figures.frame_rate = session.scene().frame_rate;
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        figures.constraints.push_back({std::string(constraint_info(static_cast<ConstraintKind>(kind)).name), 0, 0});
    }
    for (const ClothFrame& cloth : world.frame().cloths) {
        figures.particles += cloth.model->particle_count;
        figures.triangles += cloth.triangles.size();
        for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
            figures.constraints[kind].rows += cloth.model->constraints[kind].rows;
        }
    }
}

Result<Plan> plan_runs(const BenchSubject& subject, const BenchSettings& settings, const SceneWorld& session,
                       SceneFigures& figures) {
    const auto frames = frame_count(settings.length, session.frame_seconds());
    if (!frames) return frames.errors();
    figures.name = subject.name;
    figures.warmup = settings.warmup;
    figures.runs = settings.repeat;
    figures.frames = figures.timed_frames = *frames;
    describe(session, settings.common, figures);
    return Plan{settings.warmup, *frames};
}

// Stages and constraints must still be in the order of their numbers.
void refer(const FrameTraffic& traffic, SceneFigures& figures) {
    ReferenceFigures& reference = figures.reference;
    reference.bytes_per_frame = traffic.all();
    reference.working_set = traffic.working_set;
    // The bandwidth of this processor is no reference for a device.
    if (figures.backend == "cpu") {
        reference.bandwidth =
            copy_bandwidth(static_cast<unsigned>(figures.threads), static_cast<std::size_t>(traffic.working_set));
    }
    const auto seconds = [&](double bytes) { return reference.bandwidth > 0 ? bytes / reference.bandwidth : 0; };
    reference.ms = 1e3 * seconds(reference.bytes_per_frame);
    for (std::uint32_t stage = 0; stage < stage_count; ++stage) {
        figures.stages[stage].reference_ms = 1e3 * seconds(traffic.bytes[stage]);
    }
    const auto rounds = static_cast<double>(figures.substeps * figures.iterations);
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        ConstraintFigures& constraint = figures.constraints[kind];
        if (constraint.rows == 0) continue;
        constraint.bytes_per_row = traffic.bytes[kind] / (static_cast<double>(constraint.rows) * rounds);
        constraint.reference_ns_per_row = 1e9 * seconds(constraint.bytes_per_row);
    }
}

void sum_up(Timings timings, const FrameTraffic& traffic, SceneFigures& figures) {
    std::sort(timings.step_ms.begin(), timings.step_ms.end());
    figures.ms = {median(timings.step_ms), percentile(timings.step_ms, 0.95), timings.step_ms.front(),
                  timings.step_ms.back()};
    figures.run_medians = std::move(timings.run_medians);
    figures.load_ms = median_of(std::move(timings.load_ms));
    figures.build_ms = median_of(std::move(timings.build_ms));
    for (std::uint32_t part = 0; part < build_part_count; ++part) {
        figures.build.push_back({std::string(build_part_name(part)), median_of(std::move(timings.part_ms[part]))});
    }
    figures.first_frame_ms = median_of(std::move(timings.first_frame_ms));
    for (std::uint32_t stage = 0; stage < stage_count; ++stage) {
        figures.stages.push_back({std::string(stage_name(stage)), median_of(std::move(timings.stage_ms[stage]))});
    }
    const auto rounds = static_cast<double>(figures.substeps * figures.iterations);
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {  // a constraint's stage has its number
        ConstraintFigures& constraint = figures.constraints[kind];
        if (constraint.rows == 0) continue;
        constraint.ns_per_row = figures.stages[kind].ms * 1e6 / (static_cast<double>(constraint.rows) * rounds);
    }
    refer(traffic, figures);
    std::erase_if(figures.constraints, [](const ConstraintFigures& constraint) { return constraint.rows == 0; });
}

}  // namespace

BenchSubject scene_subject(const std::string& file) {
    return {file, [file](const Options& options) { return open_scene(file, options); }};
}

std::vector<BenchSubject> built_in_subjects() {
    std::vector<BenchSubject> subjects;
    for (const std::uint32_t side : {32u, 64u, 128u, 256u}) {
        subjects.push_back({"sheet " + std::to_string(side),
                            [side](const Options& options) { return SceneWorld::create(sheet_scene(side), options); }});
    }
    return subjects;
}

std::vector<BenchSubject> build_subjects(const std::vector<std::uint32_t>& sides) {
    std::vector<BenchSubject> subjects;
    for (const std::uint32_t side : sides) {
        subjects.push_back({"build " + std::to_string(side), [side](const Options& options) {
                                SceneDesc scene = sheet_scene(side);
                                scene.cloths.front().tethers = Tethers::on;
                                scene.solver.hierarchy = true;
                                return SceneWorld::create(std::move(scene), options);
                            }});
    }
    return subjects;
}

std::optional<double> ConstraintFigures::ratio() const {
    return reference_ns_per_row > 0 ? std::optional(ns_per_row / reference_ns_per_row) : std::nullopt;
}

std::optional<double> SceneFigures::ratio() const {
    return reference.ms > 0 ? std::optional(ms.median / reference.ms) : std::nullopt;
}

std::optional<double> spread(const SceneFigures& figures) {
    if (figures.run_medians.size() < 2 || figures.ms.median <= 0) return {};
    const auto [least, most] = std::ranges::minmax(figures.run_medians);
    return (most - least) / figures.ms.median;
}

Result<SceneFigures> measure_scene(const BenchSubject& subject, const BenchSettings& settings) {
    SceneFigures figures;
    const double heap_before = heap_bytes();
    auto session = subject.open(settings.common);
    if (!session) return session.errors();
    const auto planned = plan_runs(subject, settings, *session, figures);
    if (!planned) return planned.errors();
    const Plan plan = *planned;
    Progress progress("measuring " + subject.name, (settings.repeat + std::uint64_t{1}) * plan.all(), settings.quiet);

    const FrameTraffic traffic = frame_traffic(session->world());
    const auto on_frame = [&](std::uint64_t frames) {
        progress.update(frames);
        return true;
    };
    run_for_quality(*session, plan, heap_before, on_frame, figures);
    { const SceneWorld gone = std::move(*session); }  // frees the session, because two at once would share the caches

    Timings timings;
    for (std::uint32_t run = 1; run <= settings.repeat; ++run) {
        const auto hash = run_for_time(subject, settings.common, plan, run * plan.all(), progress, timings);
        if (!hash) return hash.errors();
        if (*hash != figures.state_hash) {
            return Error{subject.name, "two runs of the same scene end in different states, " + figures.state_hash +
                                           " and " + *hash + ": the measurement is invalid"};
        }
    }
    sum_up(std::move(timings), traffic, figures);
    return figures;
}

Result<std::optional<SceneFigures>> sample_scene(const BenchSubject& subject, const BenchSettings& settings,
                                                 const std::function<bool(std::uint64_t frames)>& go_on) {
    using Nothing = std::optional<SceneFigures>;
    SceneFigures figures;
    Timings timings;
    const double heap_before = heap_bytes();
    const auto begin = Clock::now();
    auto session = subject.open(settings.common);
    if (!session) return session.errors();
    timings.load_ms.push_back(ms_since(begin));
    add_build_times(*session, timings);
    const auto plan = plan_runs(subject, settings, *session, figures);
    if (!plan) return plan.errors();
    figures.timed_frames = frames_per_sample;
    const FrameTraffic traffic = frame_traffic(session->world());
    const auto first_too = [&](std::uint64_t frames) {
        if (frames == 1) timings.first_frame_ms.push_back(ms_since(begin));
        return go_on(frames);
    };
    if (!run_for_quality(*session, *plan, heap_before, first_too, figures)) return Nothing();
    std::uint64_t frames = plan->all();
    for (std::uint32_t run = 0; run < settings.repeat; ++run) {
        for (std::uint64_t i = 0; i < frames_per_sample; ++i) {
            session->advance();
            timings.add(session->world().summary());
            if (!go_on(++frames)) return Nothing();
        }
        timings.end_run();
    }
    sum_up(std::move(timings), traffic, figures);
    return Nothing(std::move(figures));
}

}  // namespace weft::cli
