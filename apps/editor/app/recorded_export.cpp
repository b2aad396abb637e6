#include "editor/app/recorded_export.h"

#include "io/exports/export_plan.h"
#include "io/exports/scene_export.h"
#include "io/files/overwriting.h"
#include "io/images/film_frames.h"
#include "io/images/picture_writer.h"
#include "io/images/pictures_beside.h"
#include "view/framing.h"
#include "view/scene_view.h"
#include "vulkan/interop.h"
#include "weft/drawn_frame.h"
#include "weft/drawn_solids.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <optional>
#include <thread>
#include <utility>

namespace weft::editor {

struct RecordedExport::Impl {
    Impl(std::shared_ptr<Simulator> s, RecordedExportOptions o) : simulator(std::move(s)), options(std::move(o)) {}

    void run();
    Result<void> write();
    Result<void> write_meshes();
    Result<void> write_images();
    Result<void> show(std::uint64_t frame);
    Result<MomentPtr> moment_at(std::uint64_t frame);
    std::uint64_t last() const { return options.frames.last - options.frames.first; }
    double frame_rate() const { return static_cast<double>(world->scene().frame_rate); }
    Errors overwritten(const std::vector<std::filesystem::path>& outputs) const;

    std::shared_ptr<Simulator> simulator;
    const RecordedExportOptions options;
    std::atomic<float> done{0};
    std::atomic<bool> stop{false}, ended{false};
    std::string problem;  // valid once it has ended

    // Of the thread:
    std::optional<SceneWorld> world;
    double begin_time = 0;
    std::vector<std::uint64_t> branches;
    std::thread thread;
};

namespace {

struct Recorded {
    Result<MomentPtr> moment;
    std::vector<std::uint64_t> branches;  ///< of all frames to export
};

const Error canceled{"", "canceled"};

}  // namespace

// The simulating thread hands the frame out between two of its steps.
Result<MomentPtr> RecordedExport::Impl::moment_at(std::uint64_t frame) {
    const auto answer = std::make_shared<std::promise<Recorded>>();
    std::future<Recorded> recorded = answer->get_future();
    simulator->look([answer, frame, range = options.frames](const Stage& stage) {
        Recorded taken{stage.timeline().moment_at(frame), {}};
        for (std::uint64_t i = range.first; i <= range.last; ++i)
            taken.branches.push_back(stage.timeline().branch_at(i));
        answer->set_value(std::move(taken));
    });
    while (recorded.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready)
        if (stop) return canceled;
    Recorded taken = recorded.get();
    if (branches.empty()) branches = taken.branches;
    if (taken.branches != branches)
        return Error{"frame " + std::to_string(frame), "the frames were recorded anew while they were exported"};
    return std::move(taken.moment);
}

// The world takes the place of the one that was recorded.
Result<void> RecordedExport::Impl::show(std::uint64_t frame) {
    if (stop) return canceled;
    const auto moment = moment_at(frame);
    if (!moment) return moment.errors();
    if (!world) {
        SceneDesc empty = *(*moment)->world.scene;
        empty.cloths.clear(), empty.colliders.clear(), empty.stitches.clear();
        Options with;
        with.backend = "cpu";
        with.threads = 1;
        auto made = SceneWorld::create(std::move(empty), with, (*moment)->document->folder);
        if (!made) return made.errors();
        world.emplace(std::move(*made));
    }
    return world->go_to((*moment)->world);
}

Errors RecordedExport::Impl::overwritten(const std::vector<std::filesystem::path>& outputs) const {
    return overwritten_inputs(outputs, files_of(world->scene(), world->folder()));
}

Result<void> RecordedExport::Impl::write_meshes() {
    auto exporter = make_exporter(options.file);
    if (!exporter) return exporter.errors();
    std::vector<std::unique_ptr<Exporter>> exporters;
    exporters.push_back(std::move(*exporter));
    DrawnFrame cloths;
    DrawnSolids solids;
    for (std::uint64_t i = 0; i <= last(); ++i) {
        if (auto shown = show(options.frames.first + i); !shown) return shown;
        const Frame& frame = world->world().frame();
        cloths.update(frame, world->scene().cloths);
        solids.update(world->world(), world->scene().colliders);
        if (i == 0) begin_time = frame.time;
        const ExportFrame one{i, frame.time - begin_time, cloths.surfaces(), solids.solids()};
        if (i == 0) {
            const ExportInfo info{world->scene().name, frame_rate(), last() + 1, world->folder()};
            const auto planned = plan_exports(exporters, info, one);
            if (!planned) return planned.errors();
            if (Errors errors = overwritten(planned->front().files); !errors.empty()) return errors;
            if (auto begun = exporters.front()->begin(info); !begun) return begun;
        }
        if (auto written = exporters.front()->write(one); !written) return written;
        done = static_cast<float>(i + 1) / static_cast<float>(last() + 1);
    }
    return exporters.front()->finish();
}

Result<void> RecordedExport::Impl::write_images() {
    auto writer = make_picture_writer(options.file);
    if (!writer) return writer.errors();
    if (auto shown = show(options.frames.first); !shown) return shown;
    if (Errors errors = overwritten({options.file}); !errors.empty()) return errors;
    const ImageOptions& images = options.images;
    const double wanted = images.frames_per_second > 0 ? images.frames_per_second : frame_rate();
    const double rate = std::min(wanted, frame_rate());
    const FilmFrames film(last(), frame_rate(), rate);
    const bool still = (*writer)->keeps_last_only();
    const std::uint64_t count = still ? 1 : film.count();
    if (auto begun = (*writer)->begin(
            {.width = images.width, .height = images.height, .frame_rate = rate, .picture_count = count});
        !begun)
        return begun;
    auto device = make_vulkan_device({.software = true});
    if (!device) return device.errors();
    auto view =
        SceneView::create(*device, world->scene(), LiveWorldFrame(world->world()),
                          {.width = images.width, .height = images.height, .samples = 4, .overlays = images.overlays},
                          {.surface = {},
                           .read_picture = pictures_beside(world->folder()),
                           .read_light = lights_beside(world->folder())});
    if (!view) return view.errors();
    view->set_hidden(options.hidden);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t frame = still ? last() : film.frame(i);
        if (auto shown = show(options.frames.first + frame); !shown) return shown;
        const LiveWorldFrame now(world->world());
        const Camera camera = images.camera ? *images.camera : view->camera(world->scene(), now);
        const auto picture = view->picture(world->scene(), now, camera);
        if (!picture) return picture.errors();
        if (auto written = (*writer)->write(*picture); !written) return written;
        done = static_cast<float>(i + 1) / static_cast<float>(count);
    }
    return (*writer)->finish();
}

Result<void> RecordedExport::Impl::write() {
    try {
        return is_image(options.file) ? write_images() : write_meshes();
    } catch (const std::exception& error) {
        return Error::of_machine("", error.what());
    }
}

void RecordedExport::Impl::run() {
    if (const auto written = write(); !written) problem = written.error().message();
    world.reset();
    ended = true;
}

RecordedExport::RecordedExport(std::shared_ptr<Simulator> simulator, RecordedExportOptions options)
    : impl_(std::make_unique<Impl>(std::move(simulator), std::move(options))) {
    impl_->thread = std::thread([this] { impl_->run(); });
}

RecordedExport::~RecordedExport() {
    cancel();
    if (impl_->thread.joinable()) impl_->thread.join();
}

void RecordedExport::update() {
    if (!impl_->ended || !impl_->thread.joinable()) return;
    impl_->thread.join();
    problem_ = impl_->problem;
    impl_->simulator.reset();
}

bool RecordedExport::running() const {
    return impl_->thread.joinable();
}

float RecordedExport::done() const {
    return impl_->done;
}

void RecordedExport::cancel() {
    impl_->stop = true;
}

const std::filesystem::path& RecordedExport::file() const {
    return impl_->options.file;
}

FrameRange frames_to_export(const Published& now) {
    for (const FrameRange& range : now.valid)
        if (range.first <= now.frame && now.frame <= range.last) return range;
    return now.valid.empty() ? FrameRange{} : now.valid.back();
}

}  // namespace weft::editor
