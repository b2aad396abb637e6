// Anchors: pins that are chosen one by one and applied together.
#pragma once

#include "editor/app/vertex_selector.h"

#include <string>

namespace weft::editor {

class AnchorTool {
  public:
    bool live = false;  ///< each click changes the pins at once

    /// A click on a vertex adds an anchor, or takes one away.
    void click(const ToolInput& in, bool through);
    /// Adds anchors at vertices of a cloth.
    void add(Session& session, const std::string& cloth, const VertexSet& vertices);
    /// Pins and unpins what is pending, as one undo step.
    void apply(Session& session);
    /// Whether something was pending.
    bool discard();

    /// Vertices that will be pinned or unpinned.
    const VertexSet& added() const { return added_; }
    const VertexSet& removed() const { return removed_; }
    bool pending() const { return !added_.empty() || !removed_.empty(); }

    /// Pins are full diamonds. Pending ones are rings with a plus, and pins that will go have a cross.
    void draw(const ViewCanvas& canvas, const Session& session, const Picture& picture) const;

  private:
    void work_on(Session& session, const std::string& cloth);

    std::string cloth_;
    VertexSet added_, removed_;
};

/// Marks pinned particles of a cloth with diamonds.
void draw_pins(const ViewCanvas& canvas, const Picture& picture, std::size_t cloth);

}  // namespace weft::editor
