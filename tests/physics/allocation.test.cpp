// Repeated steps allocate no memory, for every projection, with air, pins and colliders. Only a growing contact log
// allocates, on the calling thread.

#include "sheet.h"

#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>

// The sanitizers replace operator new themselves.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WEFT_COUNTS 0
#elif defined(__has_feature)
#define WEFT_COUNTS !(__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define WEFT_COUNTS 1
#endif

namespace {
std::atomic<std::uint64_t> allocations{0}, on_workers{0};
thread_local bool is_worker = true;  // until a test says that it is its own thread
#if WEFT_COUNTS

void* counted(std::size_t size, std::size_t alignment) {
    ++allocations;
    if (is_worker) ++on_workers;
    void* memory = alignment > alignof(std::max_align_t)
                       ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                       : std::malloc(size > 0 ? size : 1);
    if (!memory) throw std::bad_alloc();
    return memory;
}
#endif
}  // namespace

#if WEFT_COUNTS

// Replaces operator new of the whole program to count allocations. Not inlined, because GCC would warn of free() of
// memory from operator new.
void* operator new(std::size_t size) {
    return counted(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

#endif

namespace weft::physical {
namespace {

// Labels: slow no-asan
TEST(Allocation, is_over_when_the_first_frame_is) {
    if (!WEFT_COUNTS) GTEST_SKIP() << "a sanitizer counts here";
    for (const Projection projection : {Projection::lines, Projection::gauss_seidel, Projection::jacobi}) {
        for (const auto& [workers, cloths] : {std::pair(0u, 1), {1u, 1}, {1u, 3}}) {
            World world = make_world(
                {.solver = {.substeps = 3, .iterations = 2, .projection = projection, .hierarchy = true},
                 .air = AirDesc{.wind = {{.velocity = {3, 0, 1}, .shelter = 1, .turbulence = {.strength = 0.4f}},
                                         {.kind = VortexDesc{}, .motion = {{.time = 0}, {.time = 1}}}}}},
                {.workers = workers});
            const ColliderId ball =
                world.add(make_collider({.shape = SphereDesc{0.2f}, .motion = {{0, {}, {}}, {9, {1, 0, 0}, {}}}}));
            const auto model =
                make_sheet({.resolution = {24, 24}, .layout = world.settings().layout(), .pinned = [](Vec3 p) {
                                return p.x < -0.49f && p.z < -0.49f;
                            }});
            const Vec3 corner = model->rest_position(0);
            for (int cloth = 0; cloth < cloths; ++cloth)
                world.add(model, {.motions = {{.collider = ball}}, .particles = {{0, 0, corner}}});
            world.step(1.0 / 60);
            const std::uint64_t before = allocations;
            for (int i = 0; i < 10; ++i) world.step(1.0 / 60);
            EXPECT_EQ(allocations - before, 0u) << workers << " workers, " << cloths << " cloths";
        }
    }
    const std::uint64_t before = allocations;
    int* volatile one = new int;
    delete one;
    EXPECT_GT(allocations, before) << "it does count";
}

TEST(Allocation, of_an_account_of_contacts_is_the_calling_threads) {
    if (!WEFT_COUNTS) GTEST_SKIP() << "a sanitizer counts here";
    is_worker = false;
    for (const auto& [workers, cloths] : {std::pair(1u, 1u), {2u, 5u}}) {  // all threads on one, and one thread each
        World world = make_world({.solver = {.substeps = 2}, .contact_forces = true}, {.workers = workers});
        world.add(make_collider({.shape = SphereDesc{0.3f}}));
        world.add(make_collider({.shape = PlaneDesc{.offset = -0.3f}}));
        const auto model = make_sheet({.resolution = {32, 32}, .position = {0, 0.35f, 0}});
        for (unsigned cloth = 0; cloth < cloths; ++cloth) world.add(model);
        world.step(1.0 / 60);  // the runtime's own, at a thread's first task
        const std::uint64_t before = on_workers;
        std::size_t least = world.contact_forces().contacts.size(), most = least;
        for (int i = 0; i < 30; ++i) {
            world.step(1.0 / 60);
            most = std::max(most, world.contact_forces().contacts.size());
        }
        EXPECT_EQ(on_workers - before, 0u) << cloths << " cloths";
        EXPECT_EQ(least, 0u) << "it has not fallen yet";
        EXPECT_GT(most, 200u * cloths) << "all that it touches has been listed";
    }
    std::jthread([] {
        const std::uint64_t before = on_workers;
        int* volatile one = new int;
        delete one;
        EXPECT_GT(on_workers, before) << "it does count";
    }).join();
}

}  // namespace
}  // namespace weft::physical
