#include "physics/bend/hinge_at_rest.h"
#include "physics/constraint.h"

namespace weft {

RowList build_bend(const RestShape& rest, const BendMaterial& material) {
    RowList rows = make_rows(ConstraintKind::bend);
    if (material.model != BendModel::hinges) return rows;
    for (const Hinge& hinge : rest.topology.hinges) {
        if (const auto at_rest = hinge_at_rest(rest, hinge, material))
            rows.add({hinge.a, hinge.b, hinge.c, hinge.d}, {at_rest->angle, at_rest->compliance});
    }
    return rows;
}

}  // namespace weft
