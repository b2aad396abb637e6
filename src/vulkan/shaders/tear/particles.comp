#version 450
// Passes of tearing over all particles, those in reserve included.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/tear/tear_cloth.glsl"

// Once a frame: which particles are looked at in every substep.
void run_watch(uint p)
{
    TearCloth c = TearCloth(0u);
    if (p == 0u) {
        tear_head.particles = tear_data.first_particles;
        tear_head.openings = 0u;
        tear_head.candidates = 0u;
    }
    bool watched = false;
    if (p < tear_data.first_particles) {
        watched = tear_is_end(c, p);
        uint vertex = tear_vertex_of(c, p);
        for (uint i = tear_ring(c, vertex); i < tear_ring(c, vertex + 1u) && !watched; ++i)
            if (tear_face(c, tear_corner(c, i)) == p)
                watched = tear_is_hot(c, tear_triangle(c, tear_corner(c, i)), tear_data.watched_part);
    }
    tear_data.watched.at[p] = watched ? 1u : 0u;
    tear_data.chosen.at[p] = 0u;
}

// In every substep: the load of each of these, and a list of those above their limit.
void run_load(uint p)
{
    TearCloth c = TearCloth(0u);
    if (p >= tear_head.particles || !tear_is_watched(c, p)) return;
    TearLoad at = tear_load(c, p);
    if (!(tear_data.weights.at[p] > 0.0)) at.load = 0.0;   // a pinned particle stays whole; cloth tears beside it
    tear_data.loads.at[p] = vec4(at.load, at.x, at.y, (at.end ? 1.0 : 0.0) + (at.seam ? 2.0 : 0.0));
    if (at.load >= 1.0) tear_data.list.at[atomicAdd(tear_head.candidates, 1u)] = p;
}

void main()
{
    uint p = invocation();
    if (p < tear_data.all_particles) WEFT_PASS(p);
}
