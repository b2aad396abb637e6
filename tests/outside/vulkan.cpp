// Somebody else's program that knows Vulkan's headers, and needs no loader to be linked.
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
