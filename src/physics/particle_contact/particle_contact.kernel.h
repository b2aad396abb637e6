// Contact of two particles as spheres (law: particle_contact.md). cloth_contact.kernel.h supplies friction and quanta.

// The distance that two particles of one cloth keep: at most a part of their distance at rest, or that distance less a
// length, m, whichever is larger.
WEFT_FN real diameter_of_pair(real diameter, real distance_at_rest, real part_at_rest, real less_at_rest)
{
    return min(diameter, max(distance_at_rest * part_at_rest, distance_at_rest - less_at_rest));
}

// Whether the spheres overlap. `w0`, `w1`: inverse masses; nothing can move a pair that has none.
WEFT_FN mask spheres_overlap(vec3 x0, vec3 x1, real w0, real w1, real diameter)
{
    vec3 between = x0 - x1;
    return dot(between, between) < diameter * diameter && w0 + w1 > real(0);
}

// Part of a pair's resistance to a push that one particle has, 1/kg. The particle's mass is split among all pairs that
// push it: `pushes` is their number. `split`: 1 in full; with less, particles that many pairs push move farther.
WEFT_FN real sphere_resistance(real inverse_mass, real pushes, real split)
{
    return inverse_mass * max(real(1), pushes * split);
}

// From particle 1 to particle 0. Particles at one place have no direction; any unit vector will do.
WEFT_FN vec3 direction_of(vec3 between, real distance)
{
    return select(distance > real(0), between * (real(1) / max(distance, real(1e-30))),
                  vec3(real(0), real(1), real(0)));
}

// Particle 0 moves by the push times its inverse mass, particle 1 the other way.
struct SpherePush {
    vec3 push;   // kg m
    real depth;  // m, by which both are to be pushed apart
};

//   start0, start1  the particles at the start of the substep
//   deep            m, only pairs nearer than this are pushed
//   recovery        m, the most of an overlap from before the substep that one substep removes
//   resistance      1/kg, of both particles
WEFT_FN SpherePush push_spheres(vec3 x0, vec3 x1, vec3 start0, vec3 start1, real diameter, real deep,
                                real recovery, real resistance, real static_friction, real kinetic_friction)
{
    vec3 between = x0 - x1, before = start0 - start1;
    real distance = sqrt(dot(between, between)), distance_start = sqrt(dot(before, before));
    vec3 normal = direction_of(between, distance);
    SpherePush result;
    result.depth = select(distance < deep, max(min(diameter, distance_start + recovery) - distance, real(0)), real(0));
    vec3 rub = cloth_friction(between - before, normal, result.depth, static_friction, kinetic_friction);
    result.push = (normal * result.depth - rub) * (real(1) / max(resistance, real(1e-12)));
    return result;
}

// What takes the motion away by which pushes have separated the particles, kg m. `depth`: of all pushes, m.
WEFT_FN vec3 hold_spheres(vec3 x0, vec3 x1, vec3 start0, vec3 start1, real depth, real resistance)
{
    vec3 between = x0 - x1, before = start0 - start1;
    vec3 normal = direction_of(between, sqrt(dot(between, between)));
    real opened = min(max(dot(between - before, normal), real(0)), depth);
    return normal * (opened * (real(1) / max(resistance, real(1e-12))));
}
