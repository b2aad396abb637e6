// A rigid object in one frame, as exporters read it.
#pragma once

#include "base/transform.h"
#include "look/material.h"

#include <weft/mesh.h>

#include <string_view>

namespace weft {

/// A collider in one frame.
struct DrawnSolid {
    std::string_view name;
    const TriangleMesh* mesh = nullptr;  ///< in its own frame, m, with normals; objects of one shape share it
    Pose pose;                           ///< m
    const Material* material = nullptr;  ///< nullptr: light gray, matte
};

}  // namespace weft
