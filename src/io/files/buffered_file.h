// A file that is written front to back through a buffer, with every failure checked and named.
#pragma once

#include <weft/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace weft {

class BufferedFile {
  public:
    BufferedFile() = default;
    /// Takes over an open descriptor. Errors name `name`.
    BufferedFile(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
    BufferedFile(BufferedFile&& other) noexcept;
    BufferedFile& operator=(BufferedFile&& other) noexcept;
    ~BufferedFile();

    /// A file in `folder` that has no name there, so that not even a crash leaves it behind. Errors name `name`.
    static Result<BufferedFile> open_nameless(const std::filesystem::path& folder, std::string name);

    Result<Done> write(std::span<const std::byte> bytes);
    Result<Done> flush();
    /// On return the bytes are on the disk, not only in the system's cache.
    Result<Done> sync_and_close();
    /// For another process to write to in its stead, before anything is written here.
    int descriptor() const { return descriptor_; }
    /// Appends all that the file holds to `target`, and frees each block here once it is there: where the file system
    /// can do that, the two together never take much more space than one. Good for nothing afterwards.
    Result<Done> move_to(BufferedFile& target);

    /// Bytes written so far, those still in the buffer included.
    std::uint64_t size() const { return size_; }

  private:
    Result<Done> write_through(std::span<const std::byte> bytes);
    Error failure(const char* action, int error_number) const;

    int descriptor_ = -1;
    std::string name_;
    std::vector<std::byte> buffer_;
    std::uint64_t size_ = 0;
};

/// "No space left on device": what the system calls an errno.
std::string system_reason(int error_number);

}  // namespace weft
