// What the shared library shows; everything else in it is hidden.
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
