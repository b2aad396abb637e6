// Changes a world while it runs: a moved collider lifts a cloth by a pin, the pin is removed, a saved state restored.
#include <weft/weft.h>

#include <iostream>

int main() {
    auto world = weft::Simulation::create();
    const auto hand = *world->add(weft::ColliderDesc{.name = "hand", .shape = weft::SphereDesc{0.03f}});
    const auto cloth = *world->add({.mesh = weft::GridDesc{.size = {0.5f, 0.5f}, .resolution = {32, 32}},
                                    .pins = {{.select = weft::VertexPins{{0}}, .attach = "hand"}}});
    for (int frame = 1; frame <= 60; ++frame) {
        if (!world->move(hand, {0, 0.01f * static_cast<float>(frame), 0})) return 1;  // 60 cm up in a second
        world->step();
    }
    const auto corner = [&] { return world->surface(cloth).positions[0].y; };
    const auto state = world->save_state();
    std::cout << "lifted:   corner at " << corner() << " m\n";
    if (!world->set_pins(cloth, {})) return 1;
    while (world->time() < 1.25) world->step();
    std::cout << "let go:   corner at " << corner() << " m\n";
    if (!world->restore_state(state)) return 1;
    std::cout << "restored: corner at " << corner() << " m\n";
}
