// Loads a scene, simulates two seconds, saves the last frame.
#include <weft/weft.h>

#include <iostream>

int main(int argc, char** argv) {
    auto simulation = weft::Simulation::load(argc > 1 ? argv[1] : "scenes/sheet_on_sphere.json", {.threads = 2});
    if (!simulation) return std::cerr << simulation.error().message() << '\n', 1;
    while (simulation->time() < 2) simulation->step();
    std::cout << simulation->cloth(0).positions.size() << " vertices, state " << simulation->state_hash() << '\n';
    return simulation->save("drape.obj") ? 0 : 1;
}
