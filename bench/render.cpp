// Times drawing a sheet: milliseconds on the host's clock from submitting a frame to its completion, and CPU time of
// all threads. The sheet is static and on the device: nothing is simulated, uploaded or read back.

#include "gpu/commands.h"
#include "gpu/device.h"
#include "gpu/image.h"
#include "gpu_probes.h"
#include "mesh/procedural.h"
#include "render/host_mesh.h"
#include "render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace weft;
using Clock = std::chrono::steady_clock;

struct Options {
    std::string device;
    bool quick = false;
};

/// The number of frames and their size.
struct Frames {
    std::uint32_t width, height;
    unsigned warmup, runs, per_run;
};
constexpr Frames usual_frames{1280, 720, 3, 3, 5}, quick_frames{160, 90, 1, 2, 1};

constexpr std::uint32_t sides[] = {64, 256}, sample_counts[] = {1, 4};

// 1 m of cotton over the ground, in three folds.
constexpr float folds = 3, depth = 0.06f, height = 0.25f;

struct Sheet {
    TriangleMesh mesh;
    std::vector<Vec3> positions, normals;
    std::vector<Vec4> tangents;
};

Sheet make_sheet(std::uint32_t side) {
    Sheet sheet;
    sheet.mesh = make_grid({1, 1}, {side, side}, GridDiagonal::uniform);
    constexpr float turns = 2 * 3.14159265f * folds;
    for (const Vec3 p : sheet.mesh.positions) {
        const float slope = depth * turns * std::cos(turns * p.x);
        sheet.positions.push_back({p.x, height + depth * std::sin(turns * p.x), p.z});
        sheet.normals.push_back(normalized(Vec3{-slope, 1, 0}));
        const Vec3 along = normalized(Vec3{1, slope, 0});
        sheet.tangents.push_back({along.x, along.y, along.z, 1});
    }
    return sheet;
}

struct Line {
    double ms = 0, least = 0;
    double cpu_ms = 0;   ///< all threads; with a software driver this is the rendering itself
    double spread = 0;   ///< of the runs' medians, largest over smallest - 1
    double covered = 0;  ///< fraction of the image
};

/// Renders without ground to measure the covered fraction of the image.
Result<double> covered(render::Renderer& renderer, render::Drawing drawing, const Frames& frames) {
    drawing.background = render::Background::transparent;
    drawing.grounds = {};
    const auto picture = renderer.picture(drawing, frames.width, frames.height);
    if (!picture) return picture.errors();
    double alpha = 0;
    for (std::size_t i = 3; i < picture->rgba.size(); i += 4) alpha += picture->rgba[i] / 255.0;
    return alpha / (static_cast<double>(frames.width) * frames.height);
}

Result<Line> measure(render::Renderer& renderer, const render::Drawing& drawing, const Frames& frames) {
    gpu::Device& device = *renderer.device();
    const gpu::ImageDesc desc{.width = frames.width,
                              .height = frames.height,
                              .format = VK_FORMAT_R8G8B8A8_SRGB,
                              .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
    auto image = gpu::Image::create(device, desc, "target");
    if (!image) return image.errors();
    const render::Target target{image->view(), desc.format, frames.width, frames.height,
                                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    struct Took {
        double ms = 0, cpu_ms = 0;
    };
    const auto draw = [&]() -> Result<Took> {
        const auto begin = Clock::now();
        const std::clock_t cpu = std::clock();
        const auto drawn = renderer.draw(drawing, target);
        if (!drawn) return drawn.errors();
        if (auto done = device.wait(*drawn); !done) return done.errors();
        return Took{std::chrono::duration<double, std::milli>(Clock::now() - begin).count(),
                    1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
    };
    for (unsigned i = 0; i < frames.warmup; ++i)
        if (const auto warm = draw(); !warm) return warm.errors();
    std::vector<double> all, cpu, medians;
    for (unsigned run = 0; run < frames.runs; ++run) {
        std::vector<double> one;
        for (unsigned i = 0; i < frames.per_run; ++i) {
            const auto took = draw();
            if (!took) return took.errors();
            one.push_back(took->ms);
            cpu.push_back(took->cpu_ms);
        }
        all.insert(all.end(), one.begin(), one.end());
        medians.push_back(bench::median(std::move(one)));
    }
    const auto [low, high] = std::ranges::minmax(medians);
    const auto share = covered(renderer, drawing, frames);
    if (!share) return share.errors();
    return Line{bench::median(all), std::ranges::min(all), bench::median(cpu), high / low - 1, *share};
}

void print_head(const gpu::DeviceInfo& info, const Frames& frames) {
    std::printf("%s\n", gpu::describe(info).c_str());
    std::printf(
        "%u x %u, shadow map of %u^2, sun of 3 degrees, cotton and ground; %u frames after %u, in %u runs; host "
        "clock\n\n",
        frames.width, frames.height, render::shadow_map_side, frames.runs * frames.per_run, frames.warmup, frames.runs);
    std::printf("%-8s %7s %9s %9s %9s %9s %7s %9s\n", "sheet", "samples", "occlusion", "ms", "least ms", "CPU ms",
                "runs +%", "covers %");
}

Result<void> print_sheet(const std::shared_ptr<gpu::Device>& device, std::uint32_t side, std::uint32_t samples,
                         const Frames& frames) {
    auto renderer = render::Renderer::create(device, {.samples = samples});
    if (!renderer) return renderer.errors();
    const Sheet sheet = make_sheet(side);
    auto mesh = render::HostMesh::create(*device, static_cast<std::uint32_t>(sheet.positions.size()),
                                         sheet.mesh.triangles, sheet.mesh.uvs, {}, "sheet");
    if (!mesh) return mesh.errors();
    if (auto moved = mesh->update(sheet.positions, sheet.normals, sheet.tangents); !moved) return moved;
    const auto cotton = renderer->add(find_material("cotton")->material);
    if (!cotton) return cotton.errors();
    const auto floor = renderer->add(find_material("floor")->material);
    if (!floor) return floor.errors();
    render::Object object;
    object.surface = mesh->surface();
    object.material = *cotton;
    const render::Ground ground{.material = *floor};
    render::Drawing drawing;
    drawing.camera = {.position = {0.7f, 1, 1.3f}, .target = {0, 0.2f, 0}, .fov = 40};
    drawing.objects = {&object, 1};
    drawing.grounds = {&ground, 1};
    for (const float occlusion : {1.0f, 0.0f}) {
        drawing.lighting.ambient_occlusion = occlusion;
        const auto line = measure(*renderer, drawing, frames);
        if (!line) return line.errors();
        std::printf("%-8s %7u %9s %9.2f %9.2f %9.2f %7.1f %9.1f\n", (std::to_string(side) + "^2").c_str(), samples,
                    occlusion > 0 ? "on" : "off", line->ms, line->least, line->cpu_ms, line->spread * 100,
                    line->covered * 100);
        std::fflush(stdout);
    }
    return {};
}

Result<void> run(const Options& options) {
    auto instance = gpu::Instance::create();
    if (!instance) return instance.errors();
    const auto info = gpu::choose_device((*instance)->devices(), options.device, true);
    if (!info) return info.errors();
    const auto device = gpu::Device::create(*instance, *info);
    if (!device) return device.errors();
    const Frames& frames = options.quick ? quick_frames : usual_frames;
    print_head(*info, frames);
    for (const std::uint32_t side : sides)
        for (const std::uint32_t samples : sample_counts)
            if (auto printed = print_sheet(*device, side, samples, frames); !printed) return printed;
    return {};
}

constexpr const char* usage =
    "usage: weft_bench_render [--quick] [--device NAME]\n"
    "  --quick   few and small frames: whether it works, not how fast it is\n"
    "  --device  part of the device's name; without, the best GPU, or else a CPU that plays one\n";

// Nothing if the arguments are invalid.
std::optional<Options> parse(std::span<char* const> arguments) {
    Options options;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string_view argument = arguments[i];
        if (argument == "--quick") {
            options.quick = true;
        } else if (argument == "--device" && i + 1 < arguments.size()) {
            options.device = arguments[++i];
        } else {
            return std::nullopt;
        }
    }
    return options;
}

}  // namespace

int main(int argc, char** argv) {
    const auto options = parse(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
    if (!options) {
        std::fputs(usage, stderr);
        return 64;
    }
    const auto done = run(*options);
    if (done) return 0;
    std::fprintf(stderr, "weft_bench_render: %s\n", done.error().message().c_str());
    return 2;
}
