#include "solver/world/islands.h"

#include "base/disjoint_sets.h"

#include <algorithm>

namespace weft {

std::vector<std::vector<std::uint32_t>> group_islands(std::uint32_t count,
                                                      std::span<const std::array<std::uint32_t, 2>> ties) {
    DisjointSets sets(count);
    for (const auto& [a, b] : ties) sets.merge(a, b);
    return sets.sets();
}

LinkTables make_links(std::span<const PlacedStitch> stitches, std::uint32_t first_dummy) {
    LinkTables tables;
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind)
        tables[kind].kind = static_cast<ConstraintKind>(kind);
    RowList rows = make_rows(ConstraintKind::stitch);
    for (const PlacedStitch& stitch : stitches) add_stitch(rows, stitch.from, stitch.to, stitch.gap, stitch.compliance);
    if (rows.size() == 0) return tables;

    // Coloring numbers only the particles of the island, because the world may have many. An unused slot gets the first
    // particle of its stitch, since a constraint may name a particle twice.
    std::vector<std::uint32_t> particles = rows.particles;
    for (std::size_t i = 0; i < particles.size(); ++i)
        if (particles[i] == no_particle) particles[i] = particles[i - i % rows.arity];
    std::vector<std::uint32_t> numbers = particles;
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    for (std::uint32_t& p : particles)
        p = static_cast<std::uint32_t>(std::ranges::lower_bound(numbers, p) - numbers.begin());
    const Coloring coloring = color_rows(particles, rows.arity, static_cast<std::uint32_t>(numbers.size()));
    tables[static_cast<std::uint32_t>(ConstraintKind::stitch)] =
        pack_rows_with_dummies(ConstraintKind::stitch, rows, first_dummy, coloring);
    return tables;
}

}  // namespace weft
