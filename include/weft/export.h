// Marks the symbols that the shared library exports; all others are hidden.
#pragma once

#if !defined(_WIN32)
#define WEFT_API __attribute__((visibility("default")))
#elif defined(WEFT_BUILDING)
#define WEFT_API __declspec(dllexport)
#elif defined(WEFT_SHARED)
#define WEFT_API __declspec(dllimport)
#else
#define WEFT_API
#endif
