// Where contact of a cloth with itself takes the particles to be at rest.
#pragma once

#include "solver/model/cloth_model.h"

namespace weft {

/// m, per particle, as long as ClothModel::start. Pairs of features keep at most half of their distance at rest, so
/// that neighbors do not push each other apart. Both sides of an opened edge coincide at rest, so they would form no
/// pair and pass through each other. Here each particle of a vertex that has parted lies within its own triangles: at
/// the mean of their centers.
SharedArray<Vec4> rest_for_contact(const ClothModel& model);

}  // namespace weft
