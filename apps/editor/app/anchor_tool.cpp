#include "editor/app/anchor_tool.h"

#include "editor/app/vertex_edits.h"

#include <algorithm>
#include <utility>

namespace weft::editor {
namespace {

constexpr ImU32 dark = IM_COL32(20, 20, 20, 255), pinned = IM_COL32(255, 200, 60, 255),
                coming = IM_COL32(120, 230, 140, 255), going = IM_COL32(255, 90, 80, 255);

void draw_diamond(const ViewCanvas& canvas, ImVec2 p, float scale) {
    const auto shape = [&](float r, ImU32 color) {
        canvas.draw.AddQuadFilled(ImVec2(p.x, p.y - r), ImVec2(p.x + r, p.y), ImVec2(p.x, p.y + r),
                                  ImVec2(p.x - r, p.y), color);
    };
    shape(canvas.theme.px(6.5f * scale), dark);
    shape(canvas.theme.px(4.5f * scale), pinned);
}

void draw_line(const ViewCanvas& canvas, ImVec2 from, ImVec2 to, ImU32 color) {
    canvas.draw.AddLine(from, to, dark, canvas.theme.px(4.5f));
    canvas.draw.AddLine(from, to, color, canvas.theme.px(2.2f));
}

void draw_coming(const ViewCanvas& canvas, ImVec2 p) {
    const float r = canvas.theme.px(8), plus = canvas.theme.px(4.5f);
    canvas.draw.AddCircle(p, r, dark, 0, canvas.theme.px(4.5f));
    canvas.draw.AddCircle(p, r, coming, 0, canvas.theme.px(2.2f));
    draw_line(canvas, ImVec2(p.x - plus, p.y), ImVec2(p.x + plus, p.y), coming);
    draw_line(canvas, ImVec2(p.x, p.y - plus), ImVec2(p.x, p.y + plus), coming);
}

void draw_going(const ViewCanvas& canvas, ImVec2 p) {
    const float r = canvas.theme.px(8);
    draw_line(canvas, ImVec2(p.x - r, p.y - r), ImVec2(p.x + r, p.y + r), going);
    draw_line(canvas, ImVec2(p.x - r, p.y + r), ImVec2(p.x + r, p.y - r), going);
}

/// `2 anchors`, `1 pin`.
std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

// Pending anchors are those of one cloth.
void AnchorTool::work_on(Session& session, const std::string& cloth) {
    if (cloth_ != cloth && pending()) {
        session.say("The pending anchors of " + cloth_ + " were discarded.");
        discard();
    }
    cloth_ = cloth;
}

void AnchorTool::click(const ToolInput& in, bool through) {
    const auto found = vertex_under_pointer(in, through);
    if (!found) return;
    work_on(in.session, found->name);
    const Document& document = *in.session.document();
    const std::string place = place_of_cloth(document, cloth_);
    if (place.empty()) return;
    in.session.select(place);
    const VertexSet one{found->vertex};
    const auto toggle = [&](VertexSet& set) { set = holds(set, one[0]) ? without(set, one) : with(set, one); };
    if (holds(listed_pins(document, place), one[0])) {
        toggle(removed_);
    } else {
        const std::uint32_t particle = in.picture.numbers[found->cloth]->of_welded[one[0]];
        const bool by_box = changed_pins(document, place, {}, {}).others > 0;
        if (by_box && !holds(added_, one[0]) &&
            !(in.picture.world->frame().cloths[found->cloth].positions[particle].w > 0))
            return in.session.say("A box or a color pins this vertex. Change that pin in the properties.");
        toggle(added_);
    }
    if (live) apply(in.session);
}

void AnchorTool::add(Session& session, const std::string& cloth, const VertexSet& vertices) {
    const std::string place = place_of_cloth(*session.document(), cloth);
    if (place.empty()) return;
    work_on(session, cloth);
    added_ = with(added_, without(vertices, listed_pins(*session.document(), place)));
    removed_ = without(removed_, vertices);
    if (live) apply(session);
}

void AnchorTool::apply(Session& session) {
    const std::string place = place_of_cloth(*session.document(), cloth_);
    if (pending() && !place.empty()) {
        std::string label;
        if (!added_.empty()) label = "Pin " + counted(added_.size(), "anchor");
        if (!removed_.empty()) label += (label.empty() ? "Unpin " : ", unpin ") + counted(removed_.size(), "anchor");
        PinChange change = changed_pins(*session.document(), place, added_, removed_);
        session.change(label + " of " + cloth_, std::move(change.edits));
    }
    discard();
}

bool AnchorTool::discard() {
    const bool was = pending();
    added_.clear(), removed_.clear();
    return was;
}

void AnchorTool::draw(const ViewCanvas& canvas, const Session& session, const Picture& picture) const {
    if (!pending() || place_of_cloth(*session.document(), cloth_).empty()) return;
    const auto cloth = cloth_called(picture, cloth_);
    if (!cloth) return;
    const ClothFrame& frame = picture.world->frame().cloths[*cloth];
    const auto& of_welded = picture.numbers[*cloth]->of_welded;
    for (const auto& [set, mark] : {std::pair{&added_, &draw_coming}, {&removed_, &draw_going}}) {
        for (const std::uint32_t vertex : *set) {
            if (vertex >= of_welded.size() || of_welded[vertex] >= frame.positions.size()) continue;
            if (const auto p = canvas.at(frame.positions[of_welded[vertex]].xyz())) mark(canvas, *p);
        }
    }
}

void draw_pins(const ViewCanvas& canvas, const Picture& picture, std::size_t cloth) {
    const ClothFrame& frame = picture.world->frame().cloths[cloth];
    std::vector<Vec3> places;
    for (const Vec4& p : frame.positions)
        if (!(p.w > 0)) places.push_back(p.xyz());
    const ConstraintTable& springs = frame.model->table(ConstraintKind::attachment);
    for (std::uint32_t row = 0; row < springs.stride; ++row)
        if (springs.is_real(row) && springs.particles[row] < frame.positions.size())
            places.push_back(frame.positions[springs.particles[row]].xyz());
    // Large marks of a cloth that is pinned in many places would hide it.
    constexpr std::size_t many = 200, most = 20000;
    const float scale = places.size() > many ? 0.5f : 1;
    for (std::size_t i = 0; i < std::min(places.size(), most); ++i)
        if (const auto p = canvas.at(places[i])) draw_diamond(canvas, *p, scale);
}

}  // namespace weft::editor
