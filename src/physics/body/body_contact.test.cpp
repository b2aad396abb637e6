#include "physics/testing.h"

#include <algorithm>

namespace weft {
namespace {

using namespace testing_kernels;
using reference::MovedBody;

// With any symmetric positive tensor.
MovedBody random_body(Random& random) {
    MovedBody body;
    body.contacts = random.number(1, 9);
    body.inverse_mass = random.number(0.1, 5);
    body.center = random.vector(1);
    vec3 columns[3] = {vec3(0, 0, 0), vec3(0, 0, 0), vec3(0, 0, 0)};
    for (int i = 0; i < 3; ++i) {
        const vec3 axis = random.vector(3);
        columns[0] = columns[0] + axis * axis.x;
        columns[1] = columns[1] + axis * axis.y;
        columns[2] = columns[2] + axis * axis.z;
    }
    body.ix = columns[0], body.iy = columns[1], body.iz = columns[2];
    return body;
}

TEST(AttachedPoint, weighs_as_much_as_along_the_direction_in_which_the_body_gives_way_most) {
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        const MovedBody body = random_body(random);
        const vec3 lever = random.vector(1);
        const double most = reference::most_weight_of(body, lever);
        double largest = 0;
        for (int k = 0; k < 3000; ++k) {
            const vec3 way = random.vector(1);
            const double weight = reference::weight_of(body, lever, way * (1 / norm(way)));
            EXPECT_LE(weight, most * (1 + 1e-12));
            largest = std::max(largest, weight);
        }
        EXPECT_GT(largest, 0.97 * most);
    }
}

TEST(AttachedPoint, at_the_center_has_the_mass_of_its_part_of_the_body) {
    Random random(2);
    const MovedBody body = random_body(random);
    EXPECT_EQ(reference::most_weight_of(body, vec3(0, 0, 0)), body.contacts * body.inverse_mass);
}

}  // namespace
}  // namespace weft
