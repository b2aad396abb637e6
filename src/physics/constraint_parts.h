// Chooses by the last two columns of constraints.def. In a WEFT_CONSTRAINT, WEFT_IF_FABRIC_##source(text) is `text` for
// a constraint whose source is `fabric` and nothing for all others. A source or a damping without a line here does not
// compile.
#ifndef WEFT_CONSTRAINT_PARTS_H
#define WEFT_CONSTRAINT_PARTS_H

// Built from a fabric's values: there is a <Name>Material and build_<name>(rest, material).
#define WEFT_IF_FABRIC_fabric(...) __VA_ARGS__
#define WEFT_IF_FABRIC_pins(...)
#define WEFT_IF_FABRIC_level(...)
#define WEFT_IF_FABRIC_links(...)
#define WEFT_IF_FABRIC_dynamic(...)

// Built from pins: there is build_<name>(rest).
#define WEFT_IF_PINS_fabric(...)
#define WEFT_IF_PINS_pins(...) __VA_ARGS__
#define WEFT_IF_PINS_level(...)
#define WEFT_IF_PINS_links(...)
#define WEFT_IF_PINS_dynamic(...)

// Has a Jacobi version. Constraints of a model use it with averaged Jacobi, dynamic lists always.
#define WEFT_IF_SIDE_BY_SIDE_fabric(...) __VA_ARGS__
#define WEFT_IF_SIDE_BY_SIDE_pins(...) __VA_ARGS__
#define WEFT_IF_SIDE_BY_SIDE_level(...)
#define WEFT_IF_SIDE_BY_SIDE_links(...)
#define WEFT_IF_SIDE_BY_SIDE_dynamic(...) __VA_ARGS__

// Not in a cloth's model: its table for this constraint stays empty.
#define WEFT_IF_NOT_IN_MODEL_fabric(...)
#define WEFT_IF_NOT_IN_MODEL_pins(...)
#define WEFT_IF_NOT_IN_MODEL_level(...) __VA_ARGS__
#define WEFT_IF_NOT_IN_MODEL_links(...) __VA_ARGS__
#define WEFT_IF_NOT_IN_MODEL_dynamic(...) __VA_ARGS__

// Has a version for plain position-based dynamics. Coarse levels are projected with compliance for every method, and
// dynamic lists use the Jacobi version.
#define WEFT_IF_PLAIN_fabric(...) __VA_ARGS__
#define WEFT_IF_PLAIN_pins(...) __VA_ARGS__
#define WEFT_IF_PLAIN_level(...)
#define WEFT_IF_PLAIN_links(...) __VA_ARGS__
#define WEFT_IF_PLAIN_dynamic(...)

// There is damp_<name>.
#define WEFT_IF_DAMPED_damped(...) __VA_ARGS__
#define WEFT_IF_DAMPED_undamped(...)

#endif
