#include "io/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <utility>

namespace weft {
namespace fs = std::filesystem;
namespace {

// Short, so that it fits even for a name near the system's limit; process id and counter make it unique.
fs::path temporary_name(const fs::path& folder) {
    static std::atomic<std::uint64_t> count{0};
    return folder / (".weft-" + std::to_string(::getpid()) + "-" + std::to_string(count++) + ".tmp");
}

// A rename is durable once the folder itself is on the disk. Some file systems cannot sync a folder; then only this
// guarantee is missing.
void sync_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    (void)::fsync(descriptor);
    ::close(descriptor);
}

// Renaming onto a link would replace the link instead of the file that it points to.
fs::path behind_links(const fs::path& path) {
    std::error_code error;
    if (!fs::is_symlink(path, error)) return path;
    fs::path real = fs::canonical(path, error);
    return error ? path : real;
}

}  // namespace

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

AtomicFile::AtomicFile(fs::path path, fs::path temporary, BufferedFile content)
    : path_(std::move(path)), temporary_(std::move(temporary)), content_(std::move(content)) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      prepared_(other.prepared_),
      content_(std::move(other.content_)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(temporary_, other.temporary_);
    std::swap(prepared_, other.prepared_);
    std::swap(content_, other.content_);
    return *this;
}

AtomicFile::~AtomicFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Result<AtomicFile> AtomicFile::create(const fs::path& path) {
    const fs::path target = behind_links(path);
    std::error_code ignored;
    const fs::file_status status = fs::status(target, ignored);
    if (fs::is_directory(status)) return Error{path.string(), "cannot be written: it is a folder"};
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        return Error{path.string(), "cannot be written: it is not a regular file"};
    }
    int descriptor = -1;
    fs::path temporary;
    do {  // an existing name is left from a killed process with the same id
        temporary = temporary_name(folder_of(target));
        descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor < 0 && (errno == EEXIST || errno == EINTR));
    if (descriptor < 0) return Error{path.string(), "cannot be written: " + system_reason(errno)};
    return AtomicFile(target, std::move(temporary), BufferedFile(descriptor, path.string()));
}

Result<void> AtomicFile::prepare() {
    if (Result<void> closed = content_.sync_and_close(); !closed) return closed;
    prepared_ = true;
    return {};
}

Result<void> AtomicFile::commit() {
    if (!prepared_) {
        if (Result<void> prepared = prepare(); !prepared) return prepared;
    }
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) {
        return Error{path_.string(), "cannot be written: " + system_reason(errno)};
    }
    temporary_.clear();
    sync_folder(folder_of(path_));
    return {};
}

Result<void> write_atomically(const fs::path& path, const std::function<Result<void>(AtomicFile&)>& fill) {
    Result<AtomicFile> file = AtomicFile::create(path);
    if (!file) return file.errors();
    if (Result<void> filled = fill(*file); !filled) return filled;
    return file->commit();
}

Result<void> make_folder_of(const fs::path& file) {
    std::error_code error;
    fs::create_directories(folder_of(file), error);
    if (error) return Error{file.string(), "its folder cannot be made: " + error.message()};
    return {};
}

}  // namespace weft
