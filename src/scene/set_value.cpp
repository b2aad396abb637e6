#include "scene/set_value.h"

#include "scene/check.h"
#include "scene/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace weft {
namespace {

struct Target {
    const Parameter& parameter;
    std::byte* base;

    template <class T>
    void store(std::size_t index, T value) const {
        std::memcpy(base + parameter.offset + index * sizeof(T), &value, sizeof(T));
    }
};

std::string store_value(const Target& to, const std::vector<double>& numbers) {
    const Parameter& p = to.parameter;
    const bool whole = p.kind == ParameterKind::integer;
    if (!whole && p.kind != ParameterKind::number && p.kind != ParameterKind::angle_or_mesh)
        return "must not be a number";
    if (numbers.size() != 1 && numbers.size() != p.count)
        return "must be " + std::string(p.count > 1 ? "one number or " : "") + std::to_string(p.count) +
               (p.count > 1 ? " numbers, got " : " number, got ") + std::to_string(numbers.size());
    for (std::size_t i = 0; i < p.count; ++i) {
        const double number = numbers[numbers.size() == 1 ? 0 : i];
        if (!whole) {
            to.store(i, static_cast<float>(number));
            continue;
        }
        if (std::string problem = range_problem(p, number); !problem.empty()) return problem;
        if (number != std::floor(number)) return "must be a whole number, got " + number_text(number);
        to.store(i, static_cast<std::uint32_t>(number));
    }
    // NaN is the internal value for the mesh's own angle; the word "mesh" selects it.
    if (p.kind == ParameterKind::angle_or_mesh && std::isnan(numbers.front())) return "must be a number or \"mesh\"";
    return {};
}

std::string store_value(const Target& to, bool flag) {
    if (to.parameter.kind != ParameterKind::flag) return "must not be true or false";
    to.store(0, flag);
    return {};
}

std::string store_value(const Target& to, const std::string& word) {
    if (to.parameter.kind == ParameterKind::angle_or_mesh && word == "mesh") {
        to.store(0, std::numeric_limits<float>::quiet_NaN());
        return {};
    }
    if (to.parameter.kind != ParameterKind::choice) return "must not be a word, got " + in_quotes(word);
    const auto names = choice_names(to.parameter);
    const auto it = std::ranges::find(names, word);
    if (it == names.end())
        return "must be " + alternatives(names) + ", got " + in_quotes(word) + former_name(word, names);
    to.store(0, static_cast<int>(it - names.begin()));
    return {};
}

}  // namespace

std::string set_value(const Parameter& parameter, void* base, const ParameterValue& value) {
    const Target to{parameter, static_cast<std::byte*>(base)};
    return std::visit([&](const auto& v) { return store_value(to, v); }, value.get());
}

void set_values(std::span<const Parameter> table, void* base, const ParameterValues& values, const std::string& pointer,
                Problems& problems) {
    for (const auto& [key, value] : values) {
        const auto it = std::ranges::find(table, key, &Parameter::key);
        if (it == table.end()) {
            std::vector<std::string_view> known;
            for (const Parameter& p : table) known.push_back(p.key);
            problems.add(at(pointer, key), "unknown key " + in_quotes(key) + suggestion(key, known));
            continue;
        }
        if (std::string wrong = set_value(*it, base, value); !wrong.empty())
            problems.add(at(pointer, key), std::move(wrong));
    }
}

}  // namespace weft
