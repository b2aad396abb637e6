// Small images of scenes. They are rendered by `weft render` beside the program, one after another, and kept in the
// folder for caches. Nothing here waits.
#pragma once

#include "base/image.h"
#include "io/files/child_process.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

class Thumbnails {
  public:
    struct Options {
        std::filesystem::path folder = {};   ///< of the cache; empty or not writable: images last as long as this
        std::filesystem::path program = {};  ///< empty: this program
        std::uint32_t width = 240, height = 150;
        std::uint32_t frames = 40;
        std::chrono::seconds patience{90};  ///< for one image
    };
    Thumbnails(std::vector<std::filesystem::path> scenes, Options options);
    ~Thumbnails();
    Thumbnails(const Thumbnails&) = delete;
    Thumbnails& operator=(const Thumbnails&) = delete;

    /// Reads at most one image, or starts the next process if none runs. Call it again while it returns true.
    bool update();

    enum class State : std::uint8_t { waiting, rendering, ready, failed };
    State state(std::size_t scene) const { return all_[scene].state; }
    /// Once it is ready.
    const Image8& image(std::size_t scene) const { return all_[scene].image; }

  private:
    struct One {
        std::filesystem::path scene, file;  ///< empty file: the scene cannot be read
        State state = State::waiting;
        bool looked = false;  ///< for the file
        Image8 image = {};
    };
    bool load(One& one);
    void start(One& one);
    void finish_child();

    Options options_;
    std::vector<One> all_;
    std::filesystem::path temporary_;  ///< where images are rendered to
    std::optional<ChildProcess> child_;
    std::size_t rendered_ = 0;  ///< by the child
    std::chrono::steady_clock::time_point since_;
};

/// The name of a scene's image in the cache: it changes with the content of the scene and with the program.
std::string thumbnail_name(const std::filesystem::path& scene, std::uint32_t width, std::uint32_t height);

}  // namespace weft::editor
