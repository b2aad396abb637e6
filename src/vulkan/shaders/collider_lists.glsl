// Reads the world's colliders, their poses, and the lists of those near each tile of particles (colliders.data.h).
#ifndef WEFT_COLLIDER_LISTS_GLSL
#define WEFT_COLLIDER_LISTS_GLSL

// Pose after so many substeps of the frame.
PoseIn pose_after(CollidersRef world, ColliderIn collider, uint substeps)
{
    return world.at.poses.at[collider.first_pose + substeps * collider.pose_step];
}

bool is_body(ColliderIn collider) { return (collider.flags & WEFT_COLLIDER_BODY) != 0u; }

// `which`: WEFT_BODY_BEFORE, WEFT_BODY_NOW or WEFT_BODY_FOUND.
PoseIn pose_of_body(BodiesRef bodies, uint body, uint which)
{
    return bodies.at.poses.at[WEFT_BODY_POSES * body + which];
}

PoseIn pose_in_substep(CollidersRef world, ColliderIn collider, uint substep, bool at_end)
{
    if (is_body(collider))
        return pose_of_body(world.at.bodies, collider.body, at_end ? WEFT_BODY_NOW : WEFT_BODY_BEFORE);
    return pose_after(world, collider, at_end ? substep + 1u : substep);
}

// The collider as a place of the cloth, with this half of its thickness, meets it in a substep.
ContactBody body_of(CollidersRef world, ColliderIn collider, FrameRef frame, uint substep, float half_thickness)
{
    PoseIn now = pose_in_substep(world, collider, substep, true);
    PoseIn before = pose_in_substep(world, collider, substep, false);
    return ContactBody(now.x.xyz, now.y.xyz, now.z.xyz, now.position.xyz, before.x.xyz, before.y.xyz, before.z.xyz,
                       before.position.xyz, sqrt(frame.at.static_friction * collider.static_friction),
                       sqrt(frame.at.kinetic_friction * collider.kinetic_friction), half_thickness,
                       frame.at.depenetration);
}

// Whether the collider's shape acts on the cloth: shape_acts_on().
bool shape_acts(ColliderIn collider, FrameRef frame)
{
    return (collider.flags & WEFT_COLLIDER_SURFACE) == 0u || frame.at.meets_surfaces == 0u;
}

Solid solid_of(ColliderIn collider)
{
    ShapeNumbers numbers = ShapeNumbers(collider.numbers.x, collider.numbers.y, collider.numbers.z, collider.numbers.w,
                                        ShapeBlocks(collider.data));
    return Solid(int(collider.shape), numbers, collider.steepness, collider.roundness, collider.width);
}

// m, to the shape's surface; `local` is in the collider's frame of reference, as is the normal.
float distance_to(ColliderIn collider, vec3 local, out vec3 normal)
{
    return solid_distance(solid_of(collider), local, normal);
}

// The slots of the particle's tile: x ≤ slot < y. A slot holds the number of a collider, and its place in arrays of
// what contact adds up.
uvec2 slots_near(NearTileRef tiles, uint p)
{
    uint tile = p / WEFT_COLLIDER_TILE, first = tiles.at[tile].first;
    return uvec2(first, first + tiles.at[tile].count);
}
uint place_in_slot(uint slot, uint p) { return slot * WEFT_COLLIDER_TILE + p % WEFT_COLLIDER_TILE; }

#endif
