#include "physics/constraint.h"

namespace weft {

// Between particles there are none: the hierarchy makes them between its nodes.
RowList build_reach(const RestShape&, const ReachMaterial&) {
    return make_rows(ConstraintKind::reach);
}

}  // namespace weft
