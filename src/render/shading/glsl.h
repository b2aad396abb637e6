// Macros for code that is both C++ and GLSL. C++ gets its vectors from glm, which has the syntax of GLSL.
#ifndef WEFT_SHADING_GLSL_H
#define WEFT_SHADING_GLSL_H

#ifdef __cplusplus
#include <glm/glm.hpp>

namespace weft::shading {
using namespace glm;
using uint = glm::uint;
}  // namespace weft::shading
#define WEFT_SHADING_BEGIN namespace weft::shading {
#define WEFT_SHADING_END }
#define WEFT_SHADE inline
#else
#define WEFT_SHADING_BEGIN
#define WEFT_SHADING_END
#define WEFT_SHADE
#endif

#endif
