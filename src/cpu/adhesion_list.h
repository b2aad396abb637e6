// Cloth that sticks to colliders: which particles do is found anew in every frame.
#pragma once

#include "cpu/cloth_run.h"
#include "cpu/dynamic_list.h"

#include <span>
#include <vector>

namespace weft::cpu {

/// What the passes of an island's lists work on.
struct ListContext {
    const Passes& passes;
    const WorldStep& step;
    std::span<ClothState* const> cloths;
};

class AdhesionList {
  public:
    /// Makes room; only here memory is asked for.
    void prepare(const ListContext& context);
    void run(const ListContext& context, const Pass& pass, std::uint32_t substep, Rank rank);

    const DynamicList& rows() const { return rows_; }
    /// For the rows that the last frame wanted.
    void grow() { wanted_capacity_ = grown_list_capacity(rows_.wanted()); }

  private:
    /// Where a row's particle was in the frame of its collider.
    struct Hold {
        Vec3 local;
        std::uint32_t collider;
    };

    /// visit(collider, local place) for every collider that a cloth's particle sticks to.
    template <class Visit>
    static void for_each_hold(const ListContext& context, const ClothState& cloth, std::uint32_t particle,
                              float half_thickness, Visit&& visit);
    void find(const ListContext& context, Rank rank);
    void list(const ListContext& context, Rank rank);
    void aim(const ListContext& context, std::uint32_t substep, Rank rank);
    void correct(const ListContext& context, const Pass& pass, std::uint32_t substep, Rank rank);
    void average(const ListContext& context, Rank rank);

    DynamicList rows_;
    std::vector<Hold> holds_;
    std::vector<std::uint32_t> first_item_;  ///< by cloth
    std::uint32_t first_dummy_ = 0;          ///< of the island's first cloth
    std::uint32_t wanted_capacity_ = 0;
};

}  // namespace weft::cpu
