#include "vulkan/seams.h"

#include <algorithm>

namespace weft::vulkan {

static_assert(sizeof(SeamEntry) == 12, "as SeamEntryIn of seams.data.h");

SeamArrays::SeamArrays(std::span<const Seams* const> seams, std::uint64_t end) {
    std::vector<const Seams*> islands;
    for (const Seams* one : seams)
        if (one && std::ranges::find(islands, one) == islands.end()) islands.push_back(one);
    if (islands.empty()) return;
    // The particles of two islands may alternate, and so do their entries.
    std::uint32_t seam = 0;
    std::vector<std::uint32_t> first_seam;  // by island: numbers of seams are below that of the next island
    for (const Seams* one : islands) {
        first_seam.push_back(seam);
        for (const SeamEntry& entry : one->entries()) seam = std::max(seam, first_seam.back() + entry.seam + 1);
    }
    for (std::uint32_t p = 0; p < end; ++p) {
        first_.push_back(static_cast<std::uint32_t>(entries_.size()));
        for (std::size_t i = 0; i < islands.size(); ++i) {
            const Seams& one = *islands[i];
            if (p < one.base() || p - one.base() + 1 >= one.first().size()) continue;
            for (std::uint32_t k = one.first()[p - one.base()]; k < one.first()[p - one.base() + 1]; ++k) {
                entries_.push_back(one.entries()[k]);
                entries_.back().seam += first_seam[i];
            }
        }
    }
    first_.push_back(static_cast<std::uint32_t>(entries_.size()));
}

}  // namespace weft::vulkan
