// Attachment: a particle tied to a place by a spring. Read by C++ and by GLSL.
#ifndef WEFT_ATTACHMENT_DATA_H
#define WEFT_ATTACHMENT_DATA_H

// The numbers of one row.
//   compliance  m/N  inverse stiffness of the spring
#define WEFT_ROW_attachment(FIELD) FIELD(compliance)

#ifdef __cplusplus
#include "base/parameter.h"

#include <array>

namespace weft {

struct AttachmentMaterial {
    static constexpr int plain[2] = {-1, -1};
};

// A scene says this of a pin.
inline constexpr std::array<Parameter, 0> attachment_parameters{};

}  // namespace weft
#endif
#endif
