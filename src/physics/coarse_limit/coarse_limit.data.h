// Coarse distance limit: limits the distance of two nodes by their geodesic distance at rest. Read by C++ and by GLSL
// (law: coarse_limit.md).
#ifndef WEFT_COARSE_LIMIT_DATA_H
#define WEFT_COARSE_LIMIT_DATA_H

// The numbers of one constraint.
//   limit       m     largest distance
//   compliance  m²/N  additional distance per N/m of tension in the cloth
//   give        m     additional distance from a pin, by the tension near it, in short substeps
//   ease        1/s²  how much less of it in long ones
#define WEFT_ROW_coarse_limit(FIELD) FIELD(limit) FIELD(compliance) FIELD(give) FIELD(ease)

#endif
