// Reach: two places of a cloth no farther apart than the way over it. Read by C++ and by GLSL (reach.md has the law).
#ifndef WEFT_REACH_DATA_H
#define WEFT_REACH_DATA_H

// The numbers of one row.
//   limit  m      largest distance
//   give   m²/N   so much more for every N/m of tension in the cloth
#define WEFT_ROW_reach(FIELD) FIELD(limit) FIELD(give)

#endif
