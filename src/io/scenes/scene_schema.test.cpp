// The schema in docs/ must match the tables and accept the scenes that the reader accepts.
#include "io/scenes/scene_schema.h"

#include "io/scenes/scene_file.h"
#include "scene/fabric.h"
#include "scene/scene_keys.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool is_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    ADD_FAILURE() << "unknown type " << type;
    return false;
}

/// Checks the keywords that scene_schema() uses, and fails on any other keyword, which would go unchecked.
class Validator {
  public:
    bool valid(const Json& schema, const Json& value) const {
        for (const auto& [keyword, argument] : schema.items()) {
            if (!targets(keyword, argument, schema, value)) return false;
        }
        return true;
    }

  private:
    bool targets(const std::string& keyword, const Json& argument, const Json& schema, const Json& value) const {
        static const std::set<std::string> notes = {"$schema", "title", "description", "default"};
        if (notes.contains(keyword)) return true;
        if (keyword == "type") return is_type(value, argument);
        if (keyword == "const") return value == argument;
        if (keyword == "enum") return std::ranges::find(argument, value) != argument.end();
        if (keyword == "anyOf") return matches(argument, value) >= 1;
        if (keyword == "oneOf") return matches(argument, value) == 1;
        if (keyword == "minimum") return !value.is_number() || value >= argument;
        if (keyword == "exclusiveMinimum") return !value.is_number() || value > argument;
        if (keyword == "maximum") return !value.is_number() || value <= argument;
        if (keyword == "minItems") return !value.is_array() || value.size() >= argument.get<std::size_t>();
        if (keyword == "maxItems") return !value.is_array() || value.size() <= argument.get<std::size_t>();
        if (keyword == "items") {
            return !value.is_array() || std::ranges::all_of(value, [&](const Json& v) { return valid(argument, v); });
        }
        return targets_of_object(keyword, argument, schema, value);
    }

    bool targets_of_object(const std::string& keyword, const Json& argument, const Json& schema,
                           const Json& value) const {
        static const std::set<std::string> known = {"properties", "additionalProperties", "required",
                                                    "dependentRequired", "dependentSchemas"};
        EXPECT_TRUE(known.contains(keyword)) << "unknown keyword " << keyword;
        if (!value.is_object()) return true;
        const auto has = [&](const Json& key) { return value.contains(key.get<std::string>()); };
        if (keyword == "required") return std::ranges::all_of(argument, has);
        if (keyword == "dependentRequired") {
            for (const auto& [key, others] : argument.items()) {
                if (has(key) && !std::ranges::all_of(others, has)) return false;
            }
            return true;
        }
        if (keyword == "dependentSchemas") {
            for (const auto& [key, other] : argument.items()) {
                if (has(key) && !valid(other, value)) return false;
            }
            return true;
        }
        for (const auto& [key, under] : value.items()) {
            const bool listed = schema.contains("properties") && schema["properties"].contains(key);
            if (keyword == "properties" && listed && !valid(argument[key], under)) return false;
            if (keyword != "additionalProperties" || listed) continue;
            if (argument.is_boolean() ? !argument.get<bool>() : !valid(argument, under)) return false;
        }
        return true;
    }

    std::ptrdiff_t matches(const Json& schemas, const Json& value) const {
        return std::ranges::count_if(schemas, [&](const Json& schema) { return valid(schema, value); });
    }
};

bool valid(const std::string& scene) {
    static const Json schema = Json::parse(scene_schema());
    return Validator().valid(schema, Json::parse(scene, nullptr, true, true));
}

std::string with_cloth(const std::string& keys) {
    return R"({ "weft": 1, "cloths": [ { )" + keys + " } ] }";
}
std::string with_collider(const std::string& keys) {
    return R"({ "weft": 1, "cloths": [ {} ], "colliders": [ { )" + keys + " } ] }";
}
std::string with_wind(const std::string& keys) {
    return R"({ "weft": 1, "cloths": [ {} ], "air": { "wind": [ { )" + keys + " } ] } }";
}
std::string with_pictures(const std::string& keys) {
    return R"({ "weft": 1, "cloths": [ {} ], )" + keys + " }";
}

TEST(SceneSchema, TheOneInTheDocumentationIsThis) {
    EXPECT_EQ(read_text(WEFT_SOURCE_DIR "/docs/scene.schema.json"), scene_schema())
        << "after a change of the tables: weft info --schema > docs/scene.schema.json";
}

TEST(SceneSchema, TakesEveryScene) {
    int scenes = 0;
    for (const auto& entry : fs::directory_iterator(WEFT_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".json") continue;
        EXPECT_TRUE(valid(read_text(entry.path()))) << entry.path();
        ++scenes;
    }
    EXPECT_GE(scenes, 3);
}

TEST(SceneSchema, TakesWhatTheReaderTakes) {
    for (
        const std::string& scene : {
            std::string(R"({ "weft": 1, "cloths": [ {} ] })"),
            with_cloth(R"("fabric": "silk", "pins": [ { "vertices": [0, 1] } ])"),
            with_cloth(R"("fabric": { "preset": "denim", "stretch": 40, "bend": [1, 2, 3], "rest_angle": "mesh" })"),
            with_cloth(R"("fabric": { "rest_angle": -90, "friction": [0.1, 0.2], "inextensible": true })"),
            with_cloth(R"("mesh": { "file": "a.obj", "scale": 0.01, "up": "z" }, "pins": [ { "color": [1, 0, 0] } ])"),
            with_cloth(R"("mesh": { "grid": { "resolution": [2, 4096] } }, "transform": { "rotation": [1e9, 0, 0] })"),
            with_cloth(R"("pins": [ { "box": { "min": [-1, -1, -1], "max": [1, 1, 1] } } ])"),
            with_cloth(R"("velocity": [0, -15, 0], "self_collision": "exact")"),
            with_cloth(R"("tearing": "cuts", "cuts": [ { "points": [ [0, 0, 0], [1, 0, 0] ] }, { "plane": {} } ])"),
            with_cloth(
                R"("tearing": "split", "cuts": [ { "time": 2, "plane": { "normal": [0, 0, -2], "offset": 1 } } ])"),
            with_cloth(R"("tearing": "split", "seams": [ { "strength": 5, "points": [ [0, 0, 0], [1, 0, 0] ] } ])"),
            with_cloth(R"("tearing": "split", "seams": [ { "strength": 5, "tear_energy": 1, "plane": {} } ])"),
            with_cloth(R"("tearing": "erode", "resistance": [ { "vertices": [0, 1], "factor": 0.5 } ])"),
            with_cloth(R"("tearing": "erode", "resistance": [ { "vertices": [0, 1], "factors": [0.5, 7] } ])"),
            with_cloth(R"("weights": [ { "of": "density", "vertices": [0, 1], "factors": [0.5, 7] },
                                       { "of": "bend", "factor": 2, "box": { "min": [0, 0, 0], "max": [1, 1, 1] } } ])"),
            with_cloth(R"("groups": [ { "name": "hem", "vertices": [0, 1] } ], "pins": [ { "group": "hem" } ])"),
            with_cloth(
                R"("mesh": { "file": "a.obj" }, "tearing": "split", "resistance": [ { "channel": "red", "factor": 2 },
                   { "color": [1, 0, 0], "threshold": 0.1, "factor": 2 } ])"),
            with_cloth(R"("self_collision": "fast")"),
            with_cloth(R"("self_collision": true)"),
            with_cloth(R"("self_collision": false)"),
            with_collider(R"("plane": {}, "friction": 0)"),
            with_collider(
                R"("sphere": { "radius": 1e-9 }, "friction": [1, 1], "transform": { "position": [1, 2, 3] })"),
            with_collider(R"("sphere": {}, "name": "ball")"),
            with_collider(R"("sphere": {}, "motion": { "keys": [ { "time": 1 } ] })"),
            with_collider(R"("sphere": {}, "motion": { "dynamic": {} })"),
            with_collider(
                R"("box": {}, "motion": { "dynamic": { "mass": 1e9, "spin": [0, -360, 0], "reaction": false } })"),
            with_wind(R"("velocity": [1, 0, 0])"),
            with_wind(R"("kind": "directional", "motion": "static", "shelter": 2)"),
            with_wind(
                R"("kind": "jet", "velocity": [1, 0, 0], "diameter": 0.2, "transform": { "position": [1, 2, 3] })"),
            with_wind(
                R"("kind": "vortex", "swirl": -3, "inflow": 1, "radius": 0.2, "box": { "half_extents": [1, 2, 1] })"),
            with_wind(
                R"("kind": "jet", "motion": { "keys": [ { "strength": 0 }, { "time": 1, "rotation": [0, 90, 0] } ] })"),
            with_pictures(R"("camera": {}, "light": {})"),
            with_pictures(R"("camera": { "position": [1, 2, 3], "target": [0, 0, 0], "fov": 30 })"),
            with_pictures(
                R"("light": { "sun": { "azimuth": -360, "color": [1, 0, 0.5] }, "sky": { "intensity": 0 } })"),
            with_pictures(R"("light": { "environment": { "file": "a.hdr", "visible": false }, "exposure": -2 })"),
            with_cloth(R"("material": "velvet")"),
            with_collider(R"("sphere": {}, "material": { "color": [0, 0, 0] })"),
            with_cloth(R"("material": { "preset": "silk", "color": [0, 0, 0], "roughness": 0.5 })"),
            with_cloth(R"("material": { "weave": "knit", "uv_tiling": [2, 3], "color_map": "a.png" })"),
        }) {
        const auto read = parse_scene(scene, "a");
        EXPECT_TRUE(read.ok()) << scene << (read ? "" : read.error().message());
        EXPECT_TRUE(valid(scene)) << scene;
    }
}

TEST(SceneSchema, RefusesWhatTheReaderRefuses) {
    for (const std::string& scene : {
             std::string("[]"),
             std::string(R"({ "cloths": [ {} ] })"),
             std::string(R"({ "weft": 1, "cloths": [] })"),
             std::string(R"({ "weft": 2, "cloths": [ {} ] })"),
             std::string(R"({ "weft": 1, "cloths": [ {} ], "gravty": [0, 0, 0] })"),
             std::string(R"({ "weft": 1, "cloths": [ {} ], "gravity": [0, 0] })"),
             std::string(R"({ "weft": 1, "cloths": [ {} ], "gravity": -9.81 })"),
             std::string(R"({ "weft": 1, "cloths": [ {} ], "frame_rate": 0 })"),
             std::string(R"({ "weft": 1, "cloths": [ {} ], "solver": { "substeps": 2.5 } })"),
             std::string(R"({ "weft": 1, "cloths": [ {} ], "solver": { "substeps": 0 } })"),
             std::string(R"({ "weft": 1, "cloths": [ {} ], "solver": { "method": "magic" } })"),
             with_cloth(R"("fabric": "slik")"),
             with_cloth(R"("fabric": { "preset": "slik" })"),
             with_cloth(R"("fabric": { "density": -1 })"),
             with_cloth(R"("fabric": { "stretch": [1, 2, 3] })"),
             with_cloth(R"("fabric": { "rest_angle": 181 })"),
             with_cloth(R"("fabric": { "rest_angle": "flat" })"),
             with_cloth(R"("fabric": { "inextensible": 1 })"),
             with_cloth(R"("mesh": {})"),
             with_cloth(R"("mesh": { "grid": {}, "file": "a.obj" })"),
             with_cloth(R"("mesh": { "grid": {}, "scale": 2 })"),
             with_cloth(R"("mesh": { "grid": { "diagonal": "zigzag" } })"),
             with_cloth(R"("pins": [ {} ])"),
             with_cloth(R"("pins": [ { "vertices": [-1] } ])"),
             with_cloth(R"("groups": [ { "vertices": [0] } ])"),
             with_cloth(R"("groups": [ { "name": "hem" } ])"),
             with_cloth(R"("groups": [ { "name": "hem", "vertices": [] } ])"),
             with_cloth(R"("pins": [ { "vertices": [0], "threshold": 0.5 } ])"),
             with_cloth(R"("pins": [ { "box": { "min": [0, 0, 0] } } ])"),
             with_cloth(R"("name": 7)"),
             with_cloth(R"("velocity": [0, 1e5, 0])"),
             with_cloth(R"("velocity": 3)"),
             with_cloth(R"("self_collision": 1)"),
             with_cloth(R"("self_collision": "on")"),
             with_cloth(R"("tethers": true)"),
             with_cloth(R"("tearing": "cuts", "cuts": [ {} ])"),
             with_cloth(R"("tearing": "cuts", "cuts": [ { "plane": {}, "points": [ [0, 0, 0], [1, 0, 0] ] } ])"),
             with_cloth(R"("tearing": "cuts", "cuts": [ { "points": [ [0, 0, 0] ] } ])"),
             with_cloth(R"("tearing": "cuts", "cuts": [ { "points": [ [0, 0, 0], [1, 0] ] } ])"),
             with_cloth(R"("tearing": "cuts", "cuts": [ { "points": [ [0, 0, 0], [1, 0, 2e6] ] } ])"),
             with_cloth(R"("tearing": "cuts", "cuts": [ { "time": -1, "plane": {} } ])"),
             with_cloth(R"("tearing": "cuts", "cuts": [ { "plane": { "offset": "a" } } ])"),
             with_cloth(R"("tearing": "split", "seams": [ { "plane": {} } ])"),
             with_cloth(R"("tearing": "split", "seams": [ { "strength": 0, "plane": {} } ])"),
             with_cloth(R"("tearing": "split", "seams": [ { "strength": 5, "points": [ [0, 0, 0] ] } ])"),
             with_cloth(R"("tearing": "split", "resistance": [ { "factor": 2 } ])"),
             with_cloth(R"("tearing": "split", "resistance": [ { "factor": 0, "vertices": [0] } ])"),
             with_cloth(R"("tearing": "split", "resistance": [ { "channel": "hue" } ])"),
             with_cloth(R"("weights": [ { "factor": 2, "vertices": [0] } ])"),
             with_cloth(R"("weights": [ { "of": "color", "factor": 2, "vertices": [0] } ])"),
             with_cloth(R"("weights": [ { "of": "bend", "factor": 0, "vertices": [0] } ])"),
             with_cloth(R"("tearing": "split", "resistance": [ { "box": { "min": 0, "max": 1 }, "factors": [1] } ])"),
             with_cloth(R"("tearing": "split", "resistance": [ { "vertices": [0], "factors": [0] } ])"),
             with_cloth(R"("tearing": "rip")"),
             with_collider(""),
             with_collider(R"("plane": {}, "sphere": {})"),
             with_collider(R"("sphere": { "radius": 0 })"),
             with_collider(R"("sphere": {}, "transform": { "scale": 2 })"),
             with_collider(R"("sphere": {}, "motion": {})"),
             with_collider(R"("sphere": {}, "motion": "dynamic")"),
             with_collider(R"("sphere": {}, "motion": { "keys": [ {} ], "dynamic": {} })"),
             with_collider(R"("sphere": {}, "motion": { "dynamic": { "mass": -1 } })"),
             with_collider(R"("sphere": {}, "motion": { "dynamic": { "density": 0 } })"),
             with_collider(R"("sphere": {}, "motion": { "dynamic": { "spin": 360 } })"),
             with_collider(R"("sphere": {}, "motion": { "dynamic": { "restitution": 1.1 } })"),
             with_wind(R"("motion": { "dynamic": {} })"),
             with_wind(R"("kind": "storm")"),
             with_wind(R"("velocity": [1e6, 0, 0])"),
             with_wind(R"("diameter": 1)"),
             with_wind(R"("kind": "vortex", "diameter": 1)"),
             with_wind(R"("kind": "jet", "swirl": 1)"),
             with_wind(R"("kind": "jet", "diameter": 0)"),
             with_wind(R"("kind": "vortex", "radius": 0)"),
             with_wind(R"("box": { "half_extents": [1, 0, 1] })"),
             with_wind(R"("box": { "half_extents": 1 })"),
             with_wind(R"("box": { "border": -1 })"),
             with_wind(R"("shelter": -1)"),
             with_wind(R"("transform": { "scale": 2 })"),
             with_wind(R"("motion": { "keys": [ { "strength": -1 } ] })"),
             with_pictures(R"("camera": [1, 2, 3])"),
             with_pictures(R"("camera": { "position": 1 })"),
             with_pictures(R"("camera": { "fov": 151 })"),
             with_pictures(R"("light": { "sun": "bright" })"),
             with_pictures(R"("light": { "sky": { "zenith": [0, 0, 2] } })"),
             with_pictures(R"("light": { "environment": { "visible": 1 } })"),
             with_pictures(R"("look": { "cloth 0": "velvet" })"),
             with_cloth(R"("material": "velvt")"),
             with_collider(R"("sphere": {}, "material": "velvt")"),
             with_cloth(R"("material": { "preset": "velvt" })"),
             with_cloth(R"("material": { "colr": [0, 0, 0] })"),
             with_cloth(R"("material": { "coverage": 0 })"),
             with_cloth(R"("material": 3)"),
         }) {
        EXPECT_FALSE(parse_scene(scene, "a").ok()) << scene;
        EXPECT_FALSE(valid(scene)) << scene;
    }
}

/// The schema at a place such as "/cloths/*/mesh".
Json schema_at(const std::string& place) {
    Json schema = Json::parse(scene_schema());
    std::istringstream keys(place.substr(std::min<std::size_t>(place.size(), 1)));
    for (std::string key; std::getline(keys, key, '/');) {
        if (schema.contains("anyOf")) schema = Json(schema["anyOf"].back());
        schema = key == "*" ? Json(schema.at("items")) : Json(schema.at("properties").at(key));
    }
    return schema.contains("anyOf") ? Json(schema["anyOf"].back()) : schema;
}

TEST(SceneSchema, HasEveryKeyWithItsMeaningUnitAndDefault) {
    for (const SceneTable& table : scene_tables()) {
        const Json schema = schema_at(std::string(table.place));
        for (const Parameter& p : table.keys) {
            const Json& key = schema.at("properties").at(std::string(p.key));
            const std::string description = key.at("description");
            EXPECT_EQ(description.find(p.what), 0u) << table.place << '/' << p.key;
            EXPECT_NE(description.find(p.unit), description.npos) << table.place << '/' << p.key;
            const bool has_value = p.kind != ParameterKind::object && p.kind != ParameterKind::list &&
                                   p.kind != ParameterKind::text && !p.required && table.defaults != nullptr;
            if (has_value) {
                ASSERT_TRUE(key.contains("default")) << table.place << '/' << p.key;
                EXPECT_TRUE(Validator().valid(key, key["default"])) << table.place << '/' << p.key;
            }
        }
    }
    EXPECT_EQ(schema_at("/cloths/*/fabric/density").at("default").dump(), "0.14");
    EXPECT_EQ(schema_at("/cloths/*/fabric/preset").at("default"), "cotton");
    EXPECT_EQ(schema_at("/cloths/*/fabric/preset").at("enum").size(), fabric_presets().size());
    EXPECT_EQ(schema_at("/cloths/*/material/preset").at("enum").size(), material_presets().size());
    EXPECT_EQ(schema_at("/light/sun/intensity").at("default").get<float>(), Sun().intensity);
    EXPECT_EQ(schema_at("/gravity").at("default").dump(), "[0,-9.81,0]");
}

/// The names in the reader's `must have one of "grid", "box" or "file"`.
std::set<std::string> names_wanted(const std::string& scene) {
    std::set<std::string> names;
    const auto read = parse_scene(scene, "a");
    EXPECT_FALSE(read.ok()) << scene;
    if (read.ok()) return names;
    const std::string what = read.error().what;
    EXPECT_EQ(what.find("must have one of "), 0u) << what;
    for (std::size_t open = what.find('"'); open != what.npos; open = what.find('"', open)) {
        const std::size_t close = what.find('"', open + 1);
        names.insert(what.substr(open + 1, close - open - 1));
        open = close + 1;
    }
    return names;
}

std::set<std::string> names_offered(const std::string& place) {
    std::set<std::string> names;
    const Json schema = schema_at(place);
    for (const Json& one : schema.at("oneOf")) names.insert(one.at("required").at(0));
    return names;
}

TEST(SceneSchema, KnowsTheKindsThatTheReaderKnows) {
    EXPECT_EQ(names_offered("/cloths/*/mesh"), names_wanted(with_cloth(R"("mesh": {})")));
    EXPECT_EQ(names_offered("/cloths/*/pins/*"), names_wanted(with_cloth(R"("pins": [ {} ])")));
    EXPECT_EQ(names_offered("/cloths/*/cuts/*"), names_wanted(with_cloth(R"("tearing": "cuts", "cuts": [ {} ])")));
    EXPECT_EQ(names_offered("/cloths/*/seams/*"),
              names_wanted(with_cloth(R"("tearing": "split", "seams": [ { "strength": 1 } ])")));
    EXPECT_EQ(names_offered("/cloths/*/resistance/*"),
              names_wanted(with_cloth(R"("tearing": "split", "resistance": [ {} ])")));
    EXPECT_EQ(names_offered("/cloths/*/weights/*"), names_wanted(with_cloth(R"("weights": [ { "of": "bend" } ])")));
    EXPECT_EQ(names_offered("/colliders/*"), names_wanted(with_collider("")));
}

}  // namespace
}  // namespace weft
