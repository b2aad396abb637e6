// Adhesion: a spring between a particle and a point of a collider. Read by C++ and by GLSL.
#ifndef WEFT_ADHESION_DATA_H
#define WEFT_ADHESION_DATA_H

// The numbers of one constraint.
//   target_x … target_z  m    where the point of the collider is at the end of the substep
//   compliance           m/N  inverse stiffness of the spring; 0: rigid
#define WEFT_ROW_adhesion(FIELD) FIELD(target_x) FIELD(target_y) FIELD(target_z) FIELD(compliance)

#endif
