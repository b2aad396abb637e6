// Video: images are piped to ffmpeg, which writes to an unnamed file. If a run ends early, even by a crash, no file is
// left behind. The file gets its name when it is complete.

#include "io/files/child_process.h"
#include "io/images/picture_format.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace fs = std::filesystem;
namespace {

std::string size_text(std::uint32_t width, std::uint32_t height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

// Rec. 709 colors, marked as such: players take an unmarked video of few lines for Rec. 601.
std::vector<std::string> command(const PictureInfo& info, const std::vector<std::string>& output) {
    char rate[32];
    std::snprintf(rate, sizeof rate, "%.7g", info.frame_rate);
    std::vector<std::string> words = {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error"};
    const auto add = [&](const std::vector<std::string>& more) { words.insert(words.end(), more.begin(), more.end()); };
    add({"-f", "rawvideo", "-pixel_format", "rgba", "-video_size", size_text(info.width, info.height)});
    add({"-framerate", rate, "-i", "pipe:0"});
    add({"-vf", "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,format=yuv420p"});
    // 18: hardly distinguishable from the source images.
    add({"-c:v", "libx264", "-preset", "medium", "-crf", "18"});
    add({"-color_range", "tv", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"});
    // No dates and versions: the same images give the same file on the same machine.
    add({"-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
    add(output);
    return words;
}

/// Whether the file is a sequence of complete boxes, one of which is the index.
bool is_whole(int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return false;
    const auto size = static_cast<std::uint64_t>(status.st_size);
    bool index = false;
    std::uint64_t at = 0;
    while (at < size) {
        unsigned char head[16] = {};  // size and name; then the size again, if it needs 64 bits
        if (::pread(descriptor, head, sizeof head, static_cast<off_t>(at)) < 8) return false;
        const auto number = [&](int from, int to) {
            std::uint64_t value = 0;
            for (int i = from; i < to; ++i) value = value << 8 | head[i];
            return value;
        };
        const bool large = number(0, 4) == 1;
        const std::uint64_t box = large ? number(8, 16) : number(0, 4);
        if (box < (large ? 16u : 8u) || box > size - at) return false;
        index = index || std::memcmp(head + 4, "moov", 4) == 0;
        at += box;
    }
    return index;
}

class Mp4Writer : public PictureWriter {
  public:
    explicit Mp4Writer(fs::path path) : path_(std::move(path)) {}

    Result<void> begin(const PictureInfo& info) override {
        info_ = info;
        const std::string where = path_.string();
        if (info.transparent)
            return Error{where, "a .mp4 has no transparency; write a sequence of .png instead, such as DIR/%04d.png"};
        if (info.width % 2 != 0 || info.height % 2 != 0)
            return Error{where, "the width and height of a .mp4 must be even, got " +
                                    size_text(info.width, info.height) + "; use " +
                                    size_text(info.width + info.width % 2, info.height + info.height % 2)};
        if (Result<void> placed = prepare_place(path_); !placed) return placed;
        if (Result<void> tried = try_out(); !tried) return tried;

        Result<BufferedFile> film = BufferedFile::open_nameless(folder_of(path_), where);
        if (!film) return film.errors();
        film_ = *std::move(film);
        // The index is moved to the front, so that the video plays before it is loaded completely.
        Result<ChildProcess> child =
            start({"-movflags", "+faststart", "-f", "mp4", "-y", "file:/proc/self/fd/3"}, film_.descriptor());
        if (!child) return child.errors();
        child_ = *std::move(child);
        return {};
    }

    Result<void> write(const Image8& picture) override {
        if (Result<void> checked = check_picture(picture, info_, path_); !checked) return checked;
        ++written_;
        return child_->write(std::as_bytes(std::span(picture.rgba)));
    }

    Result<void> finish() override {
        if (written_ == 0) return Error{path_.string(), "there is no image to write"};
        if (Result<void> finished = child_->finish(); !finished) return finished;
        // ffmpeg reports success even if the disk is full.
        if (!is_whole(film_.descriptor())) return child_->failure("has not written the complete video");
        return write_atomically(path_, [&](AtomicFile& file) { return film_.move_to(file.content()); });
    }

  private:
    Result<ChildProcess> start(const std::vector<std::string>& output, int descriptor) const {
        return ChildProcess::start(command(info_, output),
                                   {.where = path_.string(), .package = "ffmpeg", .output = descriptor});
    }

    /// Encodes one black image to the null output: only then ffmpeg reports a missing encoder or too little memory.
    Result<void> try_out() const {
        Result<ChildProcess> child = start({"-f", "null", "-"}, -1);
        if (!child) return child.errors();
        const std::vector<std::byte> row(std::size_t{info_.width} * 4);
        for (std::uint32_t y = 0; y < info_.height; ++y)
            if (Result<void> written = child->write(row); !written) return written;
        return child->finish();
    }

    fs::path path_;
    PictureInfo info_;
    BufferedFile film_;
    std::optional<ChildProcess> child_;
    std::uint64_t written_ = 0;
};

}  // namespace

std::unique_ptr<PictureWriter> make_mp4(const fs::path& path) {
    return std::make_unique<Mp4Writer>(path);
}

}  // namespace weft
