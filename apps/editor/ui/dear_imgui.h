// Dear ImGui with its internals, on which our widgets stand. Version 1.86 (Debian 12) and 1.90 (Ubuntu 24.04).
#pragma once

#define IMGUI_DEFINE_MATH_OPERATORS
#include <imgui.h>
#include <imgui_internal.h>

#if IMGUI_VERSION_NUM < 18600 || IMGUI_VERSION_NUM >= 19200
#error "weft's widgets are written for Dear ImGui 1.86 to 1.91"
#endif
