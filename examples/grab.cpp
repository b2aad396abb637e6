// Pulls a hanging cloth at a point, as a game's mouse does, and lets it go.
#include <weft/weft.h>

#include <cmath>
#include <iostream>

int main() {
    auto world = weft::Simulation::create({.air = weft::AirDesc{}});
    const auto cloth = *world->add({.mesh = weft::GridDesc{.size = {1, 1}, .resolution = {33, 33}},
                                    .transform = {.position = {0, 1.5f, 0}, .rotation_degrees = {90, 0, 0}},
                                    .pins = {{.select = weft::VertexPins{{0, 32}}}}});
    // The triangle under the mouse and the point in it. The target starts at the point and follows the mouse.
    const weft::MeshPoint point{.triangle = 1056, .weights = {0.3f, 0.3f, 0.4f}};
    auto grab = world->grab(cloth, point, {0, 1.5f, 0}, {.max_force = 10});
    if (!grab) {
        std::cerr << grab.error().message() << '\n';
        return 1;
    }
    for (int frame = 1; frame <= 60; ++frame) {
        const weft::Vec3 mouse{0, 1.5f, 0.3f * std::sin(0.05f * static_cast<float>(frame))};
        if (!world->move_grab(*grab, mouse)) return 1;  // the triangle is gone
        world->step();
    }
    const weft::Vec3 place = world->grab_position(*grab), force = world->grab_force(*grab);
    std::cout << "pulled to z = " << place.z << " m with " << std::hypot(force.x, force.y, force.z) << " N\n";
    if (!world->release(*grab)) return 1;
    for (int frame = 0; frame < 300; ++frame) world->step();
    std::cout << "let go: " << world->measure().max_speed << " m/s after five seconds\n";
}
