// Reads values through parameter tables, without the type of the struct that holds them.
#pragma once

#include "base/parameter.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace weft {

/// Element `index` of the value in the struct at `base`. Uses memcpy because only the member's offset is known.
template <class T>
T element(const Parameter& parameter, const void* base, std::size_t index = 0) {
    T value;
    std::memcpy(&value, static_cast<const std::byte*>(base) + parameter.offset + index * sizeof(T), sizeof(T));
    return value;
}

inline const std::string& text_of(const Parameter& parameter, const void* base) {
    return *reinterpret_cast<const std::string*>(static_cast<const std::byte*>(base) + parameter.offset);
}

/// Whether both structs have the same value, bit for bit. Objects and lists have no value here and compare equal.
inline bool same_value(const Parameter& parameter, const void* a, const void* b) {
    const auto same_bytes = [&](std::size_t size) {
        const auto* in_a = static_cast<const std::byte*>(a) + parameter.offset;
        const auto* in_b = static_cast<const std::byte*>(b) + parameter.offset;
        return std::memcmp(in_a, in_b, size) == 0;
    };
    switch (parameter.kind) {
        case ParameterKind::number:
        case ParameterKind::vector:
        case ParameterKind::angle_or_mesh:
            return same_bytes(parameter.count * sizeof(float));
        case ParameterKind::integer:
            return same_bytes(parameter.count * sizeof(std::uint32_t));
        case ParameterKind::choice:
            return same_bytes(sizeof(int));
        case ParameterKind::flag:
            return same_bytes(sizeof(bool));
        case ParameterKind::text:
            return text_of(parameter, a) == text_of(parameter, b);
        case ParameterKind::object:
        case ParameterKind::list:
            break;
    }
    return true;
}

}  // namespace weft
