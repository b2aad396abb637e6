// How moving surfaces of colliders carry cloth along, where the limit leaves it no other place. At the start of the
// substep every pair has its gap. A surface that moves may take it away, so that the start is no place to go back to.
// A particle that is carried goes back to its base instead: where it would be if it moved with the surface. A motion of
// a rigid body changes no gap between particles that all have it. Its neighbors are carried too if they lose their gap
// to it, so this ends with as much cloth carried along as it takes.
#include "base/transform.h"
#include "cpu/cloth_contact/cloth_contact.h"
#include "cpu/cloth_contact/pair_math.h"
#include "solver/plan/cloth_contact_numbers.h"

#include <algorithm>
#include <atomic>

namespace weft::cpu {

Vec3 ClothContact::carried_place(std::uint32_t p, std::uint32_t carrier) const {
    const std::span<const Pose> poses = carriers_[carrier - 1];
    return to_world(poses[substep_ + 1], to_local(poses[substep_], start_[p].xyz()));
}

// Where the limit puts the particle at last.
Vec3 ClothContact::base_of(std::uint32_t p) const {
    return is_carried(p) ? carried_place(p, carrier_[p]) : start_[p].xyz();
}

std::uint32_t ClothContact::carrier_of(const std::array<std::uint32_t, 4>& pair) const {
    std::uint32_t carrier = 0;
    for (const std::uint32_t p : pair) carrier = std::max(carrier, carrier_[p]);
    return carrier;
}

bool ClothContact::touches_moving_surface(const std::array<std::uint32_t, 4>& pair) const {
    return std::ranges::any_of(pair, [&](std::uint32_t p) { return of_surface(p) && carrier_[p] > 0; });
}

// Whether all particles of the pair move with the same surface.
bool ClothContact::is_carried(const std::array<std::uint32_t, 4>& pair) const {
    const std::uint32_t carrier = carrier_of(pair);
    return carrier > 0 && std::ranges::all_of(pair, [&](std::uint32_t p) {
               return carrier_[p] == carrier && (of_surface(p) || retreats_[p] == most_retreats);
           });
}

// Asks that the surface that carries one of the particles, or to which it belongs, carries the others too. Returns
// whether that changes anything.
bool ClothContact::carry(Mine& mine, const std::array<std::uint32_t, 4>& pair) {
    const std::uint32_t carrier = carrier_of(pair);
    if (carrier == 0) return false;
    bool helps = false;
    for (const std::uint32_t p : pair) {
        if (carrier_[p] > 0 || !(x_[p].w > 0)) continue;
        const float most = most_carried_by(p);
        if (!(squared(carried_place(p, carrier) - start_[p].xyz()) <= most * most)) continue;
        helps = true;
        const std::atomic_ref next(next_carrier_[p]);
        std::uint32_t now = next.load(std::memory_order_relaxed);
        while (now < carrier && !next.compare_exchange_weak(now, carrier, std::memory_order_relaxed)) {
        }
        if (std::atomic_ref(sent_back_[p]).exchange(1, std::memory_order_relaxed) == 0) mine.to_send_back.push_back(p);
    }
    return helps;
}

// If the particle is to be carried from now on, starts the limit anew for it.
bool ClothContact::begin_carried(std::uint32_t p) {
    if (next_carrier_[p] == 0) return false;
    carrier_[p] = next_carrier_[p], next_carrier_[p] = 0;
    retreats_[p] = 0, sums_[p] = {}, sent_back_[p] = 0;
    set_place(x_[p], asked_[p].xyz());
    return true;
}

}  // namespace weft::cpu
