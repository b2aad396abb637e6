// A file that appears under its name either complete or not at all.
#pragma once

#include "io/files/buffered_file.h"

#include <weft/result.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace weft {

/// Written under a temporary name in the folder of the target and renamed by commit(); until then an existing file
/// stays unchanged. Destroyed without commit(), it leaves nothing behind. Errors name the file and the reason.
class AtomicFile {
  public:
    /// Fails if no file can be created in that folder, or if `path` exists and is not a file.
    static Result<AtomicFile> create(const std::filesystem::path& path);

    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&& other) noexcept;
    ~AtomicFile();

    Result<void> write(std::span<const std::byte> bytes) { return content_.write(bytes); }
    Result<void> write(std::string_view text) { return content_.write(std::as_bytes(std::span(text))); }
    /// Syncs the content to the disk, so that only the rename can still fail. For files that must appear together:
    /// prepare all, then commit all.
    Result<void> prepare();
    /// Call it once, as the last call.
    Result<void> commit();

    const std::filesystem::path& path() const { return path_; }
    BufferedFile& content() { return content_; }

  private:
    AtomicFile(std::filesystem::path path, std::filesystem::path temporary, BufferedFile content);

    std::filesystem::path path_;
    std::filesystem::path temporary_;  // empty: renamed, or moved from
    bool prepared_ = false;
    BufferedFile content_;
};

/// Creates the file, calls `fill` to write it, and commits it unless `fill` fails.
Result<void> write_atomically(const std::filesystem::path& path, const std::function<Result<void>(AtomicFile&)>& fill);

/// Creates the folder of the file.
Result<void> make_folder_of(const std::filesystem::path& file);

/// The folder of a file; "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

}  // namespace weft
