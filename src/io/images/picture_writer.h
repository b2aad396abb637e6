// Pictures onto the disk: one interface for every format, chosen by a file name's ending.
#pragma once

#include "base/image.h"

#include <weft/result.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace weft {

struct PictureInfo {
    std::uint32_t width = 0, height = 0;
    double frame_rate = 60;           ///< pictures a second of a film
    std::uint64_t picture_count = 0;  ///< that will be written
    bool transparent = false;         ///< alpha counts
};

/// begin, then write once per picture, then finish. Nothing appears under the final name before finish (a sequence:
/// before its picture is whole); a writer destroyed early leaves nothing behind, a sequence its whole pictures. After
/// an error a writer is only good for being destroyed.
class PictureWriter {
  public:
    virtual ~PictureWriter() = default;
    /// Before anything that takes long. Makes the folder. Fails where the format cannot hold what is announced, where
    /// the file cannot be written, and where what the format needs is not installed.
    virtual Result<Done> begin(const PictureInfo& info) = 0;
    /// As large as was announced.
    virtual Result<Done> write(const Image8& picture) = 0;
    virtual Result<Done> finish() = 0;
    /// Of the pictures it keeps the last alone; nobody need make the others.
    virtual bool last_alone() const { return false; }
};

/// By the ending of `path`: `.png` (the last picture), `.mp4` (film), or a sequence, numbered from 0, where the file
/// name holds one `%d` or `%0Nd` (`pictures/%04d.png`). Fails on an unknown ending.
Result<std::unique_ptr<PictureWriter>> make_picture_writer(const std::filesystem::path& path);

struct PictureFormat {
    std::string_view ending;  ///< with the dot
    std::string_view what;
};
std::span<const PictureFormat> picture_formats();

}  // namespace weft
