#include "io/files/buffered_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace weft {
namespace {

// Large enough to make the cost of system calls negligible, small enough for one per open file.
constexpr std::size_t buffer_size = 1 << 20;

}  // namespace

std::string system_reason(int error_number) {
    return std::generic_category().message(error_number);
}

BufferedFile::BufferedFile(BufferedFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      name_(std::move(other.name_)),
      buffer_(std::move(other.buffer_)),
      size_(std::exchange(other.size_, 0)),
      taken_(std::exchange(other.taken_, 0)),
      freed_(std::exchange(other.freed_, 0)) {}

BufferedFile& BufferedFile::operator=(BufferedFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(name_, other.name_);
    std::swap(buffer_, other.buffer_);
    std::swap(size_, other.size_);
    std::swap(taken_, other.taken_);
    std::swap(freed_, other.freed_);
    return *this;
}

BufferedFile::~BufferedFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Result<BufferedFile> BufferedFile::open_nameless(const std::filesystem::path& folder, std::string name) {
    int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == ENOENT)) {
        // O_TMPFILE is missing in some file systems (network shares, some overlays) and in old kernels.
        std::string pattern = (folder / ".weft-XXXXXX").string();
        descriptor = ::mkostemp(pattern.data(), O_CLOEXEC);
        if (descriptor >= 0) ::unlink(pattern.c_str());
    }
    if (descriptor < 0) return Error{std::move(name), "cannot be written: " + system_reason(errno)};
    return BufferedFile(descriptor, std::move(name));
}

Error BufferedFile::failure(const char* action, int error_number) const {
    return Error{name_, std::string("cannot be ") + action + ": " + system_reason(error_number)};
}

Result<void> BufferedFile::write(std::span<const std::byte> bytes) {
    size_ += bytes.size();
    if (buffer_.size() + bytes.size() > buffer_size) {
        if (Result<void> flushed = flush(); !flushed) return flushed;
        if (bytes.size() > buffer_size) return write_through(bytes);
    }
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    return {};
}

Result<void> BufferedFile::flush() {
    Result<void> written = write_through(buffer_);
    buffer_.clear();
    return written;
}

Result<void> BufferedFile::write_through(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return failure("written", errno);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
}

Result<void> BufferedFile::sync_and_close() {
    if (Result<void> flushed = flush(); !flushed) return flushed;
    // Special files that cannot be synced return EINVAL.
    if (::fsync(descriptor_) != 0 && errno != EINVAL) return failure("written", errno);
    if (::close(std::exchange(descriptor_, -1)) != 0) return failure("closed", errno);
    return {};
}

Result<void> BufferedFile::take(std::span<std::byte> bytes) {
    if (Result<void> flushed = flush(); !flushed) return flushed;
    while (!bytes.empty()) {
        const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(taken_));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return failure("read back", errno);
        if (count == 0) return failure("read back", EIO);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
        taken_ += static_cast<std::uint64_t>(count);
    }
    if (taken_ - freed_ < buffer_size) return {};
    // May fail on file systems without holes: then the space is freed when the file is closed. Only whole blocks are
    // freed, so the last one, which may be taken in part, is left to the next call.
    (void)::fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(freed_),
                      static_cast<off_t>(taken_ - freed_));
    freed_ = taken_ - taken_ % buffer_size;
    return {};
}

Result<void> BufferedFile::move_to(BufferedFile& target) {
    if (Result<void> flushed = flush(); !flushed) return flushed;
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) return failure("read back", errno);
    const auto size = static_cast<std::uint64_t>(status.st_size);
    std::vector<std::byte> block(buffer_size);
    while (taken_ < size) {
        const auto next = std::span(block).first(std::min<std::size_t>(block.size(), size - taken_));
        if (Result<void> taken = take(next); !taken) return taken;
        if (Result<void> written = target.write(next); !written) return written;
    }
    return {};
}

}  // namespace weft
