#version 450
// Passes with a single invocation: they compute the sizes of the following ones.
#extension GL_GOOGLE_include_directive : require
#include "vulkan/shaders/cloth_contact/contact.glsl"

GroupsIn groups_of(uint groups)
{
    uint wide = max(min(groups, contact.widest), 1u);
    return GroupsIn(wide, (groups + wide - 1u) / wide, 1u);
}
uint filled(uint items) { return (items + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x; }

// A list that is too short makes the frame run again.
void require(uint wanted, uint capacity)
{
    if (wanted <= capacity) return;
    for (uint m = 0u; m < contact.report_count; ++m)
        atomicOr(Uints(contact.reports.at[m]).at[0], WEFT_REPORT_LIST_FULL);
}

// `round`: the substep.
void run_begin()
{
    head.tick += 1u;
    head.substep = args.round;
    head.outdated = 0u;
    head.tile_pairs = 0u;
    head.near0 = 0u;
    head.near1 = 0u;
    head.near_groups0 = groups_of(0u);
    head.near_groups1 = groups_of(0u);
    head.brakes = 0u;
    head.uncovered = 0u;
    head.contacts = 0u;
    for (uint i = 0u; i < WEFT_CONTACT_EXTRA_SWEEPS; ++i) head.lost[i] = 0u;
    for (uint i = 0u; i < 2u * WEFT_LIMIT_ROUNDS; ++i) head.sent_back[i] = 0u;
    for (uint i = 0u; i < 2u * WEFT_LIMIT_ROUNDS; ++i) head.stuck[i] = 0u;
    if (args.round > 0u) return;
    head.searches = 0u;
    head.limited = 0u;
    head.tangled = 0u;
    head.tangled_particle = 0xffffffffu;
    head.wanted_tile_pairs = 0u;
    head.wanted_listed = 0u;
    head.wanted_near = 0u;
}

// If particles were slowed, near pairs are chosen anew.
void run_end_brake()
{
    if (head.brakes == 0u) return;
    head.outdated = 0u;
    head.near0 = 0u;
}

// Pairs of tiles that stay valid move to the other half of the list, and new ones are added there.
void run_begin_search()
{
    bool searches = !is_idle_search() && (args.search == WEFT_SEARCH_ANYWHERE || head.outdated == 1u);
    head.keep_groups = groups_of(searches ? filled(listed_count(head.list)) : 0u);
    head.list_groups = groups_of(searches ? min(head.tile_pairs, contact.tile_pair_capacity) : 0u);
    if (!searches) return;
    head.wanted_tile_pairs = max(head.wanted_tile_pairs, head.tile_pairs);
    require(head.tile_pairs, contact.tile_pair_capacity);
    head.list = 1u - head.list;
    if (head.list == 0u) head.listed0 = 0u;
    else head.listed1 = 0u;
    ++head.searches;
}

void run_end_search()
{
    uint wanted = head.list == 0u ? head.listed0 : head.listed1;
    head.listed_groups = groups_of(!is_idle_search() ? filled(listed_count(head.list)) : 0u);
    head.wanted_listed = max(head.wanted_listed, wanted);
    require(wanted, contact.listed_capacity);
    head.tile_pairs = 0u;  // for the next search
}

void run_end_near()
{
    if (is_idle_search()) return;
    uint wanted = args.search == 0u ? head.near0 : head.near1;
    if (args.search == 0u) head.near_groups0 = groups_of(filled(near_count()));
    else head.near_groups1 = groups_of(filled(near_count()));
    head.wanted_near = max(head.wanted_near, wanted);
    require(wanted, contact.near_capacity);
}

void main()
{
    if (invocation() == 0u) WEFT_PASS();
}
