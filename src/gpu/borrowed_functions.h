// volk's functions that need no device, for a moment.
#pragma once

#include "gpu/device.h"

#include <mutex>

namespace weft::gpu {

/// While it lives, volk's variables are those of the device's instance, and no other thread writes them. Whoever calls
/// a function that takes a VkPhysicalDevice needs one: the last instance that was made may be another one.
class BorrowedFunctions {
  public:
    explicit BorrowedFunctions(const Device& device) : lock_(lock_loader()) { device.instance().take_functions(); }

  private:
    std::unique_lock<std::recursive_mutex> lock_;
};

}  // namespace weft::gpu
