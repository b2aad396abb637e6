// The programs of README.md, word by word.
#include <weft/weft.h>

#include <iostream>
#include <span>

namespace {

// A renderer would draw from these arrays.
void draw(std::span<const weft::Vec3> positions, std::span<const weft::Vec3> normals) {
    std::cout << positions.size() << " positions, " << normals.size() << " normals\n";
}

int drape() {
    auto simulation = weft::Simulation::load("scenes/sheet_on_sphere.json", {.threads = 2});
    if (!simulation) return std::cerr << simulation.error().message() << '\n', 1;
    while (simulation->time() < 2) simulation->step();
    if (!simulation->save("drape.obj")) return 1;
    return 0;
}

int fly_a_flag() {
    auto world = weft::Simulation::create({.air = weft::AirDesc{.wind = {{.velocity = {7, 0, 1}}}}});
    auto flag = world->add({.mesh = weft::GridDesc{.size = {1.5f, 1}, .resolution = {60, 40}},  // or your TriangleMesh
                            .transform = {.rotation_degrees = {90, 0, 0}},
                            .fabric = weft::FabricDesc("silk").set("density", 0.08),
                            .pins = {{.select = weft::VertexPins{{0, 39 * 60}}}}});  // corners: vertex = iz * 60 + ix
    if (!flag) return std::cerr << flag.error().message() << '\n', 1;  // names the place of every wrong value
    world->step();
    draw(world->surface(*flag).positions, world->surface(*flag).normals);
    return 0;
}

}  // namespace

int main() {
    return drape() + fly_a_flag();
}
