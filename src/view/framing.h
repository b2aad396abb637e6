// A camera for scenes without one. It frames all cloths and colliders, and follows them.
#pragma once

#include "look/camera.h"
#include "view/world_frame.h"

#include <weft/bounds.h>

namespace weft {

/// A ball that a camera keeps in view.
struct Ball {
    Vec3 center;       ///< m
    float radius = 0;  ///< m
};

/// The part of a world that a camera should show, at the last frame.
struct Subject {
    Ball cloths;  ///< around all particles: these must be in view
    Ball all;     ///< around the cloths and nearby parts of colliders
};

/// Reads the frame of a live world back to the host. Colliders count only within the cloths' bounding box, enlarged by
/// its diagonal on all sides. So colliders far from the cloths are ignored, and large ones count in part. Without
/// cloths, all colliders except planes count.
Subject subject_of(const WorldFrame& world);
inline Subject subject_of(const World& world) {
    return subject_of(LiveWorldFrame(world));
}

/// A camera in front of the ball, slightly to the right and above, that shows the whole ball. `aspect`: width over
/// height of the image.
Camera framing(const Ball& ball, float aspect);

/// Follows a subject smoothly from one image to the next:
///
///  * It aims at a ball slightly larger than the subject. It moves the aim only as far as needed to keep the subject in
///    that ball. A flag that flutters within it does not move the camera.
///  * A critically damped spring, which also uses the speed of the aim, moves the camera to the aim. It does not
///    oscillate, and lags behind free fall by at most g/omega², 0.15 m.
///  * The cloths are always in view: if the spring is too slow, the camera moves back.
///
/// It needs no future frames, so a video needs no second run.
class FollowingCamera {
  public:
    FollowingCamera(const Subject& subject, float aspect);

    /// `seconds`: simulated time since the previous call; 0 if nothing has moved.
    void follow(const Subject& subject, float seconds);
    /// A cut: restarts with that subject.
    void cut_to(const Subject& subject);

    const Ball& shown() const { return shown_; }
    Camera camera() const { return framing(shown_, aspect_); }
    /// Moves a camera that the user has steered along with the subject, by the change of the last follow() or cut_to().
    Camera moved_along(const Camera& camera) const;

  private:
    float aspect_ = 1;
    Ball aim_, shown_, before_;
    Vec3 velocity_;     // m/s, of the center of `shown_`
    float growth_ = 0;  // m/s, of its radius
};

}  // namespace weft
