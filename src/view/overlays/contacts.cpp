#include "view/nice_numbers.h"
#include "view/overlay_parts.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace weft::overlay {
namespace {

constexpr Vec4 touching{0.2f, 0.9f, 0.35f, 1}, pushed{1.0f, 0.85f, 0.2f, 1}, beyond{1.0f, 0.12f, 0.1f, 1};

// m: larger than the rounding error of a particle on a surface.
constexpr double depth_that_counts = 1e-5;

// Length of the line for the largest impulses, relative to the scene's radius.
constexpr float longest_arrow = 0.2f;

// Draws the impulse on the cloth, which points out of the surface: the opposite of the impulse on the collider.
void draw_touches(const OverlayInput& input, OverlayOutput& output, Legend& legend) {
    const ContactForces& forces = input.world.contact_forces();
    // Contacts of another frame do not match the drawn positions.
    const bool known = forces.frame > 0 && forces.frame == input.frame.index;
    std::size_t count = 0;
    std::vector<float> sizes;
    for (const Contact& contact : forces.contacts) sizes.push_back(length(contact.impulse));
    const double scale = nice_above(percentile(std::move(sizes), 0.98));  // N·s
    const float reach = longest_arrow * input.size / static_cast<float>(scale);
    for (const Contact& contact : forces.contacts) {
        if (!known) break;
        add_point(output.points, contact.point, touching, pixels(input, 5));
        add_line(output.lines_on_top, contact.point, contact.point - contact.impulse * reach, pushed,
                 pixels(input, 1.2f));
        ++count;
    }
    legend.entries.push_back({touching, known ? "contacts: " + std::to_string(count) : "contacts: not known"});
    if (count > 0) {
        const std::string centimeters = short_number(100 * longest_arrow * input.size);
        legend.entries.push_back({pushed, "push: " + centimeters + " cm is " + short_number(1e3 * scale) + " mN s"});
    }
}

// Skips pinned particles, because collisions do not move them.
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
