// The brush: paints pins, groups, and factors on values of the fabric.
#pragma once

#include "editor/app/paint_kinds.h"
#include "editor/app/view_input.h"
#include "editor/tools/brush.h"
#include "editor/tools/stroke_sampler.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

enum class PaintMode : std::uint8_t { paint, add, subtract, smooth, erase };

struct BrushOptions {
    std::size_t kind = 0;  ///< in paint_kinds()
    PaintMode mode = PaintMode::paint;
    float radius = 0;  ///< m; 0: a tenth of the cloth
    float strength = 1;
    std::vector<float> values;  ///< per kind: what is painted
    BrushFallOff fall_off = BrushFallOff::smooth;
    std::optional<MirrorAxis> mirror = {};
    std::string group = "painted";  ///< that the kind `group` paints
};

class BrushTool {
  public:
    BrushOptions options;

    BrushTool();
    const PaintKind& kind() const { return paint_kinds()[options.kind]; }

    /// Begins a stroke: with Ctrl it erases, with Shift it smooths. Returns false if no cloth is under the pointer.
    bool begin(const ToolInput& in);
    void drag(const ToolInput& in);
    /// One undo step.
    void end(const ToolInput& in);
    void cancel();
    /// By `[` and `]`.
    void scale_radius(float by);

    /// Once per frame while the brush is the tool: colors of the painted cloth, for the view; null: there is none.
    std::shared_ptr<const ClothPaint> colors(const Session& session, const Picture& picture);
    /// The ring under the pointer, and the value there.
    void draw(Ui& ui, const ViewCanvas& canvas, const ToolInput& in);

  private:
    /// The cloth that is painted, with what is kept from stroke to stroke.
    struct Target {
        std::string name;
        ClothVertices cloth;
        std::unique_ptr<SurfaceDistance> distance;
        std::array<std::unique_ptr<RestMirror>, 3> mirrors;
    };
    /// What the colors were made of.
    struct Shown {
        DocumentPtr document;
        std::shared_ptr<const ClothModel> model;
        std::string group;
        std::size_t kind = 0;
        std::uint64_t dabs = 0;
        friend bool operator==(const Shown&, const Shown&) = default;
    };
    void work_on(const Picture& picture, std::size_t cloth);
    PaintTarget target_in(const Session& session, const Picture& picture, std::size_t cloth) const;
    void dab(const ToolInput& in, const Pick& pick);
    std::optional<MeshPlace> mirrored(const MeshPlace& place);
    BrushSettings settings(const Modifiers& keys) const;
    BrushFallOff fall_off() const { return kind().on_off ? BrushFallOff::none : options.fall_off; }

    std::optional<Target> target_;
    std::optional<BrushStroke> stroke_;
    std::optional<StrokeSampler> sampler_;
    std::uint64_t dabs_ = 0;  ///< and strokes taken back, so that colors follow
    Shown shown_;
    std::shared_ptr<const ClothPaint> colors_;
    std::vector<float> values_;  ///< of `colors_`
};

}  // namespace weft::editor
