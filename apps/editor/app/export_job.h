// An export that runs beside the editor: `weft run` or `weft render` on a copy of the scene, as a process of its own.
#pragma once

#include "editor/core/document.h"
#include "io/files/child_process.h"

#include <weft/result.h>

#include <filesystem>
#include <optional>
#include <string>

namespace weft::editor {

struct ExportOptions {
    std::filesystem::path file;  ///< its ending says the format
    std::uint64_t frames = 120;
    std::filesystem::path program = {};  ///< empty: this program
};

class ExportJob {
  public:
    /// Writes a copy of the scene and starts the process.
    static Result<ExportJob> start(const Document& document, const ExportOptions& options);
    ExportJob(ExportJob&& other) noexcept;
    ExportJob& operator=(ExportJob&& other) noexcept;
    /// Cancels it if it still runs.
    ~ExportJob();

    /// Looks how far it is. Never waits.
    void update();
    bool running() const { return child_.has_value(); }
    float done() const { return done_; }  ///< 0…1; below 0: not known yet
    /// Stops it. Files that are not complete do not appear.
    void cancel();
    /// After the end: empty if the file is there; else why not.
    const std::string& problem() const { return problem_; }
    const std::filesystem::path& file() const { return options_.file; }

  private:
    ExportJob() = default;
    void end();

    ExportOptions options_;
    std::filesystem::path scene_;  ///< the copy
    std::optional<ChildProcess> child_;
    std::string problem_;
    float done_ = -1;
};

/// Endings of files that `weft run` and `weft render` write.
const std::vector<std::string>& export_endings();

}  // namespace weft::editor
