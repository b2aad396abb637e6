#include "solver/world/collider_mesh.h"
#include "view/nice_numbers.h"
#include "view/overlay_parts.h"
#include "view/touches.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace weft::overlay {
namespace {

constexpr Vec4 touching{0.2f, 0.9f, 0.35f, 1}, of_faces{0.2f, 0.75f, 1.0f, 1}, pushed{1.0f, 0.85f, 0.2f, 1},
    beyond{1.0f, 0.12f, 0.1f, 1};

// m: larger than the rounding error of a particle on a surface.
constexpr double depth_that_counts = 1e-5;

// Length of the line for the largest impulses, relative to the scene's radius.
constexpr float longest_arrow = 0.2f;

// Draws the impulse on the cloth, which points out of the surface.
void draw_touches(const OverlayInput& input, OverlayOutput& output, Legend& legend) {
    // Contacts of another frame do not match the drawn positions.
    if (!has_contacts_of(input.world, input.frame)) {
        legend.entries.push_back({touching, "contacts: not known"});
        return;
    }
    const std::vector<Touch> touches = touches_of(input.world, input.frame);
    std::vector<float> sizes;
    for (const Touch& touch : touches) sizes.push_back(length(touch.impulse));
    const double scale = nice_above(percentile(std::move(sizes), 0.98));  // N·s
    const float reach = longest_arrow * input.size / static_cast<float>(scale);
    std::size_t faces = 0;
    for (const Touch& touch : touches) {
        add_point(output.points, touch.point, touch.of_face ? of_faces : touching, pixels(input, 5));
        add_line(output.lines_on_top, touch.point, touch.point + touch.impulse * reach, pushed, pixels(input, 1.2f));
        faces += touch.of_face;
    }
    legend.entries.push_back({touching, "contacts of particles: " + std::to_string(touches.size() - faces)});
    legend.entries.push_back({of_faces, "contacts of faces: " + std::to_string(faces)});
    if (touches.empty()) return;
    const std::string centimeters = short_number(100 * longest_arrow * input.size);
    legend.entries.push_back({pushed, "push: " + centimeters + " cm is " + short_number(1e3 * scale) + " mN s"});
}

/// A collider that particles of a cloth may be inside of.
struct NearCollider {
    const Collider* collider;
    Bounds box;  // empty: unbounded
};

std::vector<NearCollider> colliders_near(const ClothFrame& cloth, const std::vector<Collider>& colliders) {
    Bounds around;
    for (const Vec4& particle : cloth.positions)
        if (finite(particle.xyz())) around.include(particle.xyz());
    std::vector<NearCollider> near;
    for (const Collider& collider : colliders) {
        const Bounds box = bounds_of(collider);
        if (shape_acts_on(collider, *cloth.model) && (box.empty() || box.overlaps(around)))
            near.push_back({&collider, box});
    }
    return near;
}

// Skips pinned particles, because collisions do not move them.
void draw_penetrations(const OverlayInput& input, OverlayOutput& output, Legend& legend) {
    double deepest = 0;
    std::size_t count = 0;
    for (const ClothFrame& cloth : input.frame.cloths) {
        const std::vector<NearCollider> near = colliders_near(cloth, input.world.colliders());
        for (const Vec4& particle : cloth.positions) {
            const Vec3 at = particle.xyz();
            if (!(particle.w > 0) || !finite(at)) continue;
            for (const auto& [collider, box] : near) {
                if (!box.empty() && !box.contains(at)) continue;
                Vec3 out;
                const double depth = -signed_distance(*collider, at, out);
                if (!(depth > depth_that_counts)) continue;
                add_point(output.points, at, beyond, pixels(input, 7));
                add_line(output.lines_on_top, at, at + out * static_cast<float>(depth), beyond, pixels(input, 2));
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
