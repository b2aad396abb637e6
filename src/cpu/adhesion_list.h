// Adhesion of cloth to colliders. The list of particles that stick is rebuilt in every frame.
#pragma once

#include "cpu/cloth_run.h"
#include "cpu/dynamic_list.h"

#include <span>
#include <vector>

namespace weft::cpu {

/// Input of the passes over an island's lists.
struct ListContext {
    const Passes& passes;
    const WorldStep& step;
    std::span<ClothState* const> cloths;
};

class AdhesionList {
  public:
    /// Allocates; the other functions do not.
    void prepare(const ListContext& context);
    void run(const ListContext& context, const Pass& pass, std::uint32_t substep, Worker worker);

    const DynamicList& rows() const { return rows_; }
    /// Makes the next prepare() allocate enough for the constraints that the last frame found.
    void grow() { wanted_capacity_ = grown_list_capacity(rows_.wanted()); }

  private:
    /// The particle's position in the local frame of its collider.
    struct Target {
        Vec3 local;
        std::uint32_t collider;
    };

    /// Calls visit(collider, local position) for every collider that the particle sticks to.
    template <class Visit>
    static void for_each_target(const ListContext& context, const ClothState& cloth, std::uint32_t particle,
                                const FrameNumbers& numbers, Visit&& visit);
    void find(const ListContext& context, Worker worker);
    void list(const ListContext& context, Worker worker);
    void aim(const ListContext& context, std::uint32_t substep, Worker worker);
    void correct(const ListContext& context, const Pass& pass, std::uint32_t substep, Worker worker);
    void average(const ListContext& context, Worker worker);

    DynamicList rows_;
    std::vector<Target> targets_;
    std::vector<std::uint32_t> first_item_;  ///< by cloth
    std::uint32_t first_dummy_ = 0;          ///< of the island's first cloth
    std::uint32_t wanted_capacity_ = 0;
};

}  // namespace weft::cpu
