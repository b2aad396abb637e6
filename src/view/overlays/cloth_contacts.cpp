#include "view/overlay_parts.h"

#include <string>

namespace weft::overlay {
namespace {

/// A kind of mark, from the least to the most serious.
struct Marked {
    ContactMark mark;
    const char* text;
    Vec4 color;
    float size;  // pixels
    std::size_t count = 0;
};

const Marked* most_serious(std::span<const Marked> kinds, std::uint32_t marks) {
    const Marked* found = nullptr;
    for (const Marked& kind : kinds)
        if (marks & kind.mark) found = &kind;
    return found;
}

}  // namespace

// Marks of another frame do not match the drawn positions; the world clears them with any change.
void cloth_contacts(const OverlayInput& input, OverlayOutput& output) {
    Marked kinds[] = {{mark_touches, "touching: ", {0.2f, 0.9f, 0.35f, 1}, 4},
                      {mark_limited, "limited: ", {1.0f, 0.85f, 0.2f, 1}, 5},
                      {mark_tangled, "tangled: ", {1.0f, 0.12f, 0.1f, 1}, 7}};
    bool known = false;
    for (const ClothFrame& cloth : input.frame.cloths) {
        known = known || !cloth.contact_marks.empty();
        for (std::size_t p = 0; p < cloth.contact_marks.size(); ++p) {
            const std::uint32_t marks = cloth.contact_marks[p];
            for (Marked& kind : kinds) kind.count += (marks & kind.mark) != 0;
            if (const Marked* kind = most_serious(kinds, marks))
                add_point(output.points, cloth.positions[p].xyz(), kind->color, pixels(input, kind->size));
        }
    }
    Legend legend{.title = "contact between cloths"};
    for (const Marked& kind : kinds)
        legend.entries.push_back({kind.color, kind.text + (known ? std::to_string(kind.count) : "not known")});
    output.legends.push_back(std::move(legend));
}

}  // namespace weft::overlay
