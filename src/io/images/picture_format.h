// What a format must offer to stand in pictures.def, and what the formats share.
#pragma once

#include "io/files/atomic_file.h"
#include "io/images/picture_writer.h"

#include <filesystem>
#include <memory>

namespace weft {

/// A format of one picture. The caller has checked the picture and commits the file.
using ImageWriter = Result<Done> (*)(const Image8& picture, AtomicFile& file);

/// A format that holds all pictures.
using PictureFilmMaker = std::unique_ptr<PictureWriter> (*)(const std::filesystem::path& path);

/// Makes the folder of `path`, and fails where the file cannot be written.
Result<Done> prepare_place(const std::filesystem::path& path);

/// Whether the picture is as large as was announced and has all its pixels.
Result<Done> check_picture(const Image8& picture, const PictureInfo& info, const std::filesystem::path& path);

}  // namespace weft
