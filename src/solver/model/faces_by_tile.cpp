#include "solver/model/faces_by_tile.h"

#include "mesh/grouping.h"
#include "solver/model/constraint_table.h"

#include <algorithm>

namespace weft {

FacesByTile lay_out_by_tile(const TriangleView& triangles, std::uint32_t particles) {
    auto groups = group_items<std::uint32_t>(padded(particles) / lane_padding, [&](auto put) {
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            const auto [a, b, c] = triangles[t];
            if (a != b) put(std::min({a, b, c}) / lane_padding, t);
        }
    });
    FacesByTile faces;
    faces.begin = std::move(groups.offsets);
    faces.stride = padded(faces.begin.back()) + lane_padding;
    faces.corners.resize(std::size_t{3} * faces.stride);
    for (std::size_t tile = 0; tile + 1 < faces.begin.size(); ++tile)
        faces.most_in_tile = std::max(faces.most_in_tile, faces.begin[tile + 1] - faces.begin[tile]);
    faces.place.assign(triangles.size(), none);
    for (std::size_t i = 0; i < groups.items.size(); ++i) {
        faces.place[groups.items[i]] = static_cast<std::uint32_t>(i);
        const auto corners = triangles[groups.items[i]];
        for (std::size_t k = 0; k < 3; ++k) faces.corners[k * faces.stride + i] = corners[k];
    }
    return faces;
}

}  // namespace weft
