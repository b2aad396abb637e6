#include "solver/state/contact_marks.h"
#include "cpu/cloth_contact/cloth_contact.h"

#include <algorithm>
#include <atomic>

namespace weft::cpu {

void ClothContact::mark_stuck(std::span<const std::uint32_t> particles) {
    if (!records_marks_) return;
    for (const std::uint32_t p : particles)  // other workers may mark the same particle
        std::atomic_ref(marks_[p]).fetch_or(mark_tangled, std::memory_order_relaxed);
}

void ClothContact::add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const {
    if (!records_marks_) return;
    for (std::size_t i = 0; i < marks.size(); ++i) marks[i] |= marks_[base + i];
    for (const Mine& mine : workers_) {
        for (const Pushed& pair : mine.pushes)
            for (const std::uint32_t p : pair.particles)
                if (p >= base && p - base < marks.size()) marks[p - base] |= mark_touches;
    }
}

}  // namespace weft::cpu
