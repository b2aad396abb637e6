// Temporary use of volk's instance-level functions.
#pragma once

#include "gpu/device.h"

#include <mutex>

namespace weft::gpu {

/// During its lifetime, volk's variables hold the functions of the device's instance, and no other thread writes them.
/// Calls of functions that take a VkPhysicalDevice need one, because volk holds the functions of the last instance that
/// was made.
class BorrowedFunctions {
  public:
    explicit BorrowedFunctions(const Device& device) : lock_(lock_loader()) { device.instance().take_functions(); }

  private:
    std::unique_lock<std::recursive_mutex> lock_;
};

}  // namespace weft::gpu
