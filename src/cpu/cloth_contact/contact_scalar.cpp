#include "cpu/cloth_contact/contact_loops.h"
#include "physics/scalar.h"
#include "solver/plan/cloth_contact_numbers.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace weft::scalar {
namespace {

using namespace weft::cpu;

#include "collide/pair_search.inl"
#include "cpu/cloth_contact/contact_loops.inl"

}  // namespace
}  // namespace weft::scalar

namespace weft::cpu {

const ContactLoops& scalar_contact_loops() {
    static constexpr ContactLoops table = scalar::contact_loops;
    return table;
}

void Candidates::clear() {
    count = 0;
    tiles.clear();
}

void Candidates::reserve(std::uint32_t pairs) {
    const std::size_t needed = std::size_t{pairs} + 16;
    if (thickness.size() >= needed) return;
    const std::size_t room = needed + needed / 2;
    for (auto& array : particle) array.resize(room);
    for (auto* array : {&thickness, &reach, &before}) array->resize(room);
    block.resize(room);
}

void Candidates::pad(std::uint32_t with_particle) {
    reserve(count);
    for (auto& array : particle) std::fill_n(&array[count], 16, with_particle);
}

void NearPairs::reserve(std::uint32_t pairs) {
    const std::size_t needed = std::size_t{pairs} + 16;
    if (thickness.size() >= needed) return;
    const std::size_t room = needed + needed / 2;
    for (auto& array : particle) array.resize(room);
    for (auto& array : weight) array.resize(room);
    for (auto& array : normal) array.resize(room);
    for (auto& array : tile) array.resize(room);
    for (auto* array : {&thickness, &gap, &distance}) array->resize(room);
    pushed.resize(room);
}

void NearPairs::move(std::uint32_t from, std::uint32_t to) {
    for (auto& array : particle) array[to] = array[from];
    for (auto& array : weight) array[to] = array[from];
    for (auto& array : normal) array[to] = array[from];
    for (auto& array : tile) array[to] = array[from];
    for (auto* array : {&thickness, &gap, &distance}) (*array)[to] = (*array)[from];
    pushed[to] = pushed[from];
}

void Overlaps::reserve(std::uint32_t pairs) {
    const std::size_t needed = std::size_t{pairs} + 16;
    if (depth.size() >= needed) return;
    const std::size_t room = needed + needed / 2;
    for (auto& array : particle) array.resize(room);
    for (auto* arrays : {&weight, &give})
        for (auto& array : *arrays) array.resize(room);
    for (auto* arrays : {&normal, &push})
        for (auto& array : *arrays) array.resize(room);
    for (auto* array : {&depth, &distance, &thickness}) array->resize(room);
    pair.resize(room);
}

void Overlaps::pad(std::uint32_t with_particle) {
    reserve(count);
    for (auto& array : particle) std::fill_n(&array[count], 16, with_particle);
    for (auto& array : weight) std::fill_n(&array[count], 16, 0.0f);
    for (auto& array : normal) std::fill_n(&array[count], 16, 0.0f);
    std::fill_n(&depth[count], 16, 0.0f);
}

bool comes_near(const NearPairs& near, PairKind kind, std::uint32_t pair, const float* start, const float* positions) {
    scalar::vec3 from[4], moved[4];
    for (int k = 0; k < 4; ++k) {
        const std::size_t at = 4 * std::size_t{near.particle[k][pair]};
        from[k] = {start[at], start[at + 1], start[at + 2]};
        moved[k] = scalar::vec3{positions[at], positions[at + 1], positions[at + 2]} - from[k];
    }
    return scalar::comes_near(kind == PairKind::edge_edge, from[0], from[1], from[2], from[3], moved[0], moved[1],
                              moved[2], moved[3], near.distance[pair], near.thickness[pair]);
}

void NearPairs::pad(std::uint32_t with_particle) {
    reserve(count);
    for (auto& array : particle) std::fill_n(&array[count], 16, with_particle);
    for (auto& array : weight) std::fill_n(&array[count], 16, 0.0f);
    for (auto& array : normal) std::fill_n(&array[count], 16, 0.0f);
}

}  // namespace weft::cpu
