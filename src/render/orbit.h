// A camera that mouse and keys move:
//
//   left button            orbits around the target     right button   turns the eye, up to straight up and down
//   middle, shift + left   pans with the image          W S            up and down
//   wheel                  to the target and away       A D            left and right
//                                                       Q E            back and forth
#pragma once

#include "look/camera.h"
#include "render/window_input.h"

namespace weft::render {

/// Orbits around the target, in degrees to the right (counterclockwise from above) and up.
Camera orbited(const Camera& camera, float right, float up);
/// Turns the view at the same position; keeps the distance of the target.
Camera turned(const Camera& camera, float right, float up);
/// Moves eye and target along the image's axes, in m.
Camera moved(const Camera& camera, float right, float up, float forward);
/// Each notch of the wheel reduces the distance to the target by a tenth.
Camera zoomed(const Camera& camera, float notches);

/// Applies all user input.
Camera steered(const Camera& camera, const WindowInput& input);

}  // namespace weft::render
