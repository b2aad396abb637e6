// What the brush can paint. A further kind is a line in the table of paint_kinds.cpp, with functions that read and
// write it.
#pragma once

#include "editor/app/cloth_vertices.h"
#include "editor/core/document.h"
#include "view/scene_view.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

struct PaintTarget {
    const Document& document;
    std::string place;  ///< of the cloth, such as `/cloths/0`
    const ClothVertices& cloth;
    const ClothFrame& frame;
    std::string group;  ///< for the kind `group`: its name, which need not exist
};

/// The cloth in the document.
const SceneCloth& described(const PaintTarget& target);

struct PaintKind {
    std::string_view name, label, what;
    bool on_off = false;         ///< a vertex has it or not: no strength and no fall-off
    float neutral = 0;           ///< of a vertex that was never painted
    float least = 0, most = 1;   ///< that can be painted
    float usual = 1;             ///< that the brush paints at first
    std::string_view scale_low;  ///< what the two ends of the colors mean
    std::string_view scale_high;
    /// Values per particle of the cloth.
    std::vector<float> (*read)(const PaintTarget& target) = nullptr;
    /// The edits after the stroke. `changed`: particles, ascending.
    std::vector<Edit> (*write)(const PaintTarget& target, const std::vector<float>& values,
                               const VertexSet& changed) = nullptr;
    /// What must change in the document before it can be painted, such as that the cloth can tear.
    std::vector<Edit> (*prepare)(const PaintTarget& target) = nullptr;
};

std::span<const PaintKind> paint_kinds();

/// Colors for values of this kind.
ClothPaint colors_of(const PaintKind& kind, const std::string& cloth, std::vector<float> values);

}  // namespace weft::editor
