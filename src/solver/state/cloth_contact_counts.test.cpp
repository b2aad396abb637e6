// Counts of cloth against cloth: over a run, and from the backend to the frame.
#include "solver/state/cloth_contact_counts.h"

#include "solver/world/world.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// A backend of a world without cloths. It counts its frames.
class CountingBackend final : public Backend {
  public:
    std::string_view name() const override { return "counting"; }
    std::string device() const override { return "none"; }
    unsigned threads() const override { return 1; }
    Result<ClothHandle> add_cloth(std::shared_ptr<const ClothModel>, std::uint32_t) override { return no_cloths(); }
    void remove_cloth(ClothHandle) override {}
    Result<void> set_model(ClothHandle, std::shared_ptr<const ClothModel>, std::uint32_t) override {
        return no_cloths();
    }
    Result<void> set_material(ClothHandle, std::shared_ptr<const ClothModel>) override { return no_cloths(); }
    Result<void> set_topology(ClothHandle, std::shared_ptr<const ClothModel>, std::span<const std::uint32_t>) override {
        return no_cloths();
    }
    Result<void> place_points(ClothHandle, std::uint32_t, std::span<const Vec3>) override { return no_cloths(); }
    Result<void> set_weights(ClothHandle, std::span<const ParticleWeight>) override { return no_cloths(); }
    void step(const WorldStep&) override { ++frames_; }
    void finish(std::array<double, stage_count>&) override { finished_ = frames_; }
    ListCounts list_counts() const override { return {}; }
    ClothContactCounts cloth_contact_counts() const override {
        return {.contacts = 10 * finished_, .searches = finished_, .limited = 2, .tangled = finished_ == 2 ? 7u : 1u};
    }
    bool read(ClothHandle, ClothFrame&) const override { return false; }
    void measure(ClothHandle, MeasureSums&) const override {}
    ClothSnapshot save(ClothHandle) const override { return {}; }
    Result<void> restore(ClothHandle, const ClothSnapshot&) override { return no_cloths(); }
    void hash(ClothHandle, StateHash&) const override {}

  private:
    static Error no_cloths() { return {"cloth", "is not possible here"}; }

    std::uint64_t frames_ = 0, finished_ = 0;
};

TEST(ClothContactCounts, of_a_frame_are_those_of_the_backend) {
    World world(std::make_unique<CountingBackend>(), {});
    EXPECT_EQ(world.summary().cloth_contacts, ClothContactCounts{});
    ClothContactCounts run;
    for (std::uint64_t i = 1; i <= 3; ++i) {
        world.advance(1.0 / 60);
        EXPECT_EQ(world.summary().cloth_contacts.contacts, 10 * i) << "it waits for the frame";
        run.add(world.summary().cloth_contacts);
    }
    EXPECT_EQ(run, (ClothContactCounts{.contacts = 30, .searches = 1 + 2 + 3, .limited = 6, .tangled = 7}));
}

}  // namespace
}  // namespace weft
