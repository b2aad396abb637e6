// Compiles volk, which loads the Vulkan library at run time.
#define VOLK_IMPLEMENTATION
#include <volk.h>
