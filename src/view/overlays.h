// Debug visualizations on top of a scene. Each overlay is a file in overlays/ and a line in overlays.def.
#pragma once

#include "render/drawing.h"
#include "view/field_surfaces.h"
#include "view/legend.h"
#include "view/world_frame.h"

#include <weft/result.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace weft {

/// Input of overlays.
struct OverlayInput {
    const WorldFrame& world;
    const Frame& frame;                        ///< of the world
    FieldSurfaces& fields;                     ///< kept from image to image
    float size = 1;                            ///< m: radius of the scene, for the length of arrows
    std::uint32_t width = 1280, height = 720;  ///< pixels of the image
    bool legends = true;                       ///< draw them into the image
};

/// A value per drawn vertex of one cloth.
struct Scalars {
    std::vector<float> values;
    float least = 0, most = 1;
    render::ColorScale scale = render::ColorScale::balance;
};

/// A surface that is drawn in place of a collider's own, with a value per vertex.
struct ColliderScalars {
    std::uint32_t collider = 0;  ///< place in WorldFrame::colliders()
    std::shared_ptr<const FieldSurface> field = {};
    float least = 0, most = 1;
    render::ColorScale scale = render::ColorScale::balance;
};

/// Output of overlays. Only the last overlay with scalars provides them.
struct OverlayOutput {
    std::vector<render::Line> lines, lines_on_top;
    std::vector<render::Point> points;
    std::vector<render::FlatVertex> flat;
    std::vector<Scalars> scalars;            ///< one per cloth, or none
    std::vector<ColliderScalars> colliders;  ///< at most one per collider, in their order
    std::vector<Legend> legends;
};

/// What World must record for an overlay (WorldSettings).
enum class OverlayNeeds : std::uint8_t { nothing, contact_forces, contact_marks };

struct Overlay {
    std::string_view name, what;
    void (*draw)(const OverlayInput& input, OverlayOutput& output);  ///< adds to the output
    OverlayNeeds needs = OverlayNeeds::nothing;
};

/// In the order of overlays.def.
std::span<const Overlay> overlays();
/// The error suggests the most similar name.
Result<const Overlay*> find_overlay(std::string_view name);

/// Runs the overlays in order, and draws their legends into the lower left corner if the input says so.
OverlayOutput draw_overlays(std::span<const Overlay* const> chosen, const OverlayInput& input);

}  // namespace weft
