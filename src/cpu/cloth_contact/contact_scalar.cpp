#include "cpu/cloth_contact/contact_loops.h"
#include "physics/scalar.h"

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

void NearPairs::pad(std::uint32_t with_particle) {
    reserve(count);
    for (auto& array : particle) std::fill_n(&array[count], 16, with_particle);
    for (auto& array : weight) std::fill_n(&array[count], 16, 0.0f);
    for (auto& array : normal) std::fill_n(&array[count], 16, 0.0f);
}

}  // namespace weft::cpu
