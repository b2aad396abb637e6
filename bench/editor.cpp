// Times what the editor adds to a simulation: keeping frames, undo, redo, jumps and changes of values, without a
// window.
//
//   weft_bench_editor [SIDE] [REPEATS]     a hung sheet of SIDE² particles of cotton, 128 by default
#include "editor/core/stage.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace weft;
using namespace weft::editor;

double ms_of(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

void report(const char* what, std::vector<double> ms) {
    std::ranges::sort(ms);
    std::printf("%-34s median %8.3f ms   worst %8.3f ms\n", what, ms[ms.size() / 2], ms.back());
}

void must(const Result<void>& done) {
    if (done) return;
    std::fprintf(stderr, "weft_bench_editor: %s\n", done.error().message().c_str());
    std::exit(1);
}

DocumentPtr sheet(unsigned side) {
    const Json json{{"weft", 1},
                    {"cloths",
                     {{{"name", "sheet"},
                       {"mesh", {{"grid", {{"size", {1, 1}}, {"resolution", {side, side}}}}}},
                       {"tearing", "cuts"},
                       {"pins", {{{"vertices", {0, side - 1}}}}}}}},
                    {"colliders", {{{"name", "ball"}, {"sphere", {{"radius", 0.2}}}}}}};
    auto document = make_document(json, {}, {});
    if (!document) must(document.errors());
    return *document;
}

editor::Stage open(const DocumentPtr& document, bool record) {
    auto stage = editor::Stage::open(document, {.simulation = {.backend = "cpu"}, .record = record});
    if (!stage) must(stage.errors());
    return std::move(*stage);
}

ChangeScene change(const char* place, Json value) {
    return {.label = place, .edits = {{place, std::move(value)}}};
}

}  // namespace

int main(int argc, char** argv) {
    const unsigned side = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 128;
    const int repeats = argc > 2 ? std::max(1, std::atoi(argv[2])) : 40;
    const DocumentPtr document = sheet(std::max(4u, side));
    editor::Stage plain = open(document, false), stage = open(document, true);
    for (int i = 0; i < 20; ++i) must(plain.step()), must(stage.step());

    std::vector<double> without, with;
    for (int i = 0; i < repeats; ++i) {
        without.push_back(ms_of([&] { must(plain.step()); }));
        with.push_back(ms_of([&] { must(stage.step()); }));
    }
    std::printf("%u x %u particles, one thread, %d repeats\n", side, side, repeats);
    report("step", without);
    report("step, recorded", with);

    const std::pair<const char*, ChangeScene> changes[] = {
        {"density", change("/cloths/0/fabric/density", 0.3)},
        {"stretch stiffness", change("/cloths/0/fabric/stretch", Json{3000, 3000})},
        {"pins", change("/cloths/0/pins", Json{{{"vertices", {0}}}})},
        {"wind", change("/air", Json{{"wind", {{{"velocity", {2, 0, 0}}}}}})},
        {"collider", change("/colliders/0/transform/position", Json{0.1, 0, 0})},
        {"substeps", change("/solver/substeps", 24)},
        {"mesh", change("/cloths/0/mesh/grid/size", Json{1, 1.1})}};
    for (const auto& [name, action] : changes) {
        std::vector<double> doing, undoing, redoing;
        for (int i = 0; i < repeats; ++i) {
            doing.push_back(ms_of([&] { must(stage.apply(action)); }));
            must(stage.step());
            undoing.push_back(ms_of([&] { must(stage.apply(Undo{})); }));
            redoing.push_back(ms_of([&] { must(stage.apply(Redo{})); }));
            must(stage.apply(Undo{}));
        }
        report((std::string("change of ") + name).c_str(), doing);
        report((std::string("  undo of ") + name).c_str(), undoing);
        report((std::string("  redo of ") + name).c_str(), redoing);
    }
    std::vector<double> seeks;
    for (int i = 0; i < repeats; ++i)
        seeks.push_back(ms_of([&] { must(stage.apply(Seek{static_cast<std::uint64_t>(1 + i % 20)})); }));
    report("jump to a recorded frame", seeks);
}
