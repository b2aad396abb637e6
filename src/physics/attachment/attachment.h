// Springs between particles and anchors.
#pragma once

#include "physics/constraint.h"

#include <span>

namespace weft {

/// One constraint per attachment. Anchor i is point `first_anchor` + i.
RowList attachment_rows(std::span<const Attachment> attachments, std::uint32_t first_anchor);

}  // namespace weft
