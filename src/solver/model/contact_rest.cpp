#include "solver/model/contact_rest.h"

#include "solver/model/tear_table.h"

#include <vector>

namespace weft {

SharedArray<Vec4> rest_for_contact(const ClothModel& model) {
    if (!model.tears || model.copied_from.empty()) return model.start;
    const TearTable& table = *model.tears;
    std::vector<bool> has_parted(table.vertex_count());
    for (std::uint32_t from : model.copied_from) {
        while (from >= table.vertex_count()) from = model.copied_from[from - table.vertex_count()];
        has_parted[from] = true;
    }
    struct Sum {
        Vec3 centers{};
        float count = 0;
    };
    std::vector<Sum> sums(model.particle_count);
    for (const TearTable::Entry& entry : table.entries) {
        const auto [a, b, c] = model.triangles()[entry.corner % model.face_stride];
        if (!has_parted[entry.vertex] || a == b) continue;
        Sum& sum = sums[model.faces[entry.corner]];
        sum.centers =
            sum.centers + (model.rest_position(a) + model.rest_position(b) + model.rest_position(c)) * (1.0f / 3);
        ++sum.count;
    }
    AlignedVector<Vec4> rest(model.start.begin(), model.start.end());
    for (std::uint32_t p = 0; p < model.particle_count; ++p) {
        if (sums[p].count == 0) continue;
        const Vec3 mean = sums[p].centers * (1 / sums[p].count);
        rest[p] = {mean.x, mean.y, mean.z, rest[p].w};
    }
    return rest;
}

}  // namespace weft
