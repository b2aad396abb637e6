#include "io/scenes/json_reader.h"

#include "scene/check.h"
#include "scene/nearest_name.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace weft {
namespace {

using nlohmann::json;

// Stores by offset, because the type of the struct behind `base` is unknown here.
template <class T>
void store(const Parameter& parameter, void* base, std::size_t index, T value) {
    std::memcpy(static_cast<std::byte*>(base) + parameter.offset + index * sizeof(T), &value, sizeof(T));
}

// "3 numbers", "a whole number"
std::string expected_numbers(const Parameter& p) {
    const std::string noun = p.kind == ParameterKind::integer ? "whole number" : "number";
    if (p.kind == ParameterKind::angle_or_mesh) return "a number or \"mesh\"";
    if (p.count == 1) return "a " + noun;
    const std::string list = "a list of " + std::to_string(p.count) + ' ' + noun + 's';
    return p.kind == ParameterKind::number ? "a number or " + list : list;
}

}  // namespace

std::string json_text(const json& value) {
    switch (value.type()) {
        case json::value_t::object:
            return "an object";
        case json::value_t::array:
            return "a list of " + std::to_string(value.size());
        case json::value_t::string:
            return in_quotes(value.get_ref<const std::string&>());
        case json::value_t::number_float:
            return number_text(value.get<double>());
        default:
            return value.dump();
    }
}

ObjectReader::ObjectReader(const json& value, std::string pointer, Problems& problems)
    : value_(&value), given_(value.is_object()), pointer_(std::move(pointer)), problems_(problems) {
    static const json empty = json::object();
    if (given_) return;
    problems_.add(pointer_, "must be an object, got " + json_text(value));
    value_ = &empty;
}

void ObjectReader::values(std::span<const Parameter> table, void* base) {
    for (const Parameter& parameter : table) {
        known_.push_back(parameter.key);
        if (const json* found = find(parameter.key)) {
            if (base) value(parameter, *found, base);
        } else if (parameter.required && given_) {
            problems_.add(at(pointer_, parameter.key), "is missing");
        }
    }
}

bool ObjectReader::has(std::string_view key) const {
    return find(key) != nullptr;
}

const json* ObjectReader::find(std::string_view key) const {
    assert(std::ranges::find(known_, key) != known_.end());
    const auto it = value_->find(key);
    return it != value_->end() ? &*it : nullptr;
}

void ObjectReader::object(std::string_view key, const std::function<void(ObjectReader&)>& read) {
    const json* found = find(key);
    if (!found) return;
    ObjectReader inner(*found, at(pointer_, key), problems_);
    if (!found->is_object()) return;
    read(inner);
    inner.finish();
}

const json* ObjectReader::list(std::string_view key) {
    const json* found = find(key);
    if (found && !found->is_array()) {
        problems_.add(at(pointer_, key), "must be a list, got " + json_text(*found));
        return nullptr;
    }
    return found;
}

void ObjectReader::objects(std::string_view key, const std::function<void(ObjectReader&)>& read) {
    const json* all = list(key);
    if (!all) return;
    const std::string place = at(pointer_, key);
    for (std::size_t i = 0; i < all->size(); ++i) {
        ObjectReader inner((*all)[i], at(place, i), problems_);
        // An entry of a wrong type is read as an empty one, so that the indices of later entries do not shift.
        read(inner);
        inner.finish();
    }
}

std::vector<std::uint32_t> ObjectReader::indices(std::string_view key) {
    constexpr Parameter index = {.kind = ParameterKind::integer};
    std::vector<std::uint32_t> result;
    if (const json* all = list(key)) {
        const std::string place = at(pointer_, key);
        result.resize(all->size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            const json& entry = (*all)[i];
            if (entry.is_number_unsigned() && entry.get<std::uint64_t>() <= std::numeric_limits<std::uint32_t>::max())
                result[i] = static_cast<std::uint32_t>(entry.get<std::uint64_t>());
            else
                integer(index, entry, at(place, i), result[i]);
        }
    }
    return result;
}

std::vector<float> ObjectReader::numbers(std::string_view key) {
    constexpr double most = std::numeric_limits<float>::max();
    constexpr Parameter any = {.min = -most, .max = most};
    std::vector<float> result;
    const json* all = list(key);
    if (!all) return result;
    result.resize(all->size());
    for (std::size_t i = 0; i < result.size(); ++i) (void)number(any, (*all)[i], at(at(pointer_, key), i), result[i]);
    return result;
}

std::vector<Vec3> ObjectReader::points(std::string_view key) {
    constexpr Parameter coordinate = {.min = -far_away, .max = far_away};
    std::vector<Vec3> result;
    if (const json* all = list(key)) {
        const std::string place = at(pointer_, key);
        result.resize(all->size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            const json& entry = (*all)[i];
            const std::string where = at(place, i);
            if (!entry.is_array() || entry.size() != 3) {
                problems_.add(where, "must be 3 numbers, got " + json_text(entry));
                continue;
            }
            float* const coordinates[] = {&result[i].x, &result[i].y, &result[i].z};
            for (std::size_t k = 0; k < 3; ++k) {
                if (!number(coordinate, entry[k], at(where, k), *coordinates[k])) continue;
                if (double{std::abs(*coordinates[k])} > far_away)
                    problems_.add(at(where, k),
                                  range_problem(coordinate, double{*coordinates[k]}, json_text(entry[k])));
            }
        }
    }
    return result;
}

std::string_view ObjectReader::one_of(std::span<const std::string_view> keys) {
    std::vector<std::string_view> present;
    std::ranges::copy_if(keys, std::back_inserter(present), [this](std::string_view key) { return has(key); });
    if (present.size() == 1) return present.front();
    const std::string wanted = "must have one of " + alternatives(keys);
    if (given_) problems_.add(pointer_, present.empty() ? wanted : wanted + ", got " + std::to_string(present.size()));
    return {};
}

void ObjectReader::only_with(std::string_view companion, std::span<const Parameter> table) {
    if (has(companion)) return;
    for (const Parameter& parameter : table)
        if (has(parameter.key))
            problems_.add(at(pointer_, parameter.key),
                          "belongs to \"" + std::string(companion) + "\", which is absent");
}

void ObjectReader::finish() {
    for (const auto& [key, unused] : value_->items())
        if (std::ranges::find(known_, key) == known_.end())
            problems_.add(at(pointer_, key), "unknown key " + in_quotes(key) + suggestion(key, known_));
}

void ObjectReader::value(const Parameter& p, const json& value, void* base) {
    const auto wrong = [&](const std::string& expected) {
        problems_.add(at(pointer_, p.key), "must be " + expected + ", got " + json_text(value));
    };
    switch (p.kind) {
        case ParameterKind::number:
        case ParameterKind::vector:
        case ParameterKind::integer:
            numbers(p, value, base);
            break;
        case ParameterKind::angle_or_mesh:
            if (value.is_string() && value.get_ref<const std::string&>() == "mesh")
                store(p, base, 0, std::numeric_limits<float>::quiet_NaN());
            else
                numbers(p, value, base);
            break;
        case ParameterKind::flag:
            if (value.is_boolean())
                store(p, base, 0, value.get<bool>());
            else
                wrong("true or false");
            break;
        case ParameterKind::choice:
            choice(p, value, base);
            break;
        case ParameterKind::text:
            if (value.is_string())
                *reinterpret_cast<std::string*>(static_cast<std::byte*>(base) + p.offset) = value.get<std::string>();
            else
                wrong("a text in quotes");
            break;
        case ParameterKind::object:
        case ParameterKind::list:
            break;
    }
}

void ObjectReader::numbers(const Parameter& p, const json& value, void* base) {
    const std::string place = at(pointer_, p.key);
    const auto put = [&](const json& entry, const std::string& where, std::size_t first, std::size_t count) {
        if (p.kind == ParameterKind::integer) {
            if (std::uint32_t n = 0; integer(p, entry, where, n)) store(p, base, first, n);
        } else if (float x = 0; number(p, entry, where, x)) {
            for (std::size_t i = first; i < first + count; ++i) store(p, base, i, x);
        }
    };
    const bool one_will_do = p.count == 1 || p.kind == ParameterKind::number;
    if (value.is_number() && one_will_do)
        put(value, place, 0, p.count);
    else if (value.is_array() && p.count > 1 && value.size() == p.count)
        for (std::size_t i = 0; i < p.count; ++i) put(value[i], at(place, i), i, 1);
    else
        problems_.add(place, "must be " + expected_numbers(p) + ", got " + json_text(value));
}

bool ObjectReader::number(const Parameter& p, const json& value, const std::string& place, float& result) {
    if (!value.is_number()) {
        problems_.add(place, "must be a number, got " + json_text(value));
        return false;
    }
    const double exact = value.get<double>();
    if (std::abs(exact) > std::numeric_limits<float>::max()) {
        problems_.add(place, range_problem(p, exact, json_text(value)));
        return false;
    }
    result = static_cast<float>(exact);
    return true;
}

bool ObjectReader::integer(const Parameter& p, const json& value, const std::string& place, std::uint32_t& result) {
    const double exact = value.is_number() ? value.get<double>() : std::nan("");
    if (!(exact == std::floor(exact))) {
        problems_.add(place, "must be a whole number, got " + json_text(value));
        return false;
    }
    if (exact < 0 || exact > std::numeric_limits<std::uint32_t>::max()) {
        std::string what = range_problem(p, exact, json_text(value));
        problems_.add(place, what.empty() ? "must be ≤ 4294967295, got " + json_text(value) : std::move(what));
        return false;
    }
    result = static_cast<std::uint32_t>(exact);
    return true;
}

void ObjectReader::choice(const Parameter& p, const json& value, void* base) {
    const std::vector<std::string_view> names = choice_names(p);
    if (value.is_string()) {
        const auto it = std::ranges::find(names, value.get_ref<const std::string&>());
        if (it != names.end()) return store(p, base, 0, static_cast<int>(it - names.begin()));
    }
    if (value.is_boolean() && p.flag_too)
        return store(p, base, 0, value.get<bool>() ? static_cast<int>(names.size()) - 1 : 0);
    problems_.add(at(pointer_, p.key),
                  "must be " + alternatives(names) + (p.flag_too ? ", or true or false" : "") + ", got " +
                      json_text(value) +
                      (value.is_string() ? former_name(value.get_ref<const std::string&>(), names) : ""));
}

}  // namespace weft
