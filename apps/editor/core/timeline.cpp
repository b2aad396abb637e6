#include "editor/core/timeline.h"

#include "io/files/buffered_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace weft::editor {
namespace {

std::uint64_t branch_of(std::uint64_t frame, const Lineage& lineage) {
    std::uint64_t number = 0;
    for (const Branch& branch : lineage)
        if (branch.after < frame || &branch == &lineage.front()) number = branch.number;
    return number;
}

/// A file without a name, which the system removes when it is closed.
std::FILE* nameless_file(const std::filesystem::path& folder, std::string& problem) {
    std::string name = (folder / "weft-frames-XXXXXX").string();
    const int descriptor = ::mkstemp(name.data());
    if (descriptor < 0) {
        problem = system_reason(errno);
        return nullptr;
    }
    ::unlink(name.c_str());
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    return ::fdopen(descriptor, "w+b");
}

}  // namespace

void Timeline::record(std::uint64_t frame, const Moment& moment) {
    Frame& one = frames_[frame];
    forget(one);
    one.branch = moment.lineage.empty() ? 0 : branch_of(frame, moment.lineage);
    one.moment = std::make_shared<Moment>(moment);
    memory_ += size_of(moment);
    make_room();
}

void Timeline::forget(Frame& frame) {
    if (!frame.moment) return;
    if (frame.size > 0) {
        free_.emplace(frame.size, frame.place);
        disk_ -= frame.size;
    }
    memory_ -= size_of(*frame.moment);
    frame = {};
}

// Frames leave the memory in their order, because a run records the newest ones.
void Timeline::make_room() {
    for (auto& [number, frame] : frames_) {
        if (memory_ <= options_.memory) return;
        if (frame.size == 0 && number > 0 && !disk_failed_) (void)write_to_disk(frame);
    }
    // Without the disk, frames are lost.
    for (auto it = frames_.begin(); it != frames_.end() && memory_ > options_.memory;) {
        if (it->first == 0 || it->second.size > 0 || std::next(it) == frames_.end()) {
            ++it;
            continue;
        }
        if (note_.empty()) note_ = "no room for all frames: the oldest ones are dropped";
        forget(it->second);
        it = frames_.erase(it);
    }
}

bool Timeline::write_to_disk(Frame& frame) {
    const auto failed = [&](const std::string& why) {
        disk_failed_ = true;
        note_ = "frames cannot be kept on disk (" + why + "): the oldest ones are dropped";
        return false;
    };
    if (!file_) {
        std::error_code ignored;
        const auto folder = options_.folder.empty() ? std::filesystem::temp_directory_path(ignored) : options_.folder;
        std::string problem;
        file_.reset(nameless_file(folder, problem));
        if (!file_) return failed(folder.string() + ": " + problem);
    }
    const std::vector<std::byte> bytes = to_bytes(frame.moment->world.moment.state);
    if (disk_ + bytes.size() > options_.disk) return failed("the limit is reached");
    std::uint64_t place = end_of_file_;
    const auto hole = free_.find(bytes.size());
    if (hole != free_.end()) place = hole->second;
    errno = 0;
    const bool written = ::fseeko(file_.get(), static_cast<off_t>(place), SEEK_SET) == 0 &&
                         std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size() &&
                         std::fflush(file_.get()) == 0;
    if (!written) return failed(system_reason(errno));
    if (hole != free_.end())
        free_.erase(hole);
    else
        end_of_file_ += bytes.size();
    memory_ -= size_of(*frame.moment);
    auto kept = std::make_shared<Moment>(*frame.moment);
    kept->world.moment.state = {};
    frame.moment = std::move(kept);
    memory_ += size_of(*frame.moment);
    frame.place = place;
    frame.size = bytes.size();
    disk_ += bytes.size();
    return true;
}

Result<MomentPtr> Timeline::moment_at(std::uint64_t number) const {
    const std::string name = "frame " + std::to_string(number);
    const auto found = frames_.find(number);
    if (found == frames_.end()) return Error{name, "is not recorded"};
    const Frame& frame = found->second;
    if (frame.size == 0) return MomentPtr(frame.moment);
    std::vector<std::byte> bytes(frame.size);
    errno = 0;
    if (::fseeko(file_.get(), static_cast<off_t>(frame.place), SEEK_SET) != 0 ||
        std::fread(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
        return Error::of_machine(name, "cannot be read back: " + system_reason(errno));
    auto snapshot = snapshot_from_bytes(bytes);
    if (!snapshot) return snapshot.errors();
    auto moment = std::make_shared<Moment>(*frame.moment);
    moment->world.moment.state = std::move(*snapshot);
    return MomentPtr(std::move(moment));
}

void Timeline::clear() {
    frames_.clear();
    free_.clear();
    memory_ = disk_ = 0;
    end_of_file_ = 0;
    file_.reset();
    disk_failed_ = false;
    note_.clear();
}

std::vector<FrameRange> Timeline::ranges(const Lineage& lineage, bool valid) const {
    std::vector<FrameRange> ranges;
    for (const auto& [number, frame] : frames_) {
        if ((frame.branch == branch_of(number, lineage)) != valid) continue;
        if (!ranges.empty() && ranges.back().last + 1 == number)
            ranges.back().last = number;
        else
            ranges.push_back({number, number});
    }
    return ranges;
}

std::vector<FrameRange> Timeline::valid(const Lineage& lineage) const {
    return ranges(lineage, true);
}
std::vector<FrameRange> Timeline::stale(const Lineage& lineage) const {
    return ranges(lineage, false);
}

}  // namespace weft::editor
