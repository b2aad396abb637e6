// A program outside of weft that uses the installed package.
#include <weft/weft.h>

#include <iostream>

int main(int argc, char** argv) {
    if (argc != 2) return std::cerr << "usage: outside SCENE\n", 2;
    auto simulation = weft::Simulation::load(argv[1], {.threads = 2});
    if (!simulation) return std::cerr << simulation.error().message() << '\n', 1;
    while (simulation->frame() < 10) simulation->step();
    std::cout << weft::version() << ": " << simulation->cloth(0).positions.size() << " vertices, state "
              << simulation->state_hash() << '\n';
}
