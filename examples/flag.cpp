// Builds a flag in the wind from numbers in the program, and saves every tenth frame.
#include <weft/weft.h>

#include <iostream>

int main() {
    auto world = weft::Simulation::create(
        {.air = weft::AirDesc{.wind = {{.velocity = {7, 0, 1}, .gust = {.amplitude = 0.3f}}}}});
    auto flag = world->add({.mesh = weft::GridDesc{.size = {1.5f, 1}, .resolution = {60, 40}},
                            .transform = {.rotation_degrees = {90, 0, 0}},
                            .fabric = weft::FabricDesc("silk").set("stretch", {4000, 4000}),
                            .pins = {{.select = weft::BoxPins{{{-0.76f, -1, -1}, {-0.74f, 1, 1}}}}}});
    if (!flag) return std::cerr << flag.error().message() << '\n', 1;
    for (int frame = 1; frame <= 60; ++frame) {
        world->step();
        if (frame % 10 == 0 && !world->save("flag_" + std::to_string(frame) + ".obj")) return 1;
    }
    std::cout << "stretched by " << 100 * world->measure().mean_stretch << " % in the mean\n";
}
