#include "io/images/picture_writer.h"

#include "io/exports/export_format.h"
#include "io/files/file_pattern.h"
#include "io/images/picture_format.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

namespace weft {
namespace fs = std::filesystem;

#define WEFT_PICTURE(name, ending, what) Result<void> write_##name(const Image8& picture, AtomicFile& file);
#define WEFT_FILM(name, ending, what) std::unique_ptr<PictureWriter> make_##name(const fs::path& path);
#include "io/images/pictures.def"
#undef WEFT_PICTURE
#undef WEFT_FILM

namespace {

struct Makers {
    ImageWriter picture = nullptr;
    PictureFilmMaker film = nullptr;
};

constexpr std::array formats = {
#define WEFT_PICTURE(name, ending, what) PictureFormat{ending, what},
#define WEFT_FILM(name, ending, what) PictureFormat{ending, what},
#include "io/images/pictures.def"
#undef WEFT_PICTURE
#undef WEFT_FILM
};

constexpr std::array<Makers, formats.size()> makers = {{
#define WEFT_PICTURE(name, ending, what) {.picture = write_##name},
#define WEFT_FILM(name, ending, what) {.film = make_##name},
#include "io/images/pictures.def"
#undef WEFT_PICTURE
#undef WEFT_FILM
}};

Result<void> write_one(ImageWriter writer, const Image8& picture, const fs::path& path) {
    return write_atomically(path, [&](AtomicFile& file) { return writer(picture, file); });
}

/// Keeps the newest image and writes it in finish(), because the last image is not known earlier.
class LastPicture : public PictureWriter {
  public:
    LastPicture(ImageWriter writer, fs::path path) : writer_(writer), path_(std::move(path)) {}

    Result<void> begin(const PictureInfo& info) override {
        info_ = info;
        return prepare_place(path_);
    }
    Result<void> write(const Image8& picture) override {
        last_ = picture;
        return check_picture(picture, info_, path_);
    }
    Result<void> finish() override {
        if (!last_) return Error{path_.string(), "there is no image to write"};
        return write_one(writer_, *last_, path_);
    }
    bool keeps_last_only() const override { return true; }

  private:
    ImageWriter writer_;
    fs::path path_;
    PictureInfo info_;
    std::optional<Image8> last_;
};

class PictureSequence : public PictureWriter {
  public:
    PictureSequence(ImageWriter writer, const fs::path& path, FilePattern pattern)
        : writer_(writer), folder_(folder_of(path)), pattern_(std::move(pattern)) {}

    Result<void> begin(const PictureInfo& info) override {
        info_ = info;
        return prepare_place(next());
    }
    Result<void> write(const Image8& picture) override {
        if (Result<void> checked = check_picture(picture, info_, next()); !checked) return checked;
        if (Result<void> written = write_one(writer_, picture, next()); !written) return written;
        ++number_;
        return {};
    }
    Result<void> finish() override { return {}; }

  private:
    fs::path next() const { return folder_ / pattern_.name(number_); }

    ImageWriter writer_;
    fs::path folder_;
    FilePattern pattern_;
    PictureInfo info_;
    std::uint64_t number_ = 0;
};

}  // namespace

std::span<const PictureFormat> picture_formats() {
    return formats;
}

Result<void> prepare_place(const fs::path& path) {
    if (Result<void> made = make_folder_of(path); !made) return made;
    return check_writable(path);
}

Result<void> check_picture(const Image8& picture, const PictureInfo& info, const fs::path& path) {
    const bool whole = picture.rgba.size() == std::size_t{picture.width} * picture.height * 4;
    if (picture.width == info.width && picture.height == info.height && !picture.rgba.empty() && whole) return {};
    const auto size = [](std::uint32_t width, std::uint32_t height) {
        return std::to_string(width) + "x" + std::to_string(height);
    };
    return Error{path.string(), "the image has " + size(picture.width, picture.height) + " pixels and " +
                                    std::to_string(picture.rgba.size()) + " bytes, but its announced size is " +
                                    size(info.width, info.height)};
}

Result<std::unique_ptr<PictureWriter>> make_picture_writer(const fs::path& path) {
    const std::string ending = ending_of(path);
    const auto format = std::ranges::find(formats, ending, &PictureFormat::ending);
    if (format == formats.end()) return unknown_ending(path, "images are written as " + list_endings(formats));
    const Makers& maker = makers[static_cast<std::size_t>(format - formats.begin())];

    std::unique_ptr<PictureWriter> writer;
    if (has_pattern(path)) {
        std::optional<FilePattern> pattern = parse_pattern(path.filename().string());
        if (!pattern) return Error{path.string(), pattern_rule};
        if (!maker.picture)
            return Error{path.string(),
                         "a " + ending + " holds all images in one file, so its name must not contain a '%'"};
        writer = std::make_unique<PictureSequence>(maker.picture, path, *std::move(pattern));
    } else if (maker.film) {
        writer = maker.film(path);
    } else {
        writer = std::make_unique<LastPicture>(maker.picture, path);
    }
    return writer;
}

}  // namespace weft
