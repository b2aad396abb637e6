#include "physics/constraint.h"

#include <algorithm>
#include <array>

namespace weft {
namespace {

#define WEFT_FIELD_NAME(field) std::string_view(#field),
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping) \
    constexpr std::array name##_fields = {WEFT_ROW_##name(WEFT_FIELD_NAME)};
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
#undef WEFT_FIELD_NAME

// Values of the last two columns of constraints.def.
constexpr RowSource fabric = RowSource::model, pins = RowSource::model, level = RowSource::level,
                    links = RowSource::links, dynamic = RowSource::dynamic;
constexpr bool damped = true, undamped = false;

constexpr ConstraintInfo infos[] = {
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping) \
    {#name, particles, moved, lambdas, name##_fields, source, damping},
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
};

constexpr bool can_be_damped(const ConstraintInfo& info) {
    return info.source == RowSource::model && info.moved == info.arity;
}
static_assert(std::ranges::all_of(infos,
                                  [](const ConstraintInfo& info) { return !info.damped || can_be_damped(info); }),
              "only rows of a model that move all of their particles are damped");

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
