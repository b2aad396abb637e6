// A file that appears under its name whole or not at all.
#pragma once

#include "io/files/buffered_file.h"

#include <weft/result.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace weft {

/// Written under a temporary name in the folder of its own and renamed by commit(); an earlier file of that name stays
/// as it is until then. Destroyed without commit, it leaves nothing behind. Errors name the file and the reason.
class AtomicFile {
  public:
    /// Fails where a file cannot be created in that folder, or where `path` is something else than a file.
    static Result<AtomicFile> create(const std::filesystem::path& path);

    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&& other) noexcept;
    ~AtomicFile();

    Result<Done> write(std::span<const std::byte> bytes) { return content_.write(bytes); }
    Result<Done> write(std::string_view text) { return content_.write(std::as_bytes(std::span(text))); }
    /// Puts all of it on the disk, so that nothing but the renaming is left to fail. For files that must appear
    /// together: prepare all, then commit all.
    Result<Done> prepare();
    /// Once, as the last call.
    Result<Done> commit();

    const std::filesystem::path& path() const { return path_; }
    BufferedFile& content() { return content_; }

  private:
    AtomicFile(std::filesystem::path path, std::filesystem::path temporary, BufferedFile content);

    std::filesystem::path path_;
    std::filesystem::path temporary_;  // empty: renamed, or moved from
    bool prepared_ = false;
    BufferedFile content_;
};

/// Makes the file, lets `fill` write it, and commits it unless that fails.
Result<Done> write_atomically(const std::filesystem::path& path, const std::function<Result<Done>(AtomicFile&)>& fill);

/// Makes the folder that the file is going to be in.
Result<Done> make_folder_of(const std::filesystem::path& file);

/// The folder a file is in, "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& file);

}  // namespace weft
