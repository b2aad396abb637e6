// Springs that tie particles to anchors.
#pragma once

#include "physics/constraint.h"

#include <span>

namespace weft {

/// A row for each. The anchor of number i is point `first_anchor` + i.
RowList attachment_rows(std::span<const Attachment> attachments, std::uint32_t first_anchor);

}  // namespace weft
