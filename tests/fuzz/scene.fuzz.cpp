// Any bytes as a scene file: either a scene that passes its own checks, or errors that a user can read.
#include "io/scene_file.h"
#include "scene/check.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "scene fuzzer: %s\n", what);
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const weft::Result<weft::SceneDesc> scene =
        weft::parse_scene(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json");
    if (scene) {
        require(weft::check_scene(*scene).empty(), "a scene that was read does not pass its checks");
        require(!scene->cloths.empty(), "a scene without cloths was read");
        return 0;
    }
    require(!scene.errors().empty(), "refused without an error");
    for (const weft::Error& error : scene.errors()) {
        require(!error.what.empty(), "an error that says nothing");
        require(error.message().find('\n') == std::string::npos, "an error of several lines");
    }
    return 0;
}
