// A camera for scenes that have none: it frames all cloths and colliders, and follows them.
#pragma once

#include "look/camera.h"
#include "solver/world/world.h"

#include <weft/bounds.h>

namespace weft {

/// A ball that a camera keeps in view.
struct Ball {
    Vec3 center;       ///< m
    float radius = 0;  ///< m
};

/// What a camera should show of a world, at its last frame.
struct Subject {
    Ball cloths;  ///< around all particles: these must be in view
    Ball all;     ///< and the parts of colliders that are near them
};

/// Brings the frame to the host (World::frame). A collider counts as far as the cloths' bounding box, grown by its
/// diagonal to all sides, reaches: what a cloth has fallen away from is left behind, and of a large one it shows a
/// part. Without cloths, all colliders but planes.
Subject subject_of(const World& world);

/// From the front, a little from the right and above, so far away that the whole ball is in view. `aspect`: width over
/// height of the picture.
Camera framing(const Ball& ball, float aspect);

/// Follows a subject from one picture to the next as a person with a steady hand would:
///
///  * It aims at a ball a little larger than the subject, and moves its aim only as far as the subject would leave that
///    ball otherwise. A flag that flutters within it does not make the camera breathe.
///  * It goes after its aim as a critically damped spring that also knows the speed of the aim: it neither swings nor
///    lags behind what falls freely by more than g/omega², 0.15 m.
///  * Whatever happens, the cloths are in view: where the spring is too slow, the camera steps back.
///
/// It knows nothing of frames that are still to come, so that a film needs no second run.
class FollowingCamera {
  public:
    FollowingCamera(const Subject& subject, float aspect);

    /// `seconds` after the call before; 0 if nothing has moved.
    void follow(const Subject& subject, float seconds);
    /// A cut: as it would begin with that subject.
    void cut_to(const Subject& subject);

    const Ball& shown() const { return shown_; }
    Camera camera() const { return framing(shown_, aspect_); }
    /// A camera that was steered by hand since the last call of follow() or cut_to(), taken along with what it shows.
    Camera carried(const Camera& camera) const;

  private:
    float aspect_ = 1;
    Ball aim_, shown_, before_;
    Vec3 velocity_;     // m/s, of the center of `shown_`
    float growth_ = 0;  // m/s, of its radius
};

}  // namespace weft
