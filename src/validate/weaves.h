// Sheets with the warp in any direction, for the cases that measure stiffness in the plane.
#pragma once

#include "mesh/procedural.h"

#include <cstdint>

namespace weft::cases {

enum class PullMesh { alternating, uniform, cross, irregular };

const char* name_of(PullMesh mesh);
/// A grid with cells of 1/8 m; `irregular`: alternating diagonals and moved vertices.
TriangleMesh pulled_mesh(PullMesh kind, std::uint32_t columns, std::uint32_t rows);
/// Sets the angle of the warp to x.
void turn_warp(TriangleMesh& mesh, double degrees);
/// N/m: stiffness along the bias of a sheet of these stiffnesses that cannot contract but can shear, as in the middle
/// of a wide sheet: C_yy − C_ys²/C_ss of the stiffnesses turned by 45°.
double along_bias(double warp, double weft, double shear);

}  // namespace weft::cases
