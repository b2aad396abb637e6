#include "vulkan/links.h"

namespace weft::vulkan {

Result<LinkBuffers> LinkBuffers::create(gpu::Device& device, const LinkTables& tables, const WorldPlan& plan) {
    LinkBuffers links;
    for (std::uint32_t kind = 0; kind < constraint_kind_count; ++kind) {
        const ConstraintTable& from = tables[kind];
        if (from.batches.empty()) continue;
        links.tables_[kind] = {.particles = links.arena_.add_array(from.particles),
                               .fields = links.arena_.add_array(from.fields),
                               .lambda = {},
                               .stride = from.stride,
                               .batches = from.batches};
        if (rounds_of_links(plan) > 1)
            links.tables_[kind].lambda = links.arena_.reserve(from.lambda_count() * sizeof(float));
    }
    if (links.arena_.size() == 0) return links;
    if (auto built = links.arena_.build(device, "constraints between cloths"); !built) return built.errors();
    return links;
}

}  // namespace weft::vulkan
