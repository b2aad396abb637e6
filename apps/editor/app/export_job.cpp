#include "editor/app/export_job.h"

#include "io/files/atomic_file.h"
#include "io/files/buffered_file.h"
#include "io/scenes/scene_writer.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
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

/// The environment with the folder of the scene among those in which files are searched.
std::vector<std::string> environment_with(const std::filesystem::path& folder) {
    std::vector<std::string> all;
    std::string assets = "WEFT_ASSETS=" + (folder.empty() ? "." : std::filesystem::absolute(folder).string());
    for (char** one = environ; *one; ++one) {
        const std::string text = *one;
        if (text.starts_with("WEFT_ASSETS="))
            assets += ":" + text.substr(12);
        else
            all.push_back(text);
    }
    all.push_back(assets);
    return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& text : texts) all.push_back(text.data());
    all.push_back(nullptr);
    return all;
}

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
    std::vector<std::string> environment = environment_with(document.folder);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return Error::of_machine("export", system_reason(errno));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    const int error = ::posix_spawn(&job.process_, arguments.front().c_str(), &actions, nullptr,
                                    pointers_to(arguments).data(), pointers_to(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    job.output_ = ends[0];
    if (error != 0) {
        job.process_ = 0;
        return Error::of_machine(arguments.front(), "cannot be started: " + system_reason(error));
    }
    ::fcntl(job.output_, F_SETFL, O_NONBLOCK);
    return job;
}

ExportJob::ExportJob(ExportJob&& other) noexcept {
    *this = std::move(other);
}
ExportJob& ExportJob::operator=(ExportJob&& other) noexcept {
    std::swap(options_, other.options_);
    std::swap(scene_, other.scene_);
    std::swap(process_, other.process_);
    std::swap(output_, other.output_);
    std::swap(text_, other.text_);
    std::swap(problem_, other.problem_);
    std::swap(done_, other.done_);
    return *this;
}

ExportJob::~ExportJob() {
    cancel();
    if (output_ >= 0) ::close(output_);
}

void ExportJob::cancel() {
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);
    int status = 0;
    ::waitpid(process_, &status, 0);
    end(status);
    problem_ = "canceled";
}

void ExportJob::end(int status) {
    process_ = 0;
    std::error_code ignored;
    std::filesystem::remove(scene_, ignored);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        done_ = 1;
        return;
    }
    problem_ = last_problem(text_);
    if (problem_.empty()) problem_ = "the export ended with status " + std::to_string(WEXITSTATUS(status));
}

// The process writes lines such as "frames 30/120  25.1 frames/s".
void ExportJob::update() {
    if (process_ <= 0) return;
    char buffer[4096];
    for (ssize_t got = 0; (got = ::read(output_, buffer, sizeof buffer)) > 0;)
        text_.append(buffer, static_cast<std::size_t>(got));
    const std::string of_all = "/" + std::to_string(options_.frames) + " ";
    const std::size_t slash = text_.rfind(of_all);
    if (slash != std::string::npos) {
        std::size_t from = slash;
        while (from > 0 && std::isdigit(static_cast<unsigned char>(text_[from - 1]))) --from;
        done_ = static_cast<float>(std::atof(text_.c_str() + from)) / static_cast<float>(options_.frames);
    }
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == process_) end(status);
}

}  // namespace weft::editor
