#include "view/nice_numbers.h"
#include "view/overlay_parts.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace weft::overlay {
namespace {

constexpr Vec4 touching{0.2f, 0.9f, 0.35f, 1}, pushed{1.0f, 0.85f, 0.2f, 1}, beyond{1.0f, 0.12f, 0.1f, 1};

// m: what rounding makes of a particle on a surface is less.
constexpr double depth_that_counts = 1e-5;

// How long the line of the largest impulses is, of the scene's radius.
constexpr float longest = 0.2f;

// What the collider got, the other way round: the push on the cloth, which stands out of the surface.
void draw_touches(const OverlayInput& input, OverlayOutput& output, Legend& legend) {
    const Feedback& felt = input.world.feedback();
    // Of another frame, it would not fit to what is drawn.
    const bool known = felt.frame > 0 && felt.frame == input.frame.index;
    std::size_t count = 0;
    std::vector<float> sizes;
    for (const Contact& contact : felt.contacts) sizes.push_back(length(contact.impulse));
    const double scale = nice_above(percentile(std::move(sizes), 0.98));  // N·s
    const float reach = longest * input.size / static_cast<float>(scale);
    for (const Contact& contact : felt.contacts) {
        if (!known) break;
        add_point(output.points, contact.point, touching, pixels(input, 5));
        add_line(output.lines_on_top, contact.point, contact.point - contact.impulse * reach, pushed,
                 pixels(input, 1.2f));
        ++count;
    }
    legend.entries.push_back({touching, known ? "contacts: " + std::to_string(count) : "contacts: not known"});
    if (count > 0) {
        const std::string centimeters = short_number(100 * longest * input.size);
        legend.entries.push_back({pushed, "push: " + centimeters + " cm is " + short_number(1e3 * scale) + " mN s"});
    }
}

// Pinned particles are where they were put.
void draw_penetrations(const OverlayInput& input, OverlayOutput& output, Legend& legend) {
    double deepest = 0;
    std::size_t count = 0;
    for (const ClothFrame& cloth : input.frame.cloths) {
        for (const Vec4& particle : cloth.positions) {
            if (!(particle.w > 0) || !finite(particle.xyz())) continue;
            for (const Collider& collider : input.world.colliders()) {
                Vec3 out;
                const double depth = -signed_distance(collider, particle.xyz(), out);
                if (!(depth > depth_that_counts)) continue;
                add_point(output.points, particle.xyz(), beyond, pixels(input, 7));
                add_line(output.lines_on_top, particle.xyz(), particle.xyz() + out * static_cast<float>(depth), beyond,
                         pixels(input, 2));
                deepest = std::max(deepest, depth);
                ++count;
            }
        }
    }
    std::string text = "beyond a surface: " + std::to_string(count);
    if (count > 0) text += ", deepest " + short_number(1e3 * deepest) + " mm";
    legend.entries.push_back({beyond, std::move(text)});
}

}  // namespace

void contacts(const OverlayInput& input, OverlayOutput& output) {
    Legend legend{.title = "contacts"};
    draw_touches(input, output, legend);
    draw_penetrations(input, output, legend);
    output.legends.push_back(std::move(legend));
}

}  // namespace weft::overlay
