#include "solver/plan/barriers.h"

#include <algorithm>

namespace weft {
namespace {

constexpr std::uint32_t per_array = 64;  // largest number of levels or constraints that have their own array
constexpr std::uint32_t every = per_array - 1;

std::uint32_t array_id(Data data, std::uint32_t which = 0) {
    return static_cast<std::uint32_t>(data) * per_array + std::min(which, every);
}

// Id of the array that a pass accesses.
std::uint32_t array_of(Data data, const Pass& pass) {
    switch (data) {
        case Data::node_position:
        case Data::node_origin:
        case Data::node_displacement:
            return array_id(data, pass.level);
        case Data::finer_place:
            return pass.level == 0 ? array_id(Data::position) : array_id(Data::node_origin, pass.level - 1);
        case Data::coarser_displacement:
            return array_id(Data::node_displacement, pass.level + 1);
        case Data::finest_displacement:
            return array_id(Data::node_displacement, 0);
        case Data::correction:
        case Data::multipliers:
        case Data::shifts:
        case Data::found:
        case Data::places:
        case Data::list_rows:
            return array_id(data, static_cast<std::uint32_t>(pass.constraint));
        case Data::all_corrections:
            return array_id(Data::correction, every);
        default:
            return array_id(data);
    }
}

bool same_array(std::uint32_t a, std::uint32_t b) {
    if (a / per_array != b / per_array) return false;
    return a == b || a % per_array == every || b % per_array == every;
}

}  // namespace

bool Barriers::conflict(const Touched& earlier, const Touched& later) const {
    if (!same_array(earlier.array, later.array) || !(earlier.access.write || later.access.write)) return false;
    if (sharing_ == Sharing::free) return true;
    if (earlier.single || later.single) return !(earlier.single && later.single);
    return !(earlier.access.own && later.access.own && earlier.over == later.over);
}

bool Barriers::before(const Pass& pass, bool single) {
    const PassInfo& info = pass_info(pass.kind);
    bool barrier = false;
    for (const Access& access : info.accesses) {
        const Touched later{array_of(access.data, pass), access, info.over, single};
        barrier = barrier || std::ranges::any_of(since_, [&](const Touched& one) { return conflict(one, later); });
    }
    if (barrier) since_.clear();
    for (const Access& access : info.accesses)
        since_.push_back({array_of(access.data, pass), access, info.over, single});
    return barrier;
}

}  // namespace weft
