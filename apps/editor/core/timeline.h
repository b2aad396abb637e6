// Recorded frames: in memory within a budget, older ones in a temporary file.
#pragma once

#include "editor/core/moment.h"

#include <weft/result.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace weft::editor {

struct TimelineOptions {
    std::size_t memory = std::size_t{512} << 20;  ///< bytes
    std::size_t disk = std::size_t{4} << 30;      ///< bytes
    std::filesystem::path folder = {};            ///< of the temporary file; empty: the system's
};

/// A range of frames, both ends included.
struct FrameRange {
    std::uint64_t first = 0, last = 0;
    friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

/// If neither memory nor disk has room, the oldest recorded frames are dropped. Frame 0 stays.
class Timeline {
  public:
    explicit Timeline(TimelineOptions options = {}) : options_(std::move(options)) {}

    /// Records a frame in place of an earlier recording. `branch`: the last of the moment's lineage.
    void record(std::uint64_t frame, const Moment& moment);
    /// Fails if the frame is not recorded, or cannot be read back.
    Result<MomentPtr> moment_at(std::uint64_t frame) const;
    bool contains(std::uint64_t frame) const { return frames_.contains(frame); }
    /// The branch that the recorded frame belongs to. If it changes, the frame was recorded anew; 0: not recorded.
    std::uint64_t branch_at(std::uint64_t frame) const {
        const auto found = frames_.find(frame);
        return found == frames_.end() ? 0 : found->second.branch;
    }
    void clear();

    /// Recorded frames that a run with this lineage reached.
    std::vector<FrameRange> valid(const Lineage& lineage) const;
    /// Recorded frames that do not belong to it, because something changed before them.
    std::vector<FrameRange> stale(const Lineage& lineage) const;
    std::uint64_t last() const { return frames_.empty() ? 0 : frames_.rbegin()->first; }

    std::size_t bytes_in_memory() const { return memory_; }
    std::size_t bytes_on_disk() const { return disk_; }
    /// Why frames could not be kept; empty if all are.
    const std::string& note() const { return note_; }

  private:
    struct Frame {
        std::uint64_t branch = 0;
        std::shared_ptr<Moment> moment;     ///< its snapshot is empty if it is on disk
        std::uint64_t place = 0, size = 0;  ///< of the snapshot in the file; size 0: in memory
    };
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::vector<FrameRange> ranges(const Lineage& lineage, bool valid) const;
    void make_room();
    bool write_to_disk(Frame& frame);
    void forget(Frame& frame);

    TimelineOptions options_;
    std::map<std::uint64_t, Frame> frames_;
    std::size_t memory_ = 0, disk_ = 0;
    std::uint64_t end_of_file_ = 0;
    std::multimap<std::uint64_t, std::uint64_t> free_;  ///< places in the file by size, of frames that were replaced
    std::unique_ptr<std::FILE, Closer> file_;           ///< has no name, so nothing is left after a crash
    bool disk_failed_ = false;
    std::string note_;
};

}  // namespace weft::editor
