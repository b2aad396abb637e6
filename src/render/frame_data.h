// Converts a Drawing into the data that shaders read.
#pragma once

#include "render/drawing.h"
#include "render/environment.h"
#include "render/shading/frame.data.h"

namespace weft::render {

struct FrameShape {
    std::uint32_t width = 1, height = 1;
    glm::vec2 jitter{0, 0};    ///< pixels by which the image is shifted
    std::uint32_t number = 0;  ///< of the sample; seeds the noise
    bool has_environment = false;
};

shading::FrameData frame_data(const Drawing& drawing, const Surroundings& around, const FrameShape& shape);
shading::ObjectData object_data(const Object& object);
/// A square of the ground plane around the camera's target.
shading::ObjectData ground_data(const Ground& ground, const Camera& camera);

/// Evenly distributed offsets in a pixel, each in -0.5…0.5.
glm::vec2 jitter_of(std::uint32_t number, std::uint32_t count);

}  // namespace weft::render
