#include "physics/constraint.h"

namespace weft {

// Its rows are found while the cloth moves.
RowList build_adhesion(const RestShape&, const AdhesionMaterial&) {
    return make_rows(ConstraintKind::adhesion);
}

}  // namespace weft
