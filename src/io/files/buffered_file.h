// A file written from front to back through a buffer. Every failure is checked and reported.
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
    /// Takes over an open descriptor. `name` is the name in error messages.
    BufferedFile(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
    BufferedFile(BufferedFile&& other) noexcept;
    BufferedFile& operator=(BufferedFile&& other) noexcept;
    ~BufferedFile();

    /// Opens an unnamed file in `folder`, so that even a crash leaves nothing behind. `name` is the name in error
    /// messages.
    static Result<BufferedFile> open_nameless(const std::filesystem::path& folder, std::string name);

    Result<void> write(std::span<const std::byte> bytes);
    Result<void> flush();
    /// When it returns, the bytes are on the disk, not only in the system's cache.
    Result<void> sync_and_close();
    /// For another process that writes to the file instead, before anything is written here.
    int descriptor() const { return descriptor_; }
    /// Reads the next bytes from the front, and frees their blocks where the file system supports this: then the bytes
    /// that are written elsewhere take little more space. Nothing can be written here afterwards.
    Result<void> take(std::span<std::byte> bytes);
    /// Takes the whole content and appends it to `target`.
    Result<void> move_to(BufferedFile& target);

    /// Bytes written so far, including those in the buffer.
    std::uint64_t size() const { return size_; }

  private:
    Result<void> write_through(std::span<const std::byte> bytes);
    Error failure(const char* action, int error_number) const;

    int descriptor_ = -1;
    std::string name_;
    std::vector<std::byte> buffer_;
    std::uint64_t size_ = 0;
    std::uint64_t taken_ = 0, freed_ = 0;  ///< bytes from the front
};

/// The system's text for an errno, such as "No space left on device".
std::string system_reason(int error_number);

}  // namespace weft
