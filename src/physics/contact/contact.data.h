// Contact: keeps a particle half a thickness away from a collider, with friction (law: contact.md).
#ifndef WEFT_CONTACT_DATA_H
#define WEFT_CONTACT_DATA_H

#ifdef __cplusplus
#include "base/parameter.h"

namespace weft {

struct ContactMaterial {
    float thickness = 0.002f;          ///< m
    float friction[2] = {0.4f, 0.3f};  ///< static, kinetic
};

inline constexpr Parameter contact_parameters[] = {
    {.key = "thickness", .count = 1, .offset = offsetof(ContactMaterial, thickness), .min = 0, .max = 1, .unit = "m",
     .what = "thickness of the cloth; its middle surface stays half of that away from colliders"},
    {.key = "friction", .count = 2, .offset = offsetof(ContactMaterial, friction), .min = 0, .max = 100,
     .what = "static and kinetic friction coefficient; a contact has the geometric mean of both sides"},
};

}  // namespace weft
#endif
#endif
