// Legends of overlays, drawn into the lower left corner of the image.
#pragma once

#include "render/drawing.h"

#include <weft/vector.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft {

struct Legend {
    /// A bar of colors with numbers.
    struct Bar {
        float least = 0, most = 1;
        render::ColorScale scale = render::ColorScale::amount;
    };
    /// A line of text, with a patch of color before it.
    struct Entry {
        std::optional<Vec4> color;  ///< sRGB and opacity
        std::string text;
    };

    std::string title;  ///< ASCII, like all text here; other characters become '?'
    std::optional<Bar> bar = {};
    std::vector<Entry> entries = {};
    bool of_scalars = false;  ///< belongs to OverlayOutput::scalars
};

/// sRGB and opacity. `at`: 0…1, from one end of the scale to the other.
Vec4 color_of(render::ColorScale scale, float at);

/// Numbers under a bar, from its left end to its right: five, or three if five do not fit.
std::vector<std::string> tick_texts(const Legend::Bar& bar, std::size_t count = 5);

/// Draws the legends below one another on a dark backdrop. Leaves out the last ones if the image has no room for them.
void draw_legends(std::span<const Legend> legends, std::uint32_t width, std::uint32_t height,
                  std::vector<render::FlatVertex>& flat);

}  // namespace weft
