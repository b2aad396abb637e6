// From the fabric that a program describes by keys and values to the values themselves.
#include "scene/check.h"
#include "scene/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace weft {
namespace {

struct Found {
    const Parameter* parameter = nullptr;
    std::byte* base = nullptr;
};

Found find_parameter(Fabric& fabric, std::string_view key) {
    for (const FabricTable& table : fabric_tables()) {
        const auto it = std::ranges::find(table.parameters, key, &Parameter::key);
        if (it != table.parameters.end()) return {&*it, reinterpret_cast<std::byte*>(&fabric) + table.offset};
    }
    return {};
}

std::vector<std::string_view> all_keys() {
    std::vector<std::string_view> keys;
    for (const FabricTable& table : fabric_tables())
        for (const Parameter& p : table.parameters) keys.push_back(p.key);
    return keys;
}

template <class T>
void store(const Found& to, std::size_t index, T value) {
    std::memcpy(to.base + to.parameter->offset + index * sizeof(T), &value, sizeof(T));
}

// Returns what the parameter expects where the value is of another kind.
std::string store_value(const Found& to, const std::vector<double>& numbers) {
    const Parameter& p = *to.parameter;
    if (p.kind != ParameterKind::number && p.kind != ParameterKind::angle_or_mesh) return "must not be a number";
    if (numbers.size() != 1 && numbers.size() != p.count)
        return "must be " + std::string(p.count > 1 ? "one number or " : "") + std::to_string(p.count) +
               (p.count > 1 ? " numbers, got " : " number, got ") + std::to_string(numbers.size());
    for (std::size_t i = 0; i < p.count; ++i) store(to, i, static_cast<float>(numbers[numbers.size() == 1 ? 0 : i]));
    // A NaN stands for the mesh's own angle, which has a word of its own.
    if (p.kind == ParameterKind::angle_or_mesh && std::isnan(numbers.front())) return "must be a number or \"mesh\"";
    return {};
}

std::string store_value(const Found& to, bool flag) {
    if (to.parameter->kind != ParameterKind::flag) return "must not be true or false";
    store(to, 0, flag);
    return {};
}

std::string store_value(const Found& to, const std::string& word) {
    if (to.parameter->kind == ParameterKind::angle_or_mesh && word == "mesh") {
        store(to, 0, std::numeric_limits<float>::quiet_NaN());
        return {};
    }
    if (to.parameter->kind != ParameterKind::choice) return "must not be a word, got " + in_quotes(word);
    const auto names = choice_names(*to.parameter);
    const auto it = std::ranges::find(names, word);
    if (it == names.end()) return "must be " + alternatives(names) + ", got " + in_quotes(word);
    store(to, 0, static_cast<int>(it - names.begin()));
    return {};
}

}  // namespace

void follow_stretch(Fabric& fabric, bool stretch_given, bool compression_given) {
    // A stretch out of range is one problem, not two.
    Problems of_stretch;
    check_values(stretch_parameters, &fabric.stretch, "", of_stretch);
    if (stretch_given && !compression_given && !of_stretch.concern("/stretch"))
        std::ranges::copy(fabric.stretch.stretch, fabric.stretch.compression);
}

Result<Fabric> make_fabric(const FabricDesc& desc, const std::string& pointer) {
    Problems problems;
    Fabric fabric;
    if (const FabricPreset* preset = find_fabric(desc.preset)) {
        fabric = preset->fabric;
    } else {
        std::vector<std::string_view> names;
        for (const FabricPreset& known : fabric_presets()) names.push_back(known.name);
        problems.add(at(pointer, "preset"),
                     "unknown fabric " + in_quotes(desc.preset) + suggestion(desc.preset, names));
    }
    const auto given = [&](std::string_view key) {
        return std::ranges::any_of(desc.values, [&](const auto& value) { return value.first == key; });
    };
    for (const auto& [key, value] : desc.values) {
        const Found to = find_parameter(fabric, key);
        if (!to.parameter) {
            problems.add(at(pointer, key), "unknown key " + in_quotes(key) + suggestion(key, all_keys()));
            continue;
        }
        std::string wrong = std::visit([&](const auto& v) { return store_value(to, v); }, value.get());
        if (!wrong.empty()) problems.add(at(pointer, key), std::move(wrong));
    }
    follow_stretch(fabric, given("stretch"), given("compression"));
    for (const FabricTable& table : fabric_tables())
        check_values(table.parameters, reinterpret_cast<const std::byte*>(&fabric) + table.offset, pointer, problems);
    if (!problems.none()) return std::move(problems).take();
    return fabric;
}

}  // namespace weft
