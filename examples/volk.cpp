// volk's own code, once: it finds the Vulkan loader when the program runs.
#define VOLK_IMPLEMENTATION
#include <volk.h>
