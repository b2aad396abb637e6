// Chosen vertices of a cloth: by click, box, lasso, and by what surrounds them.
#pragma once

#include "editor/app/cloth_vertices.h"
#include "editor/app/view_input.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft::editor {

/// A set of vertices that follows from the chosen ones.
struct SelectionChange {
    std::string_view name, label, what;
    VertexSet (*apply)(const MeshView& mesh, const VertexSet& chosen);
    bool needs_chosen = false;
};
/// All, none, invert, grow, shrink, boundary.
std::span<const SelectionChange> selection_changes();

class VertexSelector {
  public:
    bool through = false;  ///< choose hidden vertices too

    /// As pins number them.
    const VertexSet& chosen() const { return chosen_; }
    /// The name of their cloth.
    const std::string& cloth() const { return cloth_; }
    void choose(const std::string& cloth, VertexSet vertices) { cloth_ = cloth, chosen_ = std::move(vertices); }
    void choose_none() { chosen_.clear(); }

    /// Of the cloth of chosen vertices, else of the selected cloth, else of the only one. Says so if there is none.
    void change(const SelectionChange& change, Session& session, const Picture& picture);
    /// The vertices of a cloth that are drawn, with Shift added to the chosen ones, with Ctrl taken from them.
    void click(const ToolInput& in);
    void box(const ToolInput& in, Vec2 from);
    void lasso(const ToolInput& in, std::span<const Vec2> polygon);

    /// Pins the chosen vertices, or takes their pins away.
    void pin(Session& session);
    void unpin(Session& session);

    void draw(const ViewCanvas& canvas, const Picture& picture) const;

  private:
    template <class Inside>
    void region(const ToolInput& in, Inside&& inside);
    void take(const ToolInput& in, std::size_t cloth, const VertexSet& particles);

    VertexSet chosen_;
    std::string cloth_;
};

/// The vertex of a cloth under the pointer.
struct VertexUnderPointer {
    std::size_t cloth = 0;
    std::string name;          ///< of the cloth
    std::uint32_t vertex = 0;  ///< as pins number it
};
/// Of the cloth under the pointer, else of the selected cloth. `through`: hidden ones too.
std::optional<VertexUnderPointer> vertex_under_pointer(const ToolInput& in, bool through);

/// The place of a cloth in the document; empty: it has left.
std::string place_of_cloth(const Document& document, const std::string& name);

}  // namespace weft::editor
