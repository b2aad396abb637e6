// volk's own code, once: it finds the Vulkan loader at run time.
#define VOLK_IMPLEMENTATION
#include <volk.h>
