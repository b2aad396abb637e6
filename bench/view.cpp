// Times images of a scene as an editor makes them: from copies of its frame, by size and samples.
//
//     weft_bench_view SCENE.json|SIDE [IMAGES] [FRAMES]
//
// SIDE: a square cloth of so many particles per side over a ball. Each image shows another frame and another camera.

#include "files/open_scene.h"
#include "view/scene_view.h"
#include "weft/drawing_device.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace weft;

double ms_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

std::filesystem::path scene_of(const std::string& name) {
    const int side = std::atoi(name.c_str());
    if (side < 2) return name;
    const auto file = std::filesystem::temp_directory_path() / ("weft_view_" + name + ".json");
    std::ofstream(file)
        << R"({ "weft": 1, "cloths": [{ "name": "cloth", "mesh": { "grid": { "size": [1, 1], "resolution": [)" << side
        << ", " << side << R"(] } }, "transform": { "position": [0, 0.62, 0] }, "fabric": "silk" }],
        "colliders": [{ "name": "ball", "sphere": { "radius": 0.25 }, "transform": { "position": [0, 0.3, 0] } },
                      { "name": "ground", "plane": {} }] })";
    return file;
}

int fail(const Errors& errors) {
    for (const Error& error : errors) std::printf("%s\n", error.message().c_str());
    return 1;
}

int run(const std::string& name, int images, int frames) {
    Options options;
    options.backend = "cpu";
    auto session = open_scene(scene_of(name), options);
    if (!session) return fail(session.errors());
    for (int i = 0; i < frames; ++i) session->advance();
    const auto device = drawing_device(session->world(), "");
    if (!device) return fail(device.errors());

    WorldFrameCopies copies;
    std::vector<std::shared_ptr<const WorldFrameCopy>> shown;
    std::vector<double> copy_ms, mesh_ms;
    for (int i = 0; i < images; ++i) {
        session->advance();
        (void)session->world().frame();
        const auto begin = std::chrono::steady_clock::now();
        auto copy = copies.copy(session->world());
        copy_ms.push_back(ms_since(begin));
        const auto mesh = std::chrono::steady_clock::now();
        for (const ClothFrame& cloth : copy->frame().cloths) (void)cloth.tangents();
        mesh_ms.push_back(ms_since(mesh));
        if (shown.size() < 4) shown.push_back(std::move(copy));
    }
    std::printf("%s on %s: copy %.2f ms, render mesh and tangents %.2f ms\n", name.c_str(),
                (*device)->info().name.c_str(), median(copy_ms), median(mesh_ms));
    for (const std::uint32_t samples : {0u, 1u, 4u}) {  // 0: a draft
        for (const std::uint32_t percent : {100u, 70u, 50u, 35u, 25u}) {
            const ViewOptions view_options{.width = 1280 * percent / 100,
                                           .height = 720 * percent / 100,
                                           .samples = std::max(1u, samples),
                                           .draft = samples == 0,
                                           .overlays = {}};
            auto view = SceneView::create(*device, session->scene(), *shown[0], view_options);
            if (!view) return fail(view.errors());
            const Camera camera = view->camera(session->scene(), *shown[0]);
            std::vector<double> ms, cpu_ms;
            for (int i = 0; i < images; ++i) {
                const auto begin = std::chrono::steady_clock::now();
                const std::clock_t cpu_begin = std::clock();
                const auto image = view->picture(session->scene(), *shown[static_cast<std::size_t>(i) % shown.size()],
                                                 orbited(camera, static_cast<float>(i)));
                if (!image) return fail(image.errors());
                ms.push_back(ms_since(begin));
                cpu_ms.push_back(1000.0 * static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC);
            }
            std::printf("  %s, %3u %%: %6.1f ms, %6.1f ms of processor time\n",
                        samples == 0   ? "draft"
                        : samples == 1 ? "1 sample"
                                       : "4 samples",
                        percent, median(ms), median(cpu_ms));
            std::fflush(stdout);
        }
    }
    return 0;
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        std::printf("usage: weft_bench_view SCENE.json|SIDE [IMAGES] [FRAMES]\n");
        return 2;
    }
    return run(arguments[1], count > 2 ? std::max(2, std::atoi(arguments[2])) : 20,
               count > 3 ? std::atoi(arguments[3]) : 60);
}
