// A camera in somebody's hands:
//
//   left button            around the target            right button   turns the eye, up to straight up and down
//   middle, shift + left   along with the picture       W S            up and down
//   wheel                  to the target and away       A D            left and right
//                                                       Q E            back and forth
#pragma once

#include "look/camera.h"
#include "render/window_input.h"

namespace weft::render {

/// Around the target: degrees to the right (seen from above, against the clock) and up.
Camera orbited(const Camera& camera, float right, float up);
/// Looks elsewhere from where it is; the target stays as far away.
Camera turned(const Camera& camera, float right, float up);
/// Eye and target, m along the picture's axes.
Camera moved(const Camera& camera, float right, float up, float forward);
/// By notches of a wheel: the distance to the target is a tenth less each.
Camera zoomed(const Camera& camera, float notches);

/// All of what hands did.
Camera steered(const Camera& camera, const WindowInput& input);

}  // namespace weft::render
