// Builds a Fabric from the keys and values that a program gives.
#include "scene/check.h"
#include "scene/nearest_name.h"
#include "scene/set_value.h"

#include <algorithm>

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

}  // namespace

void follow_stretch(Fabric& fabric, bool stretch_given, bool compression_given) {
    // A stretch stiffness out of range is reported once: compression does not follow it then.
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
        if (std::string wrong = set_value(*to.parameter, to.base, value); !wrong.empty())
            problems.add(at(pointer, key), std::move(wrong));
    }
    follow_stretch(fabric, given("stretch"), given("compression"));
    for (const FabricTable& table : fabric_tables())
        check_values(table.parameters, reinterpret_cast<const std::byte*>(&fabric) + table.offset, pointer, problems);
    if (!problems.none()) return std::move(problems).take();
    return fabric;
}

}  // namespace weft
