#include "solver/state/contact_marks.h"
#include "cpu/cloth_contact/cloth_contact.h"

namespace weft::cpu {

void ClothContact::begin_marks(bool record) {
    records_marks_ = record;
    if (!record) return;
    marks_.resize(part_.size());
    for_each_particle([&](std::uint32_t p) { marks_[p] = 0; });
}

void ClothContact::mark_limited_particles() {
    if (!records_marks_) return;
    for_each_particle([&](std::uint32_t p) {
        if (retreats_[p] > 0) marks_[p] |= mark_limited;
    });
}

void ClothContact::mark_stuck(std::span<const std::uint32_t> particles) {
    if (!records_marks_) return;
    for (const std::uint32_t p : particles) marks_[p] |= mark_tangled;
}

void ClothContact::add_marks(std::uint32_t base, std::span<std::uint32_t> marks) const {
    if (!records_marks_) return;
    for (std::size_t i = 0; i < marks.size(); ++i) marks[i] |= marks_[base + i];
    for (const Pushed& pair : pushes_of_substep_) {
        for (const std::uint32_t p : pair.particles)
            if (p >= base && p - base < marks.size()) marks[p - base] |= mark_touches;
    }
}

}  // namespace weft::cpu
