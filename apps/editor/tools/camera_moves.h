// The editor's camera: orbit, pan, dolly, look around, fly, frame and views along axes. The image's up direction never
// flips: the tilt is limited to just below 90° up and down. Values that are not finite change nothing.
#pragma once

#include "editor/tools/projection.h"
#include "look/camera.h"
#include "render/window_input.h"

#include <weft/bounds.h>

#include <optional>

namespace weft::editor {

/// `usual`: W S forward and back, A D left and right, Q E down and up.
/// `source`: W S up and down, A D left and right, Q E back and forth.
enum class FlyKeys { usual, source };

/// Orbits around the target as the pointer moves by `by` pixels: the scene turns with the pointer, half a turn over the
/// height of the view.
Camera orbited_by(const Camera& camera, Vec2 by, Vec2 view_size);
/// Turns the eye: the view follows the pointer, half a turn over the height of the view. Up to straight up and down.
Camera looked_by(const Camera& camera, Vec2 by, Vec2 view_size);
/// Moves the camera in the plane of the image. A point at that depth (m) stays under the pointer; by default the depth
/// of the target.
Camera panned_by(const Camera& camera, Vec2 by, Vec2 view_size, std::optional<double> depth = std::nullopt);
/// Each notch brings the eye nearer to what is under the pointer by a tenth of its distance, and the pointer stays on
/// it. `under`: the point that is there; else a point as far away as the target.
Camera dollied(const Camera& camera, float notches, Vec2 pointer, Vec2 view_size, std::optional<Vec3> under = {});

struct FlyInput {
    FlyKeys map = FlyKeys::usual;
    render::Keys held;
    bool fast = false;       ///< Shift: four times as fast
    float seconds = 0;       ///< since the last call; the way does not depend on how many calls make up a time
    float scene_radius = 0;  ///< m
};
/// Flies along the image's axes. The speed is the distance to the target per second, and at least a quarter of the
/// scene's radius.
Camera flown(const Camera& camera, const FlyInput& input);
/// Whether a key of the map is held, so that the view has to be drawn again.
bool flies(const FlyInput& input);

/// Shows a box as a whole, from the same direction. The camera stays where it is if the box is empty or not finite.
Camera framed(const Camera& camera, const Bounds& box, Vec2 view_size);

/// The side from which the camera looks at its target.
enum class ViewFrom { right, left, top, bottom, front, back };  // +x, -x, +y, -y, +z, -z
/// At the same distance. Above and below, -z and +z point up in the image.
Camera seen_from(const Camera& camera, ViewFrom side);

/// Between two cameras: 0 is `from` and 1 is `to`, exactly. Starts and ends slowly. Turns by the shorter way, and the
/// image's up direction does not flip on it.
Camera camera_between(const Camera& from, const Camera& to, float fraction);

/// A short way from one camera to another.
struct CameraTransition {
    Camera from, to;
    float duration = 0.25f;  ///< s
    Camera at(float seconds) const { return camera_between(from, to, duration > 0 ? seconds / duration : 1); }
    bool done(float seconds) const { return !(seconds < duration); }
};

}  // namespace weft::editor
