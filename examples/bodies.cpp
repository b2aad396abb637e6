// A ball that falls into a sheet, is pushed, and is put elsewhere.
#include <weft/weft.h>

#include <iostream>

int main() {
    auto world = weft::Simulation::create({.air = weft::AirDesc{}});
    if (!world->add({.mesh = weft::GridDesc{.size = {1, 1}, .resolution = {33, 33}},
                     .transform = {.position = {0, 1, 0}},
                     .pins = {{.select = weft::VertexPins{{0, 32, 1056, 1088}}}}}))
        return 1;
    const auto ball = world->add(weft::ColliderDesc{.name = "ball",
                                                    .shape = weft::SphereDesc{.radius = 0.1f},
                                                    .transform = {.position = {0, 1.2f, 0}},
                                                    .body = weft::BodyDesc{.mass = 0.5f, .spin_damping = 1}});
    if (!ball) {
        std::cerr << ball.error().message() << '\n';
        return 1;
    }
    for (int frame = 0; frame < 240; ++frame) world->step();
    std::cout << "in the sheet: y = " << world->body(*ball)->position.y << " m\n";

    // 1 N·s at its center: 2 m/s upward.
    const weft::BodyMotion motion = *world->body(*ball);
    if (!world->push(*ball, {0, 1, 0}, motion.center)) return 1;
    world->step();
    std::cout << "pushed: " << world->body(*ball)->velocity.y << " m/s\n";

    if (!world->place_body(*ball, {0, 3, 0}, {}, {1, 0, 0})) return 1;
    world->step();
    std::cout << "thrown: x = " << world->body(*ball)->position.x << " m\n";
}
