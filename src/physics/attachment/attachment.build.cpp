#include "physics/constraint.h"

namespace weft {

RowList build_attachment(const RestShape& rest) {
    RowList rows = make_rows(ConstraintKind::attachment);
    for (std::uint32_t i = 0; i < rest.attachments.size(); ++i) {
        rows.add({rest.attachments[i].particle, rest.first_anchor + i}, {rest.attachments[i].compliance});
    }
    return rows;
}

}  // namespace weft
