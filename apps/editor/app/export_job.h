// Exports that run beside the editor.
#pragma once

#include "editor/core/document.h"
#include "io/files/child_process.h"
#include "look/camera.h"

#include <weft/result.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

/// An export that has begun. The functions return at once.
class ExportJob {
  public:
    virtual ~ExportJob() = default;
    ExportJob(const ExportJob&) = delete;
    ExportJob& operator=(const ExportJob&) = delete;

    /// Looks how far it is.
    virtual void update() = 0;
    virtual bool running() const = 0;
    virtual float done() const = 0;  ///< 0…1; below 0: not known yet
    /// Stops it soon. Files that are not complete do not appear.
    virtual void cancel() = 0;
    /// After the end: empty if the file is there; else why not.
    virtual const std::string& problem() const = 0;
    virtual const std::filesystem::path& file() const = 0;

  protected:
    ExportJob() = default;
};

/// How images and videos are drawn.
struct ImageOptions {
    std::uint32_t width = 1280, height = 720;  ///< pixels
    double frames_per_second = 0;              ///< of a video; 0: those of the scene
    std::optional<Camera> camera = {};
    std::vector<std::string> overlays = {};  ///< names of view/overlays.h
};

struct SimulatedExportOptions {
    std::filesystem::path file;  ///< its ending says the format
    std::uint64_t frames = 120;
    ImageOptions images = {};
    std::filesystem::path program = {};  ///< empty: this program
};

/// Simulates a copy of the scene from its first frame: `weft run` or `weft render` as a process of its own.
class SimulatedExport final : public ExportJob {
  public:
    /// Writes a copy of the scene and starts the process.
    static Result<std::unique_ptr<SimulatedExport>> start(const Document& document,
                                                          const SimulatedExportOptions& options);
    /// Cancels it if it still runs.
    ~SimulatedExport() override;

    void update() override;
    bool running() const override { return child_.has_value(); }
    float done() const override { return done_; }
    void cancel() override;
    const std::string& problem() const override { return problem_; }
    const std::filesystem::path& file() const override { return options_.file; }

  private:
    SimulatedExport() = default;
    void end();

    SimulatedExportOptions options_;
    std::filesystem::path scene_;  ///< the copy
    std::optional<ChildProcess> child_;
    std::string problem_;
    float done_ = -1;
};

struct ExportFormatLine {
    std::string_view ending;  ///< `.glb`
    std::string_view what;    ///< one line for the user
    bool is_image = false;
    bool is_still = false;  ///< only the last frame
};
/// The files that can be exported. The first one is the usual choice.
const std::vector<ExportFormatLine>& export_format_lines();
/// Whether the ending of the file is that of an image or a video.
bool is_image(const std::filesystem::path& file);

}  // namespace weft::editor
