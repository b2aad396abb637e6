// Writes images to files: one interface for all formats, which are chosen by the ending of the file name.
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
    double frame_rate = 60;           ///< images per second of a video
    std::uint64_t picture_count = 0;  ///< images that will be written
    bool transparent = false;         ///< keep the alpha channel
};

/// Call begin(), then write() once per image, then finish(). A file gets its final name only in finish(), the files of
/// a sequence as soon as their image is complete. A writer destroyed before finish() leaves nothing behind, except the
/// complete files of a sequence. After an error a writer can only be destroyed.
class PictureWriter {
  public:
    virtual ~PictureWriter() = default;
    /// Called before long operations. Makes the folder. Fails if the format cannot hold the announced images, if the
    /// file cannot be written, or if a program that the format needs is not installed.
    virtual Result<void> begin(const PictureInfo& info) = 0;
    /// The image must have the announced size.
    virtual Result<void> write(const Image8& picture) = 0;
    virtual Result<void> finish() = 0;
    /// Whether only the last image is kept, so that the caller need not render the others.
    virtual bool keeps_last_only() const { return false; }
};

/// The ending of `path` selects the format: `.png` (the last image) or `.mp4` (video). A `%d` or `%0Nd` in the file
/// name selects a sequence, numbered from 0 (`pictures/%04d.png`). Fails on an unknown ending.
Result<std::unique_ptr<PictureWriter>> make_picture_writer(const std::filesystem::path& path);

struct PictureFormat {
    std::string_view ending;  ///< including the dot
    std::string_view what;
};
std::span<const PictureFormat> picture_formats();

}  // namespace weft
