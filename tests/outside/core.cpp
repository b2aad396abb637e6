// A program outside of weft that links weft::core, without file formats.
#include <weft/weft.h>

#include <iostream>

int main() {
    auto simulation = weft::Simulation::create({}, {.backend = "cpu"});
    if (!simulation) return std::cerr << simulation.error().message() << '\n', 1;
    const auto sheet = simulation->add({.mesh = weft::GridDesc{.resolution = {16, 16}}, .fabric = "silk"});
    const auto file = simulation->add({.mesh = weft::MeshFileDesc{.file = "shirt.obj"}});
    if (!sheet || file) return 1;
    while (simulation->frame() < 10) simulation->step();
    std::cout << simulation->surface(*sheet).positions.size() << " vertices\n" << file.error().message() << '\n';
}
