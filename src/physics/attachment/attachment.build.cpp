#include "physics/attachment/attachment.h"

namespace weft {

RowList attachment_rows(std::span<const Attachment> attachments, std::uint32_t first_anchor) {
    RowList rows = make_rows(ConstraintKind::attachment);
    for (std::uint32_t i = 0; i < attachments.size(); ++i)
        rows.add({attachments[i].particle, first_anchor + i}, {attachments[i].compliance});
    return rows;
}

RowList build_attachment(const RestShape& rest) {
    return attachment_rows(rest.attachments, rest.first_anchor);
}

}  // namespace weft
