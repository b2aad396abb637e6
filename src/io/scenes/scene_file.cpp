#include "io/scenes/scene_file.h"

#include "io/scenes/json_reader.h"
#include "io/scenes/json_text.h"
#include "io/scenes/scene_look.h"
#include "scene/check.h"
#include "scene/materials.h"
#include "scene/nearest_name.h"
#include "scene/scene_keys.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

namespace weft {
namespace {

using nlohmann::json;

void read_head(ObjectReader& scene) {
    SceneHead head;
    scene.values(head_keys, &head);
    if (head.weft != scene_format)
        scene.problems().add(at(scene.pointer(), "weft"), "must be " + number_text(scene_format) +
                                                              ", the only format this version reads, got " +
                                                              number_text(head.weft));
}

// Calls read(motion) for a motion, if there is one that is not "static". `wanted`: the keys that it can have.
template <class Read>
void read_motion(ObjectReader& o, const char* wanted, Read&& read) {
    const json* found = o.find("motion");
    if (!found || *found == "static") return;
    if (found->is_object()) return o.object("motion", read);
    o.problems().add(at(o.pointer(), "motion"),
                     std::string("must be \"static\" or an object with ") + wanted + ", got " + json_text(*found));
}

// `like`: values that a key does not give.
template <class Key>
void read_keys(ObjectReader& motion, std::span<const Parameter> table, const Key& like, std::vector<Key>& result) {
    motion.objects("keys", [&](ObjectReader& key) { key.values(table, &result.emplace_back(like)); });
    const json* keys = motion.find("keys");
    if (keys == nullptr || (keys->is_array() && keys->empty()))
        motion.problems().add(at(motion.pointer(), "keys"), "must hold at least one key");
}

// Keys of a kind of wind, which are a problem if the wind is of another kind.
template <class Kind>
void read_kind(ObjectReader& o, std::string_view name, bool chosen, std::span<const Parameter> table, WindDesc& wind) {
    if (chosen) return o.values(table, &wind.kind.emplace<Kind>());
    o.know(table);
    for (const Parameter& p : table)
        if (o.find(p.key)) o.problems().add(at(o.pointer(), p.key), "requires \"kind\": " + in_quotes(name));
}

void read_wind(ObjectReader& o, WindDesc& wind) {
    WindHead head;
    o.values(wind_head_keys, &head);
    o.values(wind_keys, &wind);
    int kind = 0;
#define WEFT_WIND(name, Name) read_kind<Name##Desc>(o, #name, head.kind == kind++, name##_parameters, wind);
#include "physics/air/winds.def"
#undef WEFT_WIND
    o.object("transform", [&](ObjectReader& t) { t.values(pose_keys, &wind.transform); });
    const WindKey like{.position = wind.transform.position, .rotation_degrees = wind.transform.rotation_degrees};
    read_motion(o, "keys", [&](ObjectReader& motion) {
        motion.know(motion_keys);
        read_keys(motion, wind_key_keys, like, wind.motion);
    });
    o.object("box", [&](ObjectReader& box) { box.values(wind_box_keys, &wind.box.emplace()); });
    o.object("gust", [&](ObjectReader& gust) { gust.values(gust_keys, &wind.gust); });
    o.object("turbulence", [&](ObjectReader& t) { t.values(turbulence_keys, &wind.turbulence); });
}

void read_air(ObjectReader& o, AirDesc& air) {
    o.values(air_keys, &air);
    o.objects("wind", [&](ObjectReader& wind) { read_wind(wind, air.wind.emplace_back()); });
}

template <class Shape>
void read_made(ObjectReader& mesh, std::string_view kind, std::span<const Parameter> keys, MeshDesc& result) {
    auto& shape = result.emplace<Shape>();
    mesh.object(kind, [&](ObjectReader& o) { o.values(keys, &shape); });
    mesh.only_with("file", mesh_file_keys);
}

void read_mesh(ObjectReader& mesh, MeshDesc& result) {
    MeshFileDesc file;
    mesh.know(mesh_keys);
    mesh.values(mesh_file_keys, &file);
    const std::string_view kind = mesh.one_of({"grid", "sphere", "box", "file"});
    if (kind == "file") result = std::move(file);
    if (kind == "grid") read_made<GridDesc>(mesh, kind, grid_keys, result);
    if (kind == "sphere") read_made<SphereMeshDesc>(mesh, kind, sphere_mesh_keys, result);
    if (kind == "box") read_made<BoxMeshDesc>(mesh, kind, box_mesh_keys, result);
}

void use_preset(const std::string& name, const std::string& place, SceneCloth& cloth, Problems& problems) {
    if (const FabricPreset* preset = find_fabric(name)) {
        cloth.fabric = preset->fabric;
        cloth.fabric_name = name;
        return;
    }
    std::vector<std::string_view> names;
    for (const FabricPreset& preset : fabric_presets()) names.push_back(preset.name);
    problems.add(place, "unknown fabric " + in_quotes(name) + suggestion(name, names));
}

void read_fabric_object(ObjectReader& o, SceneCloth& cloth) {
    FabricHead head;
    o.values(fabric_keys, &head);
    use_preset(head.preset, at(o.pointer(), "preset"), cloth, o.problems());
    Fabric& fabric = cloth.fabric;
    for (const FabricTable& table : fabric_tables())
        o.values(table.parameters, reinterpret_cast<std::byte*>(&fabric) + table.offset);

    follow_stretch(fabric, o.find("stretch") != nullptr, o.find("compression") != nullptr);
}

void read_fabric(ObjectReader& o, SceneCloth& cloth) {
    const json* found = o.find("fabric");
    const std::string place = at(o.pointer(), "fabric");
    if (!found) return;
    if (found->is_string())
        use_preset(found->get<std::string>(), place, cloth, o.problems());
    else if (found->is_object())
        o.object("fabric", [&](ObjectReader& fabric) { read_fabric_object(fabric, cloth); });
    else
        o.problems().add(place, "must be the name of a fabric or an object, got " + json_text(*found));
}

using Groups = std::vector<VertexGroup>;

void read_group(ObjectReader& o, VertexGroup& group) {
    o.values(group_keys, &group);
    group.vertices = o.indices("vertices");
}

VertexPins in_group(ObjectReader& o, const std::string& name, const Groups& groups) {
    const auto found = std::ranges::find(groups, name, &VertexGroup::name);
    if (found != groups.end()) return {found->vertices, name};
    std::vector<std::string_view> names;
    for (const VertexGroup& group : groups) names.push_back(group.name);
    o.problems().add(at(o.pointer(), "group"), "unknown group " + in_quotes(name) + suggestion(name, names));
    return {{}, name};
}

// Vertices, a group, a box or a color.
template <class Select>
void read_selection(ObjectReader& o, std::string_view kind, const ColorPins& by_color, const GroupHead& by_group,
                    const Groups& groups, Select& select) {
    if (kind == "vertices") select = VertexPins{o.indices("vertices")};
    if (kind == "group") select = in_group(o, by_group.group, groups);
    if (kind == "box") {
        BoxPins in_box;
        o.object("box", [&](ObjectReader& box) { box.values(box_keys, &in_box.box); });
        select = in_box;
    }
    if (kind == "color") select = by_color;
}

void read_pin(ObjectReader& pin, const Groups& groups, PinDesc& result) {
    ColorPins by_color;
    GroupHead by_group;
    pin.know(pin_keys);
    pin.values(in_group_keys, &by_group);
    pin.values(color_pin_keys, &by_color);
    pin.values(pin_motion_keys, &result);
    const std::string_view kind = pin.one_of({"vertices", "group", "box", "color"});
    read_selection(pin, kind, by_color, by_group, groups, result.select);
    if (!kind.empty()) pin.only_with("color", color_pin_keys);
    pin.objects("motion", [&](ObjectReader& key) { key.values(offset_key_keys, &result.motion.emplace_back()); });
}

// `desc`: a cut or a seam.
template <class Desc>
void read_path(ObjectReader& o, std::span<const Parameter> keys, Desc& desc) {
    o.values(keys, &desc);
    const std::string_view kind = o.one_of({"points", "plane"});
    if (kind == "points") desc.along = PathCut{o.points("points")};
    if (kind == "plane")
        o.object("plane",
                 [&](ObjectReader& plane) { plane.values(cut_plane_keys, &desc.along.template emplace<PlaneCut>()); });
}

// `result`: a ResistanceDesc or a WeightDesc. `keys`: that of its factor.
template <class Desc>
void read_painted(ObjectReader& o, std::span<const Parameter> keys, const Groups& groups, Desc& result) {
    ColorPins by_color;
    GroupHead by_group;
    PaintedChannel painted;
    o.know(resistance_vertex_keys);
    o.know(resistance_keys);
    o.values(in_group_keys, &by_group);
    o.values(color_pin_keys, &by_color);
    o.values(painted_channel_keys, &painted);
    o.values(keys, &result);
    const std::string_view kind = o.one_of({"vertices", "group", "box", "color", "channel"});
    read_selection(o, kind, by_color, by_group, groups, result.select);
    if (kind == "channel") result.select = painted;
    result.factors = o.numbers("factors");
    if (!kind.empty()) o.only_with("color", color_pin_keys), o.only_with("vertices", resistance_vertex_keys);
}

void read_cloth(ObjectReader& o, SceneCloth& cloth) {
    o.values(cloth_keys, &cloth);
    o.object("mesh", [&](ObjectReader& mesh) { read_mesh(mesh, cloth.mesh); });
    o.object("render_mesh", [&](ObjectReader& mesh) { read_mesh(mesh, cloth.render_mesh.emplace()); });
    o.object("transform", [&](ObjectReader& t) { t.values(transform_keys, &cloth.transform); });
    read_fabric(o, cloth);
    o.objects("groups", [&](ObjectReader& group) { read_group(group, cloth.groups.emplace_back()); });
    o.objects("pins", [&](ObjectReader& pin) { read_pin(pin, cloth.groups, cloth.pins.emplace_back()); });
    o.objects("cuts", [&](ObjectReader& cut) { read_path(cut, cut_keys, cloth.cuts.emplace_back()); });
    o.objects("seams", [&](ObjectReader& seam) { read_path(seam, seam_keys, cloth.seams.emplace_back()); });
    o.objects("resistance", [&](ObjectReader& one) {
        read_painted(one, resistance_factor_keys, cloth.groups, cloth.resistance.emplace_back());
    });
    o.objects("weights", [&](ObjectReader& one) {
        WeightDesc& weight = cloth.weights.emplace_back();
        one.values(weight_keys, &weight);
        read_painted(one, weight_factor_keys, cloth.groups, weight);
    });
    read_material(o, default_material(cloth), cloth.material);
}

template <class Shape>
void read_shape(ObjectReader& collider, std::string_view kind, std::span<const Parameter> keys, Shape& shape) {
    collider.object(kind, [&](ObjectReader& o) { o.values(keys, &shape); });
}

void read_shape(ObjectReader& collider, std::string_view kind, std::span<const Parameter> keys, ConvexDesc& convex) {
    collider.object(kind, [&](ObjectReader& o) {
        o.values(keys, &convex);
        if (!o.find("points")) return;
        convex.mesh.positions = o.points("points");
        if (!convex.file.empty()) (void)o.one_of({"file", "points"});
    });
}

void read_collider(ObjectReader& o, SceneCollider& collider) {
    o.values(collider_keys, static_cast<ColliderDesc*>(&collider));
    const std::string_view kind = o.one_of(shape_keys);
#define WEFT_SHAPE(name, Name) \
    if (kind == #name) read_shape(o, kind, name##_parameters, collider.shape.emplace<Name##Desc>());
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    o.object("transform", [&](ObjectReader& t) { t.values(pose_keys, &collider.transform); });
    const PoseKey like{.position = collider.transform.position,
                       .rotation_degrees = collider.transform.rotation_degrees};
    read_motion(o, "\"keys\" or \"dynamic\"", [&](ObjectReader& motion) {
        motion.know(collider_motion_keys);
        const std::string_view by = motion.one_of({"keys", "dynamic"});
        if (by == "keys") read_keys(motion, pose_key_keys, like, collider.motion);
        if (by == "dynamic")
            motion.object(by,
                          [&](ObjectReader& body) { body.values(rigid_body_parameters, &collider.body.emplace()); });
    });
    read_material(o, default_material(collider), collider.material);
}

void read_stitch_end(ObjectReader& o, StitchEnd& end) {
    o.values(stitch_end_keys, &end);
    if (o.find("vertices")) end.vertices = o.indices("vertices");
    o.objects("points", [&](ObjectReader& point) { point.values(surface_point_keys, &end.points.emplace_back()); });
}

void read_stitches(ObjectReader& o, StitchDesc& stitches) {
    o.values(stitch_keys, &stitches);
    o.object("a", [&](ObjectReader& end) { read_stitch_end(end, stitches.a); });
    o.object("b", [&](ObjectReader& end) { read_stitch_end(end, stitches.b); });
}

SceneDesc read_values(const json& value, Problems& problems) {
    SceneDesc scene;
    ObjectReader o(value, "", problems);
    if (!value.is_object()) return scene;
    read_head(o);
    o.values(scene_keys, &scene);
    o.object("solver", [&](ObjectReader& solver) { solver.values(solver_keys, &scene.solver); });
    o.object("air", [&](ObjectReader& air) { read_air(air, scene.air.emplace()); });
    o.objects("cloths", [&](ObjectReader& cloth) { read_cloth(cloth, scene.cloths.emplace_back()); });
    o.objects("colliders", [&](ObjectReader& collider) { read_collider(collider, scene.colliders.emplace_back()); });
    o.objects("stitches", [&](ObjectReader& row) { read_stitches(row, scene.stitches.emplace_back()); });
    read_pictures(o, scene);
    o.finish();
    return scene;
}

// `check`: the checks of the whole scene.
Result<SceneDesc> checked(SceneDesc scene, Problems problems, std::string_view name,
                          void (*check)(const SceneDesc&, Problems&)) {
    // Values that could not be read have their defaults; check errors about those would be misleading.
    Problems of_values(&problems);
    check(scene, of_values);
    problems.append(std::move(of_values));
    if (!problems.none()) return std::move(problems).take(name);
    name_unnamed(scene);
    return scene;
}

}  // namespace

Result<SceneDesc> parse_scene(std::string_view text, std::string_view name) {
    Problems problems;
    const std::optional<json> value = parse_json(text, problems);
    if (!value) return std::move(problems).take(name);
    SceneDesc scene = read_values(*value, problems);
    return checked(std::move(scene), std::move(problems), name, check_scene);
}

Result<SceneDesc> read_scene(const json& value, std::string_view name) {
    Problems problems;
    SceneDesc scene = read_values(value, problems);
    return checked(std::move(scene), std::move(problems), name, check_parts);
}

Result<SceneDesc> load_scene(const std::filesystem::path& path) {
    const auto text = read_scene_text(path);
    if (!text) return text.errors();
    return parse_scene(*text, path.string());
}

Result<std::string> read_scene_text(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return Error{name, "is a folder, not a scene file"};
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{name, "cannot be opened: " + std::generic_category().message(errno)};

    // Reads in pieces without asking for the size of the file, because a pipe has none.
    std::string text;
    constexpr std::size_t piece = std::size_t{1} << 16;
    while (file && text.size() <= max_json_bytes) {
        const std::size_t before = text.size();
        text.resize(before + piece);
        file.read(text.data() + before, piece);
        text.resize(before + static_cast<std::size_t>(file.gcount()));
    }
    if (file.bad()) return Error{name, "cannot be read"};
    return text;
}

}  // namespace weft
