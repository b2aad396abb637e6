// What views, overlays and framing read of a world: its last frame, and the cloths and colliders of that frame.
#pragma once

#include "solver/world/world.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace weft {

/// Ids must name objects of the frame. Places are those of World: cloths and colliders in the order in which they were
/// added.
class WorldFrame {
  public:
    virtual ~WorldFrame() = default;

    virtual std::size_t cloth_count() const = 0;
    virtual ClothId cloth_id(std::size_t place) const = 0;
    virtual const std::shared_ptr<const ClothModel>& model(std::size_t place) const = 0;
    virtual bool contains(ClothId id) const = 0;
    virtual const KinematicTargets& kinematic_targets(ClothId id) const = 0;

    virtual const std::vector<Collider>& colliders() const = 0;
    virtual ColliderId collider_id(std::size_t place) const = 0;
    virtual bool contains(ColliderId id) const = 0;
    virtual const Collider& collider(ColliderId id) const = 0;

    /// Of a live world: waits for the device and reads the arrays back (World::frame).
    virtual const Frame& frame() const = 0;
    virtual const ContactForces& contact_forces() const = 0;
    virtual const std::optional<AirDesc>& air() const = 0;

    /// Whether a backend may still have the surfaces of this frame on its device.
    virtual bool is_live() const = 0;

  protected:
    WorldFrame() = default;
    WorldFrame(const WorldFrame&) = default;
    WorldFrame& operator=(const WorldFrame&) = default;
};

/// Reads the world itself, without a copy. Valid as long as the world stays where it is; its content is the world's at
/// the time of each call.
class LiveWorldFrame final : public WorldFrame {
  public:
    explicit LiveWorldFrame(const World& world) : world_(&world) {}

    std::size_t cloth_count() const override { return world_->cloth_count(); }
    ClothId cloth_id(std::size_t place) const override { return world_->cloth_id(place); }
    const std::shared_ptr<const ClothModel>& model(std::size_t place) const override {
        return world_->model(world_->cloth_id(place));
    }
    bool contains(ClothId id) const override { return world_->contains(id); }
    const KinematicTargets& kinematic_targets(ClothId id) const override { return world_->kinematic_targets(id); }
    const std::vector<Collider>& colliders() const override { return world_->colliders(); }
    ColliderId collider_id(std::size_t place) const override { return world_->collider_id(place); }
    bool contains(ColliderId id) const override { return world_->contains(id); }
    const Collider& collider(ColliderId id) const override { return world_->collider(id); }
    const Frame& frame() const override { return world_->frame(); }
    const ContactForces& contact_forces() const override { return world_->contact_forces(); }
    const std::optional<AirDesc>& air() const override { return world_->settings().air; }
    bool is_live() const override { return true; }

  private:
    const World* world_;
};

/// A copy, which stays as it is while the world steps, is edited or is gone. Any number of threads may read it at the
/// same time. Its ClothFrames have no velocities.
class WorldFrameCopy final : public WorldFrame {
  public:
    WorldFrameCopy(const WorldFrameCopy&) = delete;
    WorldFrameCopy& operator=(const WorldFrameCopy&) = delete;

    std::size_t cloth_count() const override { return models_.size(); }
    ClothId cloth_id(std::size_t place) const override { return frame_.cloths[place].id; }
    const std::shared_ptr<const ClothModel>& model(std::size_t place) const override { return models_[place]; }
    bool contains(ClothId id) const override { return cloth_places_.find(id).has_value(); }
    const KinematicTargets& kinematic_targets(ClothId id) const override { return targets_[*cloth_places_.find(id)]; }
    const std::vector<Collider>& colliders() const override { return colliders_; }
    ColliderId collider_id(std::size_t place) const override { return collider_ids_[place]; }
    bool contains(ColliderId id) const override { return collider_places_.find(id).has_value(); }
    const Collider& collider(ColliderId id) const override { return colliders_[*collider_places_.find(id)]; }
    const Frame& frame() const override { return frame_; }
    const ContactForces& contact_forces() const override { return contact_forces_; }
    const std::optional<AirDesc>& air() const override { return air_; }
    bool is_live() const override { return false; }

  private:
    friend class WorldFrameCopies;

    /// Finds the place of an id without a search.
    template <class Id>
    class Places {
      public:
        void clear() { entries_.clear(); }
        void add(Id id, std::size_t place) {
            if (entries_.size() <= id.index) entries_.resize(id.index + std::size_t{1});
            entries_[id.index] = {id, place};
        }
        std::optional<std::size_t> find(Id id) const {
            if (!id || id.index >= entries_.size() || entries_[id.index].id != id) return {};
            return entries_[id.index].place;
        }

      private:
        struct Entry {
            Id id;
            std::size_t place = 0;
        };
        std::vector<Entry> entries_;  // by Id::index
    };
    /// The arrays of a ClothFrame.
    struct Arrays {
        std::vector<Vec4> positions, normals;
    };

    WorldFrameCopy() = default;
    void take(const World& world);
    void let_go();  ///< of models and shapes, but keeps the arrays

    Frame frame_;
    std::vector<std::shared_ptr<const ClothModel>> models_;
    std::vector<Arrays> arrays_;
    std::vector<KinematicTargets> targets_;
    Places<ClothId> cloth_places_;
    std::vector<Collider> colliders_;
    std::vector<ColliderId> collider_ids_;
    Places<ColliderId> collider_places_;
    ContactForces contact_forces_;
    std::optional<AirDesc> air_;
};

/// Makes copies of one world or of several. Reuses the memory of earlier copies that have been released. The copies may
/// outlive this object. Not thread-safe; the copies may be released on any thread.
class WorldFrameCopies {
  public:
    WorldFrameCopies();
    /// Reads the frame back to the host (World::frame).
    std::shared_ptr<const WorldFrameCopy> copy(const World& world);

  private:
    struct Unused;
    std::shared_ptr<Unused> unused_;
};

}  // namespace weft
