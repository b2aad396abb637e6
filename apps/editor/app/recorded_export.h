// Exports the frames that the timeline has recorded, with everything that was done by hand.
#pragma once

#include "editor/app/export_job.h"
#include "editor/core/simulator.h"

#include <memory>
#include <string>
#include <vector>

namespace weft::editor {

struct RecordedExportOptions {
    std::filesystem::path file;  ///< its ending says the format
    FrameRange frames = {};      ///< all of them must be recorded
    ImageOptions images = {};
    std::vector<std::string> hidden = {};  ///< names of cloths and colliders that images do not show
};

/// Works on a thread of its own, in a world of its own, and takes one frame after another from the timeline. Nothing is
/// simulated: positions are those of the recorded frames, to the bit. Fails if a frame is recorded anew meanwhile.
class RecordedExport final : public ExportJob {
  public:
    /// Keeps the simulator alive until the end.
    RecordedExport(std::shared_ptr<Simulator> simulator, RecordedExportOptions options);
    /// Cancels it, and waits for the frame in work.
    ~RecordedExport() override;

    void update() override;
    bool running() const override;
    float done() const override;
    void cancel() override;
    const std::string& problem() const override { return problem_; }
    const std::filesystem::path& file() const override;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    std::string problem_;
};

/// The recorded frames that lead to the present without a gap, and those that follow it.
FrameRange frames_to_export(const Published& now);

}  // namespace weft::editor
