// Times edits of a running cloth on one thread: other fabrics, other pins.
#include <weft/weft.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace weft;

struct Change {
    const char* name;
    const char* what;
    std::function<Result<void>(Simulation&, ClothId, int call)> make;
};

// Different values in every call.
FabricDesc fabric(int call, const char* preset = "cotton") {
    FabricDesc desc(preset);
    desc.set("drag", 1 + 0.001 * call);
    return desc;
}

std::vector<Change> all_changes(std::uint32_t side) {
    const auto set = [](auto&& describe) {
        return [describe](Simulation& simulation, ClothId cloth, int call) {
            return simulation.set_fabric(cloth, describe(call));
        };
    };
    const auto stiffness = [](int call) { return 3000.0 + 10 * call; };
    return {
        {"preset", "stretch, bend, density and all else: denim, silk, denim, ...",
         set([](int call) { return fabric(call, call % 2 == 0 ? "denim" : "silk"); })},
        {"stretch", "", set([=](int call) {
             return fabric(call).set("stretch", {stiffness(call), 4000.0});
         })},
        {"bend", "", set([](int call) {
             return fabric(call).set("bend", {1e-5 + 1e-7 * call, 9e-6, 7e-6});
         })},
        {"density", "", set([](int call) { return fabric(call).set("density", 0.15 + 0.001 * call); })},
        {"drag", "no number of any row", set([](int call) { return fabric(call); })},
        {"bend_model", "other rows: the model is built anew",
         set([](int call) { return fabric(call).set("bend_model", call % 2 == 0 ? "distance" : "dihedral"); })},
        {"set_pins", "one pin more or less",
         [side](Simulation& simulation, ClothId cloth, int call) {
             std::vector<std::uint32_t> vertices = {0, side - 1};
             if (call % 2 == 0) vertices.push_back(side / 2);
             return simulation.set_pins(cloth, {{.select = VertexPins{vertices}}});
         }},
        {"spring", "a pin that gives way, or none",
         [side](Simulation& simulation, ClothId cloth, int call) {
             std::vector<PinDesc> pins = {{.select = VertexPins{{0, side - 1}}}};
             if (call % 2 == 0) pins.push_back({.select = VertexPins{{side / 2}}, .compliance = 0.01f});
             return simulation.set_pins(cloth, pins);
         }},
    };
}

double ms_of(const std::function<Result<void>()>& run) {
    const auto begin = std::chrono::steady_clock::now();
    if (const auto done = run(); !done) {
        std::fprintf(stderr, "%s\n", done.error().message().c_str());
        std::exit(1);
    }
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

void measure(const Change& change, std::uint32_t side, int calls) {
    auto simulation = Simulation::create({}, {.backend = "cpu"});
    const auto cloth = simulation->add({.mesh = GridDesc{.size = {1, 1}, .resolution = {side, side}},
                                        .transform = {.rotation_degrees = {85, 0, 0}},
                                        .pins = {{.select = VertexPins{{0, side - 1}}}}});
    if (!cloth) std::exit(1);
    simulation->step();
    std::vector<double> change_ms, step_ms;
    for (int call = 0; call < calls; ++call) {
        change_ms.push_back(ms_of([&] { return change.make(*simulation, *cloth, call); }));
        // Steps in between, so that the caches are in the state of a stepping program.
        step_ms.push_back(ms_of([&] {
            simulation->step();
            return Result<void>();
        }));
    }
    const auto median_after_first = [](std::vector<double> all) {
        std::sort(all.begin() + 1, all.end());
        return all[1 + (all.size() - 1) / 2];
    };
    const auto [least, most] = std::minmax_element(change_ms.begin() + 1, change_ms.end());
    std::printf("%-12s %9.2f %9.2f %9.2f %9.2f %9.1f   %s\n", change.name, change_ms.front(),
                median_after_first(change_ms), *least, *most, median_after_first(step_ms), change.what);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    std::uint32_t side = 316;
    int calls = 21;
    std::string_view only;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        if (argument == "--quick") {
            side = 32, calls = 3;
        } else if (argument == "--only" && i + 1 < argc) {
            only = argv[++i];
        } else {
            std::fprintf(stderr, "usage: weft_bench_changes [--quick] [--only CHANGE]\n");
            return 64;
        }
    }
    std::printf("Changes of a sheet of %u x %u vertices while it runs, one thread, ms\n", side, side);
    std::printf("%-12s %9s %9s %9s %9s %9s\n", "change", "first", "median", "least", "most", "step");
    for (const Change& change : all_changes(side))
        if (only.empty() || only == change.name) measure(change, side, calls);
}
