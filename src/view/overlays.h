// What is shown on top of a scene for those who tune it. Each overlay is a file in overlays/ and a line in
// overlays.def.
#pragma once

#include "render/drawing.h"
#include "solver/world/world.h"
#include "view/legend.h"

#include <weft/result.h>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace weft {

/// What overlays are made from.
struct OverlayInput {
    World& world;
    const Frame& frame;
    float size = 1;                            ///< m: radius of the scene, for the length of arrows
    std::uint32_t width = 1280, height = 720;  ///< pixels of the picture
};

/// A value per drawn vertex of one cloth.
struct Scalars {
    std::vector<float> values;
    float least = 0, most = 1;
    render::ColorScale scale = render::ColorScale::balance;
};

/// What they add to a picture. At most one overlay gives scalars, the last one that is asked for.
struct OverlayOutput {
    std::vector<render::Line> lines, lines_on_top;
    std::vector<render::Point> points;
    std::vector<render::FlatVertex> flat;
    std::vector<Scalars> scalars;  ///< a cloth each, or none
    std::vector<Legend> legends;   ///< draw_overlays() draws them
};

struct Overlay {
    std::string_view name, what;
    void (*draw)(const OverlayInput& input, OverlayOutput& output);  ///< adds to the output
    bool needs_feedback = false;                                     ///< World must keep account of contacts
};

/// In the order of overlays.def.
std::span<const Overlay> overlays();
/// Fails with the nearest name there is.
Result<const Overlay*> find_overlay(std::string_view name);

/// All of these one after another, and their legends in the lower left corner.
OverlayOutput draw_overlays(std::span<const Overlay* const> chosen, const OverlayInput& input);

}  // namespace weft
