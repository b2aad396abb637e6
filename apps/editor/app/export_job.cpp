#include "editor/app/export_job.h"

#include "io/files/atomic_file.h"
#include "io/scenes/scene_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <system_error>
#include <utility>

namespace weft::editor {
namespace {

/// The last line of the process's messages that names a problem.
std::string last_problem(const std::string& text) {
    const std::size_t at = text.rfind("weft: error: ");
    if (at == std::string::npos) return {};
    const std::size_t from = at + 13;
    return text.substr(from, text.find('\n', from) - from);
}

/// The folder of the scene comes first among those in which files are searched.
std::string assets_with(const std::filesystem::path& folder) {
    const std::string first = folder.empty() ? "." : std::filesystem::absolute(folder).string();
    const char* others = std::getenv("WEFT_ASSETS");
    return others && *others ? first + ":" + others : first;
}

std::string text_of(const Camera& camera) {
    std::string text;
    const Vec3 p = camera.position, t = camera.target;
    for (const float number : {p.x, p.y, p.z, t.x, t.y, t.z, camera.fov}) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
        text += (text.empty() ? "" : ",") + std::string(digits, end);
    }
    return text;
}

void add_image_arguments(const ImageOptions& images, std::vector<std::string>& arguments) {
    arguments.insert(arguments.end(), {"--size", std::to_string(images.width) + "x" + std::to_string(images.height)});
    if (images.frames_per_second > 0)
        arguments.insert(arguments.end(), {"--fps", std::to_string(images.frames_per_second)});
    if (images.camera) arguments.insert(arguments.end(), {"--camera=" + text_of(*images.camera)});
    std::string overlays;
    for (const std::string& overlay : images.overlays) overlays += (overlays.empty() ? "" : ",") + overlay;
    if (!overlays.empty()) arguments.insert(arguments.end(), {"--overlay", overlays});
}

/// For a program that has to remove files that are not complete.
constexpr std::chrono::seconds time_to_clean_up{10};

}  // namespace

const std::vector<ExportFormatLine>& export_format_lines() {
    static const std::vector<ExportFormatLine> lines{{".glb", "moving meshes, for Blender and game engines"},
                                                     {".mp4", "video, written by the program ffmpeg", true},
                                                     {".png", "image of the last frame", true, true},
                                                     {".pc2", "point cache, for Blender, Maya and 3ds Max"},
                                                     {".obj", "mesh of the last frame", false, true},
                                                     {".ply", "mesh of the last frame, binary", false, true}};
    return lines;
}

bool is_image(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    return std::ranges::any_of(export_format_lines(),
                               [&](const ExportFormatLine& line) { return line.is_image && line.ending == ending; });
}

Result<std::unique_ptr<SimulatedExport>> SimulatedExport::start(const Document& document,
                                                                const SimulatedExportOptions& options) {
    const auto text = write_scene(document.scene);
    if (!text) return text.errors();
    std::error_code failed;
    std::unique_ptr<SimulatedExport> job(new SimulatedExport);
    job->options_ = options;
    job->scene_ = std::filesystem::temp_directory_path(failed) /
                  ("weft-export-" + std::to_string(::getpid()) + "-" + std::to_string(::random()) + ".json");
    auto written = write_atomically(job->scene_, [&](AtomicFile& out) { return out.write(*text); });
    if (!written) return written.errors();
    std::vector<std::string> arguments{options.program.empty() ? "/proc/self/exe" : options.program.string(),
                                       is_image(options.file) ? "render" : "run",
                                       job->scene_.string(),
                                       "--frames",
                                       std::to_string(options.frames),
                                       "--out",
                                       std::filesystem::absolute(options.file).string()};
    if (is_image(options.file)) add_image_arguments(options.images, arguments);
    auto child = ChildProcess::start(
        arguments, {.where = "export",
                    .environment = {{"WEFT_ASSETS", assets_with(document.folder)}, {"WEFT_PROGRESS", "frames"}},
                    .prints = true});
    if (!child) {
        std::filesystem::remove(job->scene_, failed);
        return child.errors();
    }
    job->child_.emplace(std::move(*child));
    return job;
}

SimulatedExport::~SimulatedExport() {
    cancel();
}

void SimulatedExport::cancel() {
    if (!child_) return;
    child_->end(time_to_clean_up);
    end();
    problem_ = "canceled";
}

void SimulatedExport::end() {
    std::error_code ignored;
    std::filesystem::remove(scene_, ignored);
    if (child_->succeeded()) {
        done_ = 1;
    } else {
        problem_ = last_problem(child_->messages());
        if (problem_.empty()) problem_ = child_->failure("has failed").what;
    }
    child_.reset();
}

// The process writes lines such as "frames 30/120  25.1 frames/s".
void SimulatedExport::update() {
    if (!child_) return;
    const bool runs = child_->running();
    const std::string& text = child_->messages();
    const std::string of_all = "/" + std::to_string(options_.frames) + " ";
    const std::size_t slash = text.rfind(of_all);
    if (slash != std::string::npos) {
        std::size_t from = slash;
        while (from > 0 && std::isdigit(static_cast<unsigned char>(text[from - 1]))) --from;
        done_ = static_cast<float>(std::atof(text.c_str() + from)) / static_cast<float>(options_.frames);
    }
    if (!runs) end();
}

}  // namespace weft::editor
