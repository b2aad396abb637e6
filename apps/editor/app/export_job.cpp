#include "editor/app/export_job.h"

#include "io/files/atomic_file.h"
#include "io/scenes/scene_writer.h"

#include <unistd.h>

#include <cctype>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace weft::editor {
namespace {

bool is_image(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".png" || ending == ".mp4";
}

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

/// For a program that has to remove files that are not complete.
constexpr std::chrono::seconds time_to_clean_up{10};

}  // namespace

const std::vector<std::string>& export_endings() {
    static const std::vector<std::string> endings{".glb", ".mp4", ".png", ".pc2", ".obj", ".ply"};
    return endings;
}

Result<ExportJob> ExportJob::start(const Document& document, const ExportOptions& options) {
    const auto text = write_scene(document.scene);
    if (!text) return text.errors();
    std::error_code failed;
    ExportJob job;
    job.options_ = options;
    job.scene_ = std::filesystem::temp_directory_path(failed) /
                 ("weft-export-" + std::to_string(::getpid()) + "-" + std::to_string(::random()) + ".json");
    auto written = write_atomically(job.scene_, [&](AtomicFile& out) { return out.write(*text); });
    if (!written) return written.errors();
    std::vector<std::string> arguments{options.program.empty() ? "/proc/self/exe" : options.program.string(),
                                       is_image(options.file) ? "render" : "run",
                                       job.scene_.string(),
                                       "--frames",
                                       std::to_string(options.frames),
                                       "--out",
                                       std::filesystem::absolute(options.file).string()};
    auto child = ChildProcess::start(
        arguments, {.where = "export", .environment = {{"WEFT_ASSETS", assets_with(document.folder)}}, .prints = true});
    if (!child) {
        std::filesystem::remove(job.scene_, failed);
        return child.errors();
    }
    job.child_.emplace(std::move(*child));
    return job;
}

ExportJob::ExportJob(ExportJob&& other) noexcept {
    *this = std::move(other);
}
ExportJob& ExportJob::operator=(ExportJob&& other) noexcept {
    std::swap(options_, other.options_);
    std::swap(scene_, other.scene_);
    std::swap(child_, other.child_);
    std::swap(problem_, other.problem_);
    std::swap(done_, other.done_);
    return *this;
}

ExportJob::~ExportJob() {
    cancel();
}

void ExportJob::cancel() {
    if (!child_) return;
    child_->end(time_to_clean_up);
    end();
    problem_ = "canceled";
}

void ExportJob::end() {
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
void ExportJob::update() {
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
