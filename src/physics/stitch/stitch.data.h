// Stitch: keeps two points on cloth, of two cloths or of one, at a given gap. Read by C++ and by GLSL (law: stitch.md).
#ifndef WEFT_STITCH_DATA_H
#define WEFT_STITCH_DATA_H

// The numbers of one constraint.
//   c0 … c5     1    share of each particle: those of the first point sum to 1, those of the second to -1
//   gap         m    distance of the points at rest
//   compliance  m/N  inverse stiffness
#define WEFT_ROW_stitch(FIELD) FIELD(c0) FIELD(c1) FIELD(c2) FIELD(c3) FIELD(c4) FIELD(c5) FIELD(gap) FIELD(compliance)

#endif
