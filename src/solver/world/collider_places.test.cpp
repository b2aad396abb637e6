#include "solver/world/collider_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

namespace weft {
namespace {

class Random {
  public:
    float number(float min, float max) {
        return min + (max - min) * static_cast<float>(engine_() % 1000003) / 1000003.0f;
    }
    Vec3 vector(float size) { return {number(-size, size), number(-size, size), number(-size, size)}; }

  private:
    std::mt19937 engine_{5};
};

// Every shape, at rest, moved by keys and moved by a program.
std::vector<Collider> many_colliders(Random& random) {
    std::vector<Collider> all;
    for (int i = 0; i < 300; ++i) {
        ColliderDesc desc{.transform = {.position = random.vector(3), .rotation_degrees = random.vector(180)}};
        const float size = random.number(0.02f, 0.3f);
        if (i % 4 == 0) desc.shape = SphereDesc{size};
        if (i % 4 == 1) desc.shape = BoxDesc{{size, size * 0.3f, size * 2}};
        if (i % 4 == 2) desc.shape = CapsuleDesc{size, 2 * size};
        if (i % 4 == 3 && i % 20 == 3) desc.shape = PlaneDesc{.normal = {0.3f, 1, 0}, .offset = -size};
        if (i % 3 == 1)
            desc.motion = {{0, random.vector(3), random.vector(180)},
                           {0.01f, random.vector(3), random.vector(180)},  // within the first frame
                           {1, random.vector(3), random.vector(180)}};
        all.push_back(make_collider(desc));
        if (i % 3 == 2) all.back().next_pose = Pose{rotation_from_degrees(random.vector(180)), random.vector(3)};
    }
    return all;
}

TEST(ColliderPlaces, find_every_collider_that_touches_the_box) {
    Random random;
    std::vector<Collider> colliders = many_colliders(random);
    ColliderPlaces places;
    constexpr std::uint32_t substeps = 5;
    for (int frame = 0; frame < 3; ++frame) {
        places.begin_frame(colliders, frame / 60.0, 1.0 / 60, substeps);
        std::size_t touching = 0, listed = 0;
        for (int i = 0; i < 100; ++i) {
            const Vec3 center = random.vector(3), half{0.1f, 0.05f, 0.2f};
            const Bounds box{center - half, center + half};
            std::vector<std::uint32_t> found;
            places.find(box, found);
            EXPECT_TRUE(std::ranges::is_sorted(found));
            EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
            listed += found.size();
            for (std::uint32_t c = 0; c < colliders.size(); ++c) {
                Collider there = colliders[c];
                bool touches = false;
                for (std::uint32_t substep = 0; substep <= substeps && !touches; ++substep) {
                    there.pose = places.pose(c, substep);
                    for (int corner = 0; corner < 27 && !touches; ++corner) {
                        const auto part = [&](int divisor) { return static_cast<float>(corner / divisor % 3 - 1); };
                        const Vec3 at = center + Vec3{part(1) * half.x, part(3) * half.y, part(9) * half.z};
                        touches = signed_distance(there, at) < 0;
                    }
                }
                if (!touches) continue;
                ++touching;
                EXPECT_TRUE(std::ranges::binary_search(found, c)) << "collider " << c << ", frame " << frame;
            }
        }
        EXPECT_GT(touching, 100u);
        EXPECT_LT(listed, touching * 12) << "it leaves most of the others out";
        for (std::size_t c = 0; c < colliders.size(); ++c) {
            colliders[c].pose = places.end_pose(c);
            colliders[c].next_pose.reset();
        }
    }
}

TEST(ColliderPlaces, poses_follow_keys_and_moves) {
    Random random;
    std::vector<Collider> colliders = many_colliders(random);
    ColliderPlaces places;
    places.begin_frame(colliders, 0.5, 0.1, 4);
    for (std::size_t c = 0; c < colliders.size(); ++c) {
        for (std::uint32_t substep = 0; substep <= 4; ++substep) {
            const Collider& collider = colliders[c];
            const Pose expected = collider.next_pose
                                      ? between(collider.pose, *collider.next_pose, static_cast<float>(substep) / 4)
                                      : pose_at(collider, 0.5 + 0.1 * substep / 4);
            EXPECT_EQ(places.pose(c, substep), expected);
        }
        EXPECT_EQ(places.end_pose(c), places.pose(c, 4));
    }
}

TEST(ColliderPlaces, a_collider_that_is_moved_for_the_first_time_is_found_where_it_goes) {
    std::vector<Collider> colliders{make_collider({.shape = SphereDesc{0.1f}})};
    ColliderPlaces places;
    const Bounds there{{4.9f, 0, 0}, {5, 0, 0}};
    std::vector<std::uint32_t> found;
    places.begin_frame(colliders, 0, 0.1, 2);
    places.find(there, found);
    EXPECT_TRUE(found.empty());
    colliders[0].next_pose = Pose{{}, {5, 0, 0}};
    places.begin_frame(colliders, 0.1, 0.1, 2);
    places.find(there, found);
    EXPECT_EQ(found.size(), 1u);
}

TEST(ColliderPlaces, list_what_is_nowhere_so_that_it_can_be_reported) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Collider> colliders{make_collider({.shape = SphereDesc{0.1f}}), make_collider({.shape = BoxDesc{}})};
    colliders[0].pose.position.x = nan;
    colliders[1].next_pose = Pose{{}, {nan, 0, 0}};
    ColliderPlaces places;
    places.begin_frame(colliders, 0, 0.1, 2);
    std::vector<std::uint32_t> found;
    places.find({{0, 0, 0}, {1, 1, 1}}, found);
    EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1}));
}

TEST(ColliderPlaces, survive_an_empty_world_and_an_empty_box) {
    ColliderPlaces places;
    std::vector<std::uint32_t> found;
    places.begin_frame({}, 0, 0.1, 2);
    places.find({{0, 0, 0}, {1, 1, 1}}, found);
    std::vector<Collider> colliders{make_collider({.shape = PlaneDesc{}})};
    places.begin_frame(colliders, 0, 0.1, 2);
    places.find({}, found);
    EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace weft
