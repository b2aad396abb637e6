#include "view/overlays.h"

#include "scene/nearest_name.h"

#include <algorithm>

namespace weft {

namespace overlay {
#define WEFT_OVERLAY(name, needs, what) void name(const OverlayInput& input, OverlayOutput& output);
#include "view/overlays.def"
#undef WEFT_OVERLAY
}  // namespace overlay

namespace {

constexpr Overlay all[] = {
#define WEFT_OVERLAY(name, needs, what) {#name, what, overlay::name, OverlayNeeds::needs},
#include "view/overlays.def"
#undef WEFT_OVERLAY
};

}  // namespace

std::span<const Overlay> overlays() {
    return all;
}

Result<const Overlay*> find_overlay(std::string_view name) {
    const auto found = std::ranges::find(all, name, &Overlay::name);
    if (found != std::end(all)) return found;
    std::vector<std::string_view> names;
    for (const Overlay& known : all) names.push_back(known.name);
    return Error{"overlay", "unknown name \"" + std::string(name) + '"' + suggestion(name, names)};
}

OverlayOutput draw_overlays(std::span<const Overlay* const> chosen, const OverlayInput& input) {
    OverlayOutput output;
    for (const Overlay* one : chosen) {
        const std::size_t legends = output.legends.size();
        std::vector<Scalars> before = std::move(output.scalars);
        output.scalars.clear();
        one->draw(input, output);
        if (output.scalars.empty()) {
            output.scalars = std::move(before);
        } else {
            // These scalars replace those of an earlier overlay, so its legend is removed.
            const auto end = output.legends.begin() + static_cast<std::ptrdiff_t>(legends);
            output.legends.erase(
                std::remove_if(output.legends.begin(), end, [](const Legend& l) { return l.of_scalars; }), end);
        }
    }
    if (input.legends) draw_legends(output.legends, input.width, input.height, output.flat);
    return output;
}

}  // namespace weft
