#include "cli/render/render_options.h"
#include "cli/render/render_window.h"

#ifdef WEFT_VULKAN
#include "cli/render/view_sources.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/progress.h"
#include "files/open_scene.h"
#include "io/exports/scene_export.h"
#include "io/files/overwriting.h"
#include "io/images/picture_writer.h"
#include "view/framing.h"
#include "view/overlays.h"
#include "view/scene_view.h"
#include "weft/drawing_device.h"

#include <algorithm>
#include <cstdio>
#include <set>
#endif

namespace weft::cli {
namespace {

#ifdef WEFT_VULKAN

using Writers = std::vector<std::unique_ptr<PictureWriter>>;

/// A run and the images to draw of it.
struct Job {
    SceneWorld& session;
    SceneView& view;
    Writers& writers;
    std::optional<Camera> camera;  ///< of the command line or the scene; if empty, see `films`
    bool films = false;            ///< true: the camera follows the cloth; false: placed for the last frame
    float aspect = 1;
    double orbit = 0;  ///< degrees, from the first frame to the last
    std::uint64_t frames = 0;
    FilmFrames film;
    bool quiet = false;

    std::optional<FollowingCamera> following = {};
    std::uint64_t followed = 0;  ///< the last frame that the camera has followed
};

Result<Writers> make_writers(const RenderOptions& options) {
    Writers writers;
    Errors errors;
    for (const std::string& path : options.outputs) {
        auto writer = make_picture_writer(path);
        if (writer) {
            writers.push_back(std::move(*writer));
        } else {
            errors.insert(errors.end(), writer.errors().begin(), writer.errors().end());
        }
    }
    if (!errors.empty()) return errors;
    return writers;
}

/// Returns what the overlays need.
Result<std::set<OverlayNeeds>> check_overlays(const std::vector<std::string>& names) {
    Errors errors;
    std::set<OverlayNeeds> needs;
    for (const std::string& name : names) {
        const auto overlay = find_overlay(name);
        if (overlay) {
            needs.insert((*overlay)->needs);
        } else {
            for (const Error& error : overlay.errors()) errors.push_back({"--overlay", error.message()});
        }
    }
    if (!errors.empty()) return errors;
    return needs;
}

Result<std::shared_ptr<gpu::Device>> find_device(World& world, const std::string& name) {
    auto device = drawing_device(world, name);
    if (device) return device;
    Errors errors = device.errors();
    for (Error& error : errors) {
        constexpr std::string_view elsewhere = ", or use --backend cpu";  // helps a run, not rendering
        if (const auto at = error.what.find(elsewhere); at != std::string::npos) error.what.erase(at, elsewhere.size());
        error.what += "; rendering needs Vulkan, whatever the backend";
    }
    return errors;
}

Camera camera_at(Job& job, std::uint64_t frame) {
    if (job.camera) return *job.camera;
    const World& world = job.session.world();
    if (!job.films) return job.view.camera(job.session.scene(), world);
    const auto passed = static_cast<double>(frame - job.followed);
    if (job.following) {
        job.following->follow(subject_of(world), static_cast<float>(passed * job.session.frame_seconds()));
    } else {
        job.following.emplace(subject_of(world), job.aspect);
    }
    job.followed = frame;
    return job.following->camera();
}

Result<void> draw(Job& job, std::uint64_t frame, bool in_film) {
    const double part = job.frames == 0 ? 1 : static_cast<double>(frame) / static_cast<double>(job.frames);
    auto picture = job.view.picture(job.session.scene(), job.session.world(),
                                    orbited(camera_at(job, frame), static_cast<float>(job.orbit * part)));
    if (!picture) return picture.errors();
    for (auto& writer : job.writers) {
        if (!(writer->keeps_last_only() ? frame == job.frames : in_film)) continue;
        if (auto written = writer->write(*picture); !written) return written;
    }
    return {};
}

Result<void> simulate_and_draw(Job& job) {
    const bool stills = std::ranges::any_of(job.writers, [](const auto& writer) { return writer->keeps_last_only(); });
    const EndOnSignal end_on_signal;
    Progress progress(job.films ? "rendering" : "simulating", job.frames, job.quiet);
    std::uint64_t picture = 0;
    bool warned = false;
    for (std::uint64_t i = 0; i <= job.frames; ++i) {
        if (i > 0) {
            job.session.advance();
            if (auto went = check_step(job.session.world().summary(), warned); !went) return went;
        }
        const bool in_film = job.films && picture < job.film.count() && job.film.frame(picture) == i;
        if (in_film || (stills && i == job.frames)) {
            if (auto drawn = draw(job, i, in_film); !drawn) return drawn;
        }
        if (in_film) ++picture;
        if (i > 0) progress.update(i);
        if (end_on_signal.asked())
            return Error{"", "interrupted at frame " + std::to_string(i) + " of " + std::to_string(job.frames) +
                                 ": only files that were complete by then were written"};
    }
    for (auto& writer : job.writers)
        if (auto finished = writer->finish(); !finished) return finished;
    return {};
}

int wrong(const Errors& errors) {
    print_errors(errors);
    return exit_code(errors);
}

int report(const RenderOptions& options, const Result<void>& done) {
    if (!done) {
        print_errors(done.errors());
        return exit_failed;
    }
    if (!options.quiet)
        for (const std::string& file : options.outputs) std::printf("wrote %s\n", file.c_str());
    return exit_done;
}

/// --window: runs until the window is closed or the given time is simulated.
int open_window(const RenderOptions& options, const RenderPlan& plan) {
    if (const auto checked = check_overlays(options.overlays); !checked) return wrong(checked.errors());
    return show({.scene = options.scene,
                 .length = options.length,
                 .width = plan.size.width,
                 .height = plan.size.height,
                 .samples = static_cast<std::uint32_t>(options.samples),
                 .camera = plan.camera,
                 .overlays = options.overlays,
                 .common = options.common});
}

int render(const RenderOptions& options) {
    const auto plan = check_options(options);
    if (!plan) return wrong(plan.errors());
    if (options.window) return open_window(options, *plan);
    auto writers = make_writers(options);
    if (!writers) return wrong(writers.errors());
    const auto needs = check_overlays(options.overlays);
    if (!needs) return wrong(needs.errors());

    Options common = options.common;
    common.contact_forces = needs->contains(OverlayNeeds::contact_forces);
    if (common.backend == "cpu") common.device.clear();  // --device names the drawing device
    auto session = open_scene(options.scene, common);
    if (!session) return wrong(session.errors());
    session->set_contact_marks(needs->contains(OverlayNeeds::contact_marks));
    const auto frames = frame_count(options.length, session->frame_seconds(), 0);
    if (!frames) return wrong(frames.errors());
    const double frame_rate = static_cast<double>(session->scene().frame_rate);
    const auto rate = film_rate(options, frame_rate);
    if (!rate) return wrong(rate.errors());
    auto device = find_device(session->world(), options.common.device);
    if (!device) return wrong(device.errors());

    const std::vector<std::filesystem::path> outputs(options.outputs.begin(), options.outputs.end());
    if (const Errors errors = overwritten_inputs(outputs, files_of(session->scene(), session->folder()));
        !errors.empty())
        return wrong(errors);

    const FilmFrames film(*frames, frame_rate, *rate);
    for (auto& writer : *writers) {
        const auto begun = writer->begin({.width = plan->size.width,
                                          .height = plan->size.height,
                                          .frame_rate = *rate,
                                          .picture_count = film.count(),
                                          .transparent = options.transparent});
        if (!begun) return wrong(begun.errors());
    }
    auto view = SceneView::create(*device, session->scene(), session->world(),
                                  {.width = plan->size.width,
                                   .height = plan->size.height,
                                   .samples = static_cast<std::uint32_t>(options.samples),
                                   .transparent = options.transparent,
                                   .overlays = options.overlays},
                                  view_sources(options.scene, session->world()));
    if (!view) return wrong(view.errors());
    for (const std::string& note : session->notes()) print_warning(note);
    for (const std::string& note : view->notes()) print_warning(note);

    Job job{.session = *session,
            .view = *view,
            .writers = *writers,
            .camera = plan->camera ? plan->camera : session->scene().camera,
            .films = !std::ranges::all_of(*writers, [](const auto& writer) { return writer->keeps_last_only(); }),
            .aspect = static_cast<float>(plan->size.width) / static_cast<float>(plan->size.height),
            .orbit = options.orbit,
            .frames = *frames,
            .film = film,
            .quiet = options.quiet};
    return report(options, simulate_and_draw(job));
}

std::string overlay_names() {
    std::string names;
    for (const Overlay& overlay : overlays()) names += (names.empty() ? "" : ", ") + std::string(overlay.name);
    return names;
}

#else

int render(const RenderOptions& options) {
    if (const auto plan = check_options(options); !plan) {
        print_errors(plan.errors());
        return exit_code(plan.errors());
    }
    print_errors({{"", "this build has no Vulkan, which rendering needs; build with -D WEFT_VULKAN=ON"}});
    return exit_failed;
}

std::string overlay_names() {
    return "none in this build";
}

#endif

}  // namespace

Command add_render(Program& program) {
    Arguments arguments = program.add_command("render", "Simulate a scene and draw it: images, a video or a window");
    auto options = std::make_shared<RenderOptions>();
    arguments.add("scene", options->scene, "scene file").called("FILE").required();
    add_length_options(arguments, options->length, "simulate; 0 draws the start");
    Argument out = arguments.add(
        "--out", options->outputs,
        "FILE.png: the last frame; DIR/%04d.png: every frame; FILE.mp4: a video, written by ffmpeg; may be repeated");
    out.called("FILE").one_at_a_time();
    arguments.add("--size", options->size, "size of the image in pixels").called("WxH").with_default();
    arguments
        .add("--samples", options->samples, "samples per pixel, a power of two from 1 to 256; more than 4 take longer")
        .called("N")
        .with_default();
    arguments
        .add("--camera", options->camera, "position and target in m, field of view in degrees; in place of the scene's")
        .called("PX,PY,PZ,TX,TY,TZ[,FOV]");
    arguments.add("--orbit", options->orbit, "turn the camera around its target by this angle until the last frame")
        .called("DEGREES");
    arguments.add("--fps", options->fps, "images per second of a video or sequence; every frame if not given")
        .called("N");
    arguments.add("--overlay", options->overlays, "draw on top; may be repeated: " + overlay_names())
        .called("NAME,...")
        .separated_by(',')
        .one_at_a_time();
    arguments.add("--transparent", options->transparent, "leave out the background; .png only");
    arguments.add("--window", options->window, "show it in a window while it runs").excludes(out);
    arguments.add("--quiet", options->quiet, "print errors only");
    add_common_options(arguments, options->common);
    arguments.footer(
        window_help() +
        "\n"
        "With --backend cpu, --device names the Vulkan device that draws.\n"
        "Examples:\n"
        "  weft render scenes/hanging_bunny.json --seconds 2 --out bunny.png --size 1920x1080 --samples 16\n"
        "  weft render scenes/flag.json --seconds 4 --orbit 90 --fps 30 --out flag.mp4\n"
        "  weft render scenes/hanging_sheet.json --frames 0 --out start.png --camera 0,1,3,0,0.5,0,40");
    return [options] { return render(*options); };
}

}  // namespace weft::cli
