// Cuts a hanging sheet where a blade passes, and counts the vertices that a program draws.
#include <weft/weft.h>

#include <iostream>

int main() {
    auto world = weft::Simulation::create();
    const auto sheet = *world->add({.mesh = weft::GridDesc{.size = {1, 1}, .resolution = {41, 41}},
                                    .transform = {.position = {0, 1, 0}, .rotation_degrees = {90, 0, 0}},
                                    .pins = {{.select = weft::BoxPins{{{-1, 1.49f, -1}, {1, 2, 1}}}}},
                                    .tearing = weft::Tearing::cuts});
    for (int frame = 0; frame < 30; ++frame) world->step();
    const auto report = [&](const char* what) {
        std::cout << what << ": " << world->surface(sheet).positions.size() << " vertices\n";
    };
    report("whole");
    // A blade passes from left to right at a height of 1.2 m, and stops before the right hem.
    const weft::CutDesc slash{.along = weft::PathCut{{{-0.6f, 1.2f, 0}, {0.3f, 1.2f, 0}}}};
    if (auto done = world->cut(sheet, slash); !done) {
        std::cerr << done.error().message() << '\n';
        return 1;
    }
    report("cut");
    for (int frame = 0; frame < 60; ++frame) world->step();
    std::cout << "the lower left corner hangs at " << world->surface(sheet).positions[40 * 41].y << " m\n";
}
