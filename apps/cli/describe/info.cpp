#include "cli/shell/command.h"
#include "cli/shell/text.h"

#include "cpu/cpu_backend.h"
#include "io/exports/exporter.h"
#include "io/images/picture_writer.h"
#include "io/meshes/mesh_file.h"
#include "io/scenes/scene_schema.h"
#include "look/material.h"
#include "scene/check.h"
#include "scene/fabric.h"

#ifdef WEFT_VULKAN
#include "vulkan/vulkan_backend.h"
#endif

#include <weft/weft.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace weft::cli {
namespace {

using Json = nlohmann::ordered_json;

Json value_json(const Parameter& parameter, const void* base) {
    const auto* at = static_cast<const char*>(base) + parameter.offset;
    if (parameter.kind == ParameterKind::flag) return *reinterpret_cast<const bool*>(at);
    if (parameter.kind == ParameterKind::choice)
        return choice_names(parameter).at(static_cast<std::size_t>(*reinterpret_cast<const int*>(at)));
    if (parameter.kind == ParameterKind::text) return *reinterpret_cast<const std::string*>(at);
    const auto* numbers = reinterpret_cast<const float*>(at);
    if (parameter.kind == ParameterKind::angle_or_mesh && std::isnan(*numbers)) return "mesh";
    // Converted as text, so that 0.14f prints as 0.14, not as 0.14000000059604645.
    const auto number = [](float x) {
        char text[32];
        std::snprintf(text, sizeof text, "%.7g", static_cast<double>(x));
        return Json::parse(text);
    };
    if (parameter.count == 1) return number(*numbers);
    Json list = Json::array();
    for (unsigned i = 0; i < parameter.count; ++i) list.push_back(number(numbers[i]));
    return list;
}

// In the order of the output; the figures behind `strength` and `tear_energy`.
constexpr std::pair<const char*, const char*> tearing_units[] = {{"breaking_force", "N/m"}, {"tongue_tear_force", "N"}};

Json fabric_json(const FabricPreset& preset) {
    Json fabric = {{"name", preset.name}, {"source", preset.source}, {"material", preset.material}};
    for (const FabricTable& table : fabric_tables()) {
        for (const Parameter& parameter : table.parameters) {
            fabric[std::string(parameter.key)] =
                value_json(parameter, reinterpret_cast<const char*>(&preset.fabric) + table.offset);
        }
    }
    fabric["breaking_force"] = preset.tearing.breaking_force;
    fabric["breaking_elongation"] = preset.tearing.elongation;
    fabric["tongue_tear_force"] = preset.tearing.tear_force;
    fabric["tearing_source"] = preset.tearing.source;
    return fabric;
}

Json material_json(const MaterialPreset& preset) {
    Json material = {{"name", preset.name}, {"what", preset.what}};
    for (const Parameter& parameter : material_parameters) {
        material[std::string(parameter.key)] = value_json(parameter, &preset.material);
    }
    return material;
}

// The properties of the Vulkan devices that matter for weft.
Json devices_json() {
    Json list = Json::array();
#ifdef WEFT_VULKAN
    for (const gpu::DeviceInfo& device : vulkan_devices()) {
        const gpu::DeviceLimits& limits = device.limits;
        Json one = {{"name", device.name},
                    {"type", gpu::type_name(device.type)},
                    {"driver", device.driver},
                    {"vulkan", std::to_string(device.api[0]) + "." + std::to_string(device.api[1]) + "." +
                                   std::to_string(device.api[2])},
                    {"memory_bytes", device.memory},
                    {"shared_memory_bytes", limits.shared_memory},
                    {"workgroup_invocations", limits.workgroup_invocations},
                    {"subgroup_size", limits.subgroup_size},
                    {"largest_allocation_bytes", limits.largest_allocation},
                    {"usable", device.usable()}};
        if (!device.usable()) one["missing"] = device.missing;
        list.push_back(std::move(one));
    }
#endif
    return list;
}

Json gather() {
    Json info;
    info["version"] = version();
    info["backends"] = {"cpu"};
#ifdef WEFT_VULKAN
    info["backends"].push_back("vulkan");
#endif
    info["vulkan_devices"] = devices_json();
    info["instruction_sets"] = cpu_instruction_sets();
    info["hardware_threads"] = std::thread::hardware_concurrency();
    for (std::string_view ending : mesh_formats()) info["mesh_formats"].push_back(ending);
    for (const ExportFormat& format : export_formats()) {
        info["export_formats"].push_back({{"ending", format.ending}, {"what", format.what}});
    }
    for (const PictureFormat& format : picture_formats()) {
        info["image_formats"].push_back({{"ending", format.ending}, {"what", format.what}});
    }
    const auto add_units = [&](const char* to, std::span<const Parameter> table) {
        for (const Parameter& parameter : table) {
            if (!parameter.unit.empty()) info[to][std::string(parameter.key)] = parameter.unit;
        }
    };
    for (const FabricTable& table : fabric_tables()) add_units("fabric_units", table.parameters);
    for (const auto& [key, unit] : tearing_units) info["fabric_units"][key] = unit;
    add_units("material_units", material_parameters);
    for (const FabricPreset& preset : fabric_presets()) info["fabrics"].push_back(fabric_json(preset));
    for (const MaterialPreset& preset : material_presets()) info["materials"].push_back(material_json(preset));
    return info;
}

std::string joined(const Json& list) {
    std::string text;
    for (const Json& item : list) text += (text.empty() ? "" : ", ") + item.get<std::string>();
    return text;
}

std::string triple(const Json& values, double scale, const char* format) {
    std::string text;
    for (const Json& value : values) {
        char number[32];
        std::snprintf(number, sizeof number, format, value.get<double>() * scale);
        text += (text.empty() ? "" : "/") + std::string(number);
    }
    return text;
}

// Splits "measured by …: denim, 11 oz" into the source "measured by …" and the cloth "denim, 11 oz".
std::pair<std::string, std::string> source_and_cloth(const std::string& text) {
    const std::size_t colon = text.rfind(": ");
    return colon == std::string::npos ? std::pair(text, std::string())
                                      : std::pair(text.substr(0, colon), text.substr(colon + 2));
}

// Numbers texts in the order of their first appearance.
class Sources {
  public:
    std::ptrdiff_t number(const std::string& text) {
        const auto known = std::ranges::find(texts_, text);
        const auto number = known - texts_.begin() + 1;
        if (known == texts_.end()) texts_.push_back(text);
        return number;
    }
    void print() const {
        for (std::size_t i = 0; i < texts_.size(); ++i)
            std::printf("  [%zu] %s\n", i + 1, wrapped(texts_[i], 94, 6).c_str());
    }

  private:
    std::vector<std::string> texts_;
};

void print_strengths(const Json& fabrics) {
    std::printf("strength of fabrics\n  %-12s %10s  %10s  %10s  %-12s  %11s  %s\n", "name", "elongation", "breaks at",
                "tongue tear", "strength N/m", "tear_energy", "source");
    std::printf("  %-12s %10s  %10s  %10s  %-12s  %11s\n", "", "%", "kN/m", "N", "warp/weft", "J/m");
    Sources sources;
    for (const Json& fabric : fabrics) {
        const auto number = [&](const char* key) { return fabric[key].get<double>(); };
        std::printf("  %-12s %10.3g  %10.3g  %11.3g  %-12s  %11.3g  [%td]\n", fabric["name"].get<std::string>().c_str(),
                    100 * number("breaking_elongation"), number("breaking_force") / 1000, number("tongue_tear_force"),
                    triple(fabric["strength"], 1, "%.4g").c_str(), number("tear_energy"),
                    sources.number(fabric["tearing_source"].get<std::string>()));
    }
    sources.print();
}

void print_fabrics(const Json& fabrics) {
    std::printf("fabrics\n  %-12s %8s  %-11s  %9s  %-15s  %s\n", "name", "kg/m²", "stretch N/m", "shear N/m",
                "bend µN·m", " source");
    std::printf("  %-12s %7s  %-11s  %9s  %-15s\n", "", "", "warp/weft", "", "warp/bias/weft");
    Sources sources;
    for (const Json& fabric : fabrics) {
        const auto [source, cloth] = source_and_cloth(fabric["source"].get<std::string>());
        std::printf("  %-12s %7.4f  %-11s  %9.0f  %-15s  [%td] %s\n", fabric["name"].get<std::string>().c_str(),
                    fabric["density"].get<double>(), triple(fabric["stretch"], 1, "%.0f").c_str(),
                    fabric["shear"].get<double>(), triple(fabric["bend"], 1e6, "%.3g").c_str(), sources.number(source),
                    cloth.c_str());
    }
    sources.print();
}

void print_materials(const Json& materials) {
    std::printf("materials\n  %-10s %-7s %9s  %-9s  %s\n", "name", "weave", "thread mm", "roughness", "description");
    for (const Json& material : materials) {
        const bool threads = material["weave"] != "smooth";
        std::printf("  %-10s %-7s %9s  %-9s  %s\n", material["name"].get<std::string>().c_str(),
                    material["weave"].get<std::string>().c_str(),
                    threads ? triple(material["thread_spacing"], 1, "%.3g").c_str() : "",
                    triple(material["roughness"], 1, "%.2g").c_str(),
                    wrapped(material["what"].get<std::string>(), 56, 42).c_str());
    }
}

void print_text(const Json& info) {
    std::cout << "weft " << info["version"].get<std::string>() << '\n'
              << "backends          " << joined(info["backends"]) << '\n'
              << "instruction sets  " << joined(info["instruction_sets"]) << " (the first is used)\n"
              << "hardware threads  " << info["hardware_threads"] << '\n'
              << "Vulkan devices\n";
    for (const Json& device : info["vulkan_devices"]) {
        const auto mebibytes = [&](const char* key) { return device[key].get<double>() / (1 << 20); };
        std::printf(
            "  %s (%s)  Vulkan %s, %s\n    %.0f MiB, at most %.0f at once; workgroups of %u with %u KiB, subgroups "
            "of %u%s\n",
            device["name"].get<std::string>().c_str(), device["type"].get<std::string>().c_str(),
            device["vulkan"].get<std::string>().c_str(), device["driver"].get<std::string>().c_str(),
            mebibytes("memory_bytes"), mebibytes("largest_allocation_bytes"),
            device["workgroup_invocations"].get<unsigned>(), device["shared_memory_bytes"].get<unsigned>() / 1024,
            device["subgroup_size"].get<unsigned>(),
            device["usable"].get<bool>() ? "" : ("; lacks " + joined(device["missing"])).c_str());
    }
    if (info["vulkan_devices"].empty()) std::printf("  none: no loader, no driver, or a build without Vulkan\n");
    std::cout << "reads meshes      " << joined(info["mesh_formats"]) << '\n' << "writes\n";
    for (const char* kind : {"export_formats", "image_formats"}) {
        for (const Json& format : info[kind]) {
            std::printf("  %-6s %s\n", format["ending"].get<std::string>().c_str(),
                        format["what"].get<std::string>().c_str());
        }
    }
    print_fabrics(info["fabrics"]);
    print_strengths(info["fabrics"]);
    print_materials(info["materials"]);
}

}  // namespace

Command add_info(Program& program) {
    Arguments arguments =
        program.add_command("info", "Print instruction sets, Vulkan devices, file formats, fabrics and materials");
    auto json = std::make_shared<bool>(false);
    auto schema = std::make_shared<bool>(false);
    const Argument as_json = arguments.add("--json", *json, "print JSON");
    arguments.add("--schema", *schema, "print the JSON Schema of scene files").excludes(as_json);
    return [json, schema] {
        if (*schema) {
            std::cout << scene_schema();
            return exit_done;
        }
        const Json info = gather();
        if (*json) {
            std::cout << info.dump(2) << '\n';
        } else {
            print_text(info);
        }
        return exit_done;
    };
}

}  // namespace weft::cli
