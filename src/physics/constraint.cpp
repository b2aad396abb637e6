#include "physics/constraint.h"

#include <array>

namespace weft {
namespace {

#define WEFT_FIELD_NAME(field) std::string_view(#field),
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas) \
    constexpr std::array name##_fields = {WEFT_ROW_##name(WEFT_FIELD_NAME)};
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
#undef WEFT_FIELD_NAME

constexpr ConstraintInfo infos[] = {
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas) {#name, particles, moved, lambdas, name##_fields},
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
};

}  // namespace

const ConstraintInfo& constraint_info(ConstraintKind kind) {
    return infos[static_cast<std::uint32_t>(kind)];
}

RowList make_rows(ConstraintKind kind) {
    const ConstraintInfo& info = constraint_info(kind);
    return {.arity = info.arity,
            .field_count = static_cast<std::uint32_t>(info.fields.size()),
            .particles = {},
            .fields = {}};
}

}  // namespace weft
