// What a format in pictures.def must implement, and helpers that the formats share.
#pragma once

#include "io/files/atomic_file.h"
#include "io/images/picture_writer.h"

#include <filesystem>
#include <memory>

namespace weft {

/// Writes one image to `file`. The caller has checked the image and commits the file.
using ImageWriter = Result<void> (*)(const Image8& picture, AtomicFile& file);

/// Makes a writer that puts all images into one file.
using PictureFilmMaker = std::unique_ptr<PictureWriter> (*)(const std::filesystem::path& path);

/// Makes the folder of `path`, and fails if the file cannot be written.
Result<void> prepare_place(const std::filesystem::path& path);

/// Fails if the image has another size than announced or too few pixels.
Result<void> check_picture(const Image8& picture, const PictureInfo& info, const std::filesystem::path& path);

}  // namespace weft
