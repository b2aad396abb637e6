#include "editor/app/thumbnails.h"

#include "base/hash.h"
#include "io/images/image_file.h"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace weft::editor {

std::string thumbnail_name(const std::filesystem::path& scene, std::uint32_t width, std::uint32_t height) {
    std::ifstream in(scene, std::ios::binary);
    if (!in) return {};
    StateHash hash;
    for (std::istreambuf_iterator<char> at(in), end; at != end; ++at)
        hash.add(static_cast<std::uint32_t>(static_cast<unsigned char>(*at)));
    for (const char letter : std::string_view(WEFT_VERSION)) hash.add(static_cast<std::uint32_t>(letter));
    hash.add(width), hash.add(height);
    return scene.stem().string() + "-" + hash.text() + ".png";
}

Thumbnails::Thumbnails(std::vector<std::filesystem::path> scenes, Options options) : options_(std::move(options)) {
    std::error_code failed;
    if (!options_.folder.empty()) std::filesystem::create_directories(options_.folder, failed);
    // Images are moved into the cache once they are complete. Without write access to it they stay here.
    const bool writable = !options_.folder.empty() && ::access(options_.folder.c_str(), W_OK) == 0;
    const auto folder = writable ? options_.folder : std::filesystem::temp_directory_path(failed);
    temporary_ = folder / ("weft-thumbnail-" + std::to_string(::getpid()) + ".png");
    if (!writable) options_.folder.clear();
    for (std::filesystem::path& scene : scenes) {
        One one{.scene = std::move(scene), .file = {}};
        const std::string name = thumbnail_name(one.scene, options_.width, options_.height);
        if (name.empty())
            one.state = State::failed;
        else
            one.file = options_.folder.empty() ? std::filesystem::path() : options_.folder / name;
        all_.push_back(std::move(one));
    }
}

Thumbnails::~Thumbnails() {
    child_.reset();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

bool Thumbnails::load(One& one) {
    one.looked = true;
    std::error_code ignored;
    if (one.file.empty() || !std::filesystem::exists(one.file, ignored)) return false;
    auto image = read_image(one.file);
    if (!image) return false;  // damaged: it is made again
    one.image = std::move(*image);
    one.state = State::ready;
    return true;
}

void Thumbnails::start(One& one) {
    auto child = ChildProcess::start({options_.program.empty() ? "/proc/self/exe" : options_.program.string(), "render",
                                      one.scene.string(), "--frames", std::to_string(options_.frames), "--size",
                                      std::to_string(options_.width) + "x" + std::to_string(options_.height),
                                      "--threads", "1", "--quiet", "--out", temporary_.string()},
                                     {.where = "thumbnail"});
    if (!child) {
        one.state = State::failed;
        return;
    }
    child_.emplace(std::move(*child));
    since_ = std::chrono::steady_clock::now();
    one.state = State::rendering;
}

void Thumbnails::finish_child() {
    One& one = all_[rendered_];
    one.state = State::failed;
    auto image = child_->succeeded() ? read_image(temporary_) : Result<Image8>(Error{"", "was not rendered"});
    child_.reset();
    std::error_code failed;
    if (image) {
        one.image = std::move(*image);
        one.state = State::ready;
        if (!one.file.empty()) std::filesystem::rename(temporary_, one.file, failed);
    }
    std::filesystem::remove(temporary_, failed);
}

bool Thumbnails::update() {
    // What is on disk comes first, one image per call.
    for (One& one : all_)
        if (one.state == State::waiting && !one.looked && load(one)) return true;
    if (child_) {
        if (!child_->running())
            finish_child();
        else if (std::chrono::steady_clock::now() - since_ > options_.patience)
            child_->end(std::chrono::milliseconds(0)), finish_child();
        return true;
    }
    for (rendered_ = 0; rendered_ < all_.size(); ++rendered_) {
        if (all_[rendered_].state != State::waiting) continue;
        start(all_[rendered_]);
        return true;
    }
    return false;
}

}  // namespace weft::editor
