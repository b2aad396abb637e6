// A program outside of weft that uses <weft/vulkan.h>. It links no Vulkan loader.
#include <weft/vulkan.h>
#include <weft/weft.h>

#include <iostream>

int main() {
    const auto simulation = weft::Simulation::create({}, {.backend = "cpu"});
    const auto device = weft::vulkan_device(*simulation);
    const auto refused = weft::create_on({});
    if (device || refused) return 1;
    std::cout << device.error().message() << '\n' << refused.errors().size() << " problems\n";
}
