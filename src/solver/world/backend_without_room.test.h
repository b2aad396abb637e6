#pragma once

#include "solver/world/backend.h"

#include <array>
#include <memory>
#include <string>
#include <utility>

namespace weft {

/// A backend in which one change of a model or of its topology fails, for tests.
class BackendWithoutRoom final : public Backend {
  public:
    BackendWithoutRoom(std::unique_ptr<Backend> inner, const int& room) : inner_(std::move(inner)), room_(room) {}

    std::string_view name() const override { return inner_->name(); }
    std::string device() const override { return inner_->device(); }
    unsigned threads() const override { return inner_->threads(); }
    Result<ClothHandle> add_cloth(std::shared_ptr<const ClothModel> model, std::uint32_t base) override {
        return inner_->add_cloth(std::move(model), base);
    }
    void remove_cloth(ClothHandle cloth) override { inner_->remove_cloth(cloth); }
    Result<void> set_model(ClothHandle cloth, std::shared_ptr<const ClothModel> model, std::uint32_t base) override {
        if (count_++ == room_) return Error::of_machine("device", "has no room");
        return inner_->set_model(cloth, std::move(model), base);
    }
    Result<void> set_material(ClothHandle cloth, std::shared_ptr<const ClothModel> model) override {
        if (count_++ == room_) return Error::of_machine("device", "has no room");
        return inner_->set_material(cloth, std::move(model));
    }
    Result<void> place_points(ClothHandle cloth, std::uint32_t first, std::span<const Vec3> places) override {
        return inner_->place_points(cloth, first, places);
    }
    Result<void> set_topology(ClothHandle cloth, std::shared_ptr<const ClothModel> model,
                              std::span<const std::uint32_t> copied) override {
        if (count_++ == room_) return Error::of_machine("device", "has no room");
        return inner_->set_topology(cloth, std::move(model), copied);
    }
    void step(const WorldStep& step) override { inner_->step(step); }
    Result<void> set_weights(ClothHandle cloth, std::span<const ParticleWeight> changed) override {
        return inner_->set_weights(cloth, changed);
    }
    void finish(std::array<double, stage_count>& stage_ms) override { inner_->finish(stage_ms); }
    ListCounts list_counts() const override { return inner_->list_counts(); }
    ClothContactCounts cloth_contact_counts() const override { return inner_->cloth_contact_counts(); }
    bool read(ClothHandle cloth, ClothFrame& frame) const override { return inner_->read(cloth, frame); }
    void measure(ClothHandle cloth, MeasureSums& sums) const override { inner_->measure(cloth, sums); }
    ClothSnapshot save(ClothHandle cloth) const override { return inner_->save(cloth); }
    Result<void> restore(ClothHandle cloth, const ClothSnapshot& snapshot) override {
        return inner_->restore(cloth, snapshot);
    }
    void hash(ClothHandle cloth, StateHash& hash) const override { inner_->hash(cloth, hash); }

  private:
    std::unique_ptr<Backend> inner_;
    const int& room_;  ///< number of the failing call of set_model(), set_material() or set_topology(), from 0
    int count_ = 0;
};

}  // namespace weft
