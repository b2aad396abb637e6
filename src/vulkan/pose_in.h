// Poses as shaders read them.
#pragma once

#include "base/transform.h"
#include "vulkan/args.data.h"

namespace weft::vulkan {

inline PoseIn pose_in(const Pose& pose) {
    const auto column = [](Vec3 v) { return Vec4{v.x, v.y, v.z, 0}; };
    return {column(pose.rotation.x), column(pose.rotation.y), column(pose.rotation.z), column(pose.position)};
}

}  // namespace weft::vulkan
