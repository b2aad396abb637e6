// Cloths and motions of the cases.
#pragma once

#include "mesh/procedural.h"
#include "physics/rest_shape.h"
#include "validate/validation.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace weft::cases {

inline constexpr double standard_gravity = 9.81;  ///< m/s², that of WorldSettings

struct SheetOf {
    TriangleMesh mesh = make_grid({1, 1}, {17, 17}, GridDiagonal::alternating);
    Fabric fabric = {};
    /// Where a vertex of the mesh starts; empty: where the mesh has it.
    std::function<Vec3(Vec3 at_rest)> place = {};
    std::function<bool(Vec3 at_rest)> pinned = {};
    std::vector<Attachment> springs = {};  ///< pull single particles to fixed places
    KinematicTargets targets = {};         ///< particles are numbered like vertices
};

/// Adds a cloth whose particles are numbered like the vertices of the mesh. Throws std::runtime_error if it cannot.
ClothId add_sheet(World& world, SheetOf sheet);

/// Where a sheet begins to bend in the cell between two pinned rows of particles, in cells from the first row: at the
/// second one if the triangles between them are rigid, or halfway.
constexpr double begin_of_bending(BendModel model) {
    return model == BendModel::moment ? 1 : 0.5;
}

/// Adds a rigid body of this shape, which has no data. Throws std::runtime_error if it has no mass.
ColliderId add_body(World& world, const ColliderShape& shape, const BodyDesc& body, Vec3 position);

/// A fabric of linear springs without bending stiffness. `stiffness` in N/m, `density` in kg/m².
Fabric elastic_fabric(double stiffness, double density);

void run(World& world, double seconds, double frame_seconds = 1.0 / 60);

/// Brings the cloths to rest: sets all velocities to 0 whenever the kinetic energy begins to fall (kinetic damping).
/// The end is the equilibrium of the constraints. Ends before `seconds` once no particle is faster than `slow` m/s.
void settle(World& world, double seconds, double frame_seconds = 1.0 / 60, double slow = 1e-5);

/// Sets all velocities to 0.
void stop(World& world);

/// Where the particles of the first cloth are, m.
std::vector<Vec4> places(const World& world);
/// m: root of the mean square of the distances between particles of the same number.
double rms_distance(const std::vector<Vec4>& a, const std::vector<Vec4>& b);
/// As run(). Returns the wall time per frame, ms.
double timed_run(World& world, double seconds);
struct Rest {
    std::vector<Vec4> places;  ///< m
    double ms_per_frame = 0;
};
/// A sheet of side² particles at rest.
using RestingShape = Rest (*)(const Validation&, std::uint32_t side, std::uint32_t substeps, bool levels);
/// Checks how far the default solver is from 300 substeps without coarse levels, for several numbers of substeps.
/// `known`: ValidationCheck::known by number of substeps.
void compare_with_converged(Validation& validation, RestingShape shape, double (*known)(std::uint32_t substeps));
/// Position of a particle now, m.
std::array<double, 3> position(const World& world, std::uint32_t particle);
/// kg·m/s, of the cloths.
std::array<double, 3> momentum(const World& world);
/// Mean of the particles' places, weighted by mass, pinned ones included, m.
std::array<double, 3> center_of_mass(const World& world);

}  // namespace weft::cases
