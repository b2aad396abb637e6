#include "editor/app/vertex_selector.h"

#include "editor/app/vertex_edits.h"
#include "editor/tools/vertex_selection.h"

#include <algorithm>

namespace weft::editor {
namespace {

constexpr float reach = 24;  // pixels from the pointer to a vertex

constexpr SelectionChange changes[] = {
    {"all", "All", "Choose all vertices of the cloth",
     [](const MeshView& mesh, const VertexSet&) { return all_vertices(mesh); }},
    {"none", "None", "Choose nothing", [](const MeshView&, const VertexSet&) { return VertexSet{}; }, true},
    {"invert", "Invert", "Choose what is not chosen",
     [](const MeshView& mesh, const VertexSet& chosen) { return without(all_vertices(mesh), chosen); }},
    {"grow", "Grow", "And the neighbors of the chosen vertices",
     [](const MeshView& mesh, const VertexSet& chosen) { return grown(mesh, chosen); }, true},
    {"shrink", "Shrink", "Without those that have neighbors outside",
     [](const MeshView& mesh, const VertexSet& chosen) { return shrunk(mesh, chosen); }, true},
    {"boundary", "Boundary", "Only the outermost of the chosen vertices; without any, the rim of the cloth",
     [](const MeshView& mesh, const VertexSet& chosen) {
         return boundary_of(mesh, chosen.empty() ? all_vertices(mesh) : chosen);
     }},
};

/// Particles of a frame as particles that the cloth was built with.
VertexSet originals(const Picture& picture, std::size_t cloth, const std::vector<std::uint32_t>& particles) {
    const ClothFrame& frame = picture.world->frame().cloths[cloth];
    std::vector<std::uint32_t> all;
    for (const std::uint32_t particle : particles)
        if (const std::uint32_t p = original_of(frame, *picture.numbers[cloth], particle); p != none) all.push_back(p);
    return make_set(std::move(all));
}

std::optional<std::size_t> selected_cloth(const Session& session, const Picture& picture) {
    if (!session.selected().starts_with("/cloths/")) return {};
    return cloth_called(picture, session.selected_name());
}

std::string count_text(std::size_t count) {
    return std::to_string(count) + (count == 1 ? " vertex" : " vertices");
}

}  // namespace

std::span<const SelectionChange> selection_changes() {
    return changes;
}

std::string place_of_cloth(const Document& document, const std::string& name) {
    const auto& cloths = document.scene.cloths;
    const auto found = std::ranges::find(cloths, name, &SceneCloth::name);
    return found == cloths.end() ? std::string() : "/cloths/" + std::to_string(found - cloths.begin());
}

void VertexSelector::change(const SelectionChange& change, Session& session, const Picture& picture) {
    auto cloth = chosen_.empty() ? std::nullopt : cloth_called(picture, cloth_);
    if (!cloth) cloth = selected_cloth(session, picture);
    if (!cloth && picture.world->cloth_count() == 1) cloth = 0;
    if (!cloth) return session.say("Select a cloth first.");
    const ClothVertices vertices = vertices_of(picture, *cloth);
    const std::string name = PickTrees::name_of_cloth(picture, *cloth);
    const VertexSet now = cloth_ == name ? vertices.to_particles(chosen_) : VertexSet{};
    choose(name, vertices.to_vertices(change.apply(vertices.mesh(), now)));
    session.select(place_of_cloth(*session.document(), name));
}

void VertexSelector::take(const ToolInput& in, std::size_t cloth, const VertexSet& particles) {
    const std::string name = PickTrees::name_of_cloth(in.picture, cloth);
    const VertexSet found = vertices_of(in.picture, cloth).to_vertices(originals(in.picture, cloth, particles));
    const Modifiers& keys = in.input.modifiers;
    const VertexSet before = cloth_ == name ? chosen_ : VertexSet{};
    choose(name, keys.shift ? with(before, found) : keys.control ? without(before, found) : found);
    in.session.select(place_of_cloth(*in.session.document(), name));
}

void VertexSelector::click(const ToolInput& in) {
    if (const auto found = vertex_under_pointer(in, through)) {
        const ParticleNumbers& numbers = *in.picture.numbers[found->cloth];
        return take(in, found->cloth, {numbers.of_welded[found->vertex]});
    }
    if (in.input.modifiers.shift || in.input.modifiers.control) return;
    choose_none();
    const Pick pick = in.pick_at(in.input.pointer);
    if (pick.kind != PickKind::collider) return in.session.select({});
    const std::string name = PickTrees::name_of_collider(in.picture, pick.index);
    const auto& colliders = in.session.document()->scene.colliders;
    for (std::size_t i = 0; i < colliders.size(); ++i)
        if (colliders[i].name == name) in.session.select("/colliders/" + std::to_string(i));
}

// Of the selected cloth; without one, of the cloth that has the most vertices inside.
template <class Inside>
void VertexSelector::region(const ToolInput& in, Inside&& inside) {
    const PickScene scene = in.trees.scene(in.picture, in.marks);
    const HiddenBy hidden{scene};
    const auto selected = selected_cloth(in.session, in.picture);
    std::optional<std::size_t> best;
    VertexSet most;
    for (std::size_t i = 0; i < in.picture.world->cloth_count(); ++i) {
        if ((selected && *selected != i) || !scene.cloths[i].tree) continue;  // hidden and locked ones have no tree
        VertexSet found = inside(PickTrees::mesh_of_cloth(in.picture, i), through ? nullptr : &hidden);
        if (best && found.size() <= most.size()) continue;
        best = i, most = std::move(found);
    }
    if (best && (selected || !most.empty())) return take(in, *best, most);
    if (!in.input.modifiers.shift && !in.input.modifiers.control) choose_none();
}

void VertexSelector::box(const ToolInput& in, Vec2 from) {
    region(in, [&](const MeshView& mesh, const HiddenBy* hidden) {
        return vertices_in_box(in.input.view, mesh, from, in.input.pointer, hidden);
    });
}

void VertexSelector::lasso(const ToolInput& in, std::span<const Vec2> polygon) {
    region(in, [&](const MeshView& mesh, const HiddenBy* hidden) {
        return vertices_in_lasso(in.input.view, mesh, polygon, hidden);
    });
}

void VertexSelector::pin(Session& session) {
    if (chosen_.empty()) return session.say("Choose vertices of a cloth first, with the tool Select or Lasso.");
    const std::string place = place_of_cloth(*session.document(), cloth_);
    if (place.empty()) return;
    session.change("Pin " + count_text(chosen_.size()) + " of " + cloth_,
                   pin_edits(*session.document(), place, chosen_));
}

void VertexSelector::unpin(Session& session) {
    const std::string place = place_of_cloth(*session.document(), cloth_);
    if (place.empty() || chosen_.empty())
        return session.say("Choose pinned vertices of a cloth first, with the tool Select or Lasso.");
    PinChange change = changed_pins(*session.document(), place, {}, chosen_);
    if (change.edits.empty())
        return session.say(change.others > 0 ? "Pins that a box or a color selects are removed in the properties."
                                             : "None of the chosen vertices is pinned.");
    session.change("Unpin vertices of " + cloth_, std::move(change.edits));
}

void VertexSelector::draw(const ViewCanvas& canvas, const Picture& picture) const {
    const auto cloth = chosen_.empty() ? std::nullopt : cloth_called(picture, cloth_);
    if (!cloth) return;
    const ClothFrame& frame = picture.world->frame().cloths[*cloth];
    const auto& of_welded = picture.numbers[*cloth]->of_welded;
    // Many vertices get small marks, so that the cloth can still be seen.
    constexpr std::size_t many = 1000;
    const float outer = chosen_.size() > many ? 2 : 4, inner = outer - 1.5f;
    for (const std::uint32_t vertex : chosen_) {
        if (vertex >= of_welded.size() || of_welded[vertex] >= frame.positions.size()) continue;
        const auto point = canvas.at(frame.positions[of_welded[vertex]].xyz());
        if (!point) continue;
        const auto square = [&](float half, ImU32 color) {
            canvas.draw.AddRectFilled(ImVec2(point->x - half, point->y - half),
                                      ImVec2(point->x + half, point->y + half), color);
        };
        if (chosen_.size() <= many) square(outer, IM_COL32(20, 20, 20, 255));
        square(chosen_.size() <= many ? inner : outer, IM_COL32(255, 190, 60, 255));
    }
}

std::optional<VertexUnderPointer> vertex_under_pointer(const ToolInput& in, bool through) {
    const PickScene scene = in.trees.scene(in.picture, in.marks);
    const Pick pick = pick_at(in.input.view, in.input.pointer, scene);
    const auto cloth =
        pick.kind == PickKind::cloth ? std::optional<std::size_t>(pick.index) : selected_cloth(in.session, in.picture);
    if (!cloth || !scene.cloths[*cloth].tree) return {};
    const HiddenBy hidden{scene};
    const auto particle = vertex_at(in.input.view, PickTrees::mesh_of_cloth(in.picture, *cloth), in.input.pointer,
                                    reach, through ? nullptr : &hidden);
    if (!particle) return {};
    const ClothVertices vertices = vertices_of(in.picture, *cloth);
    const VertexSet found = vertices.to_vertices(originals(in.picture, *cloth, {*particle}));
    if (found.empty()) return {};
    return VertexUnderPointer{*cloth, PickTrees::name_of_cloth(in.picture, *cloth), found[0]};
}

}  // namespace weft::editor
