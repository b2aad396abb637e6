#include "editor/app/objects.h"

#include "editor/app/property_tables.h"
#include "editor/app/session.h"
#include "editor/tools/picking.h"
#include "scene/scene_keys.h"
#include "solver/world/collider_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <span>
#include <utility>

namespace weft::editor {
namespace {

constexpr AddableObject addable[] = {
    {"cloth", "Cloth", "a flat sheet of cotton, 1 m wide", Icon::cloth, true},
    {"box", "Box", "a solid box", Icon::box, true},
    {"sphere", "Sphere", "a solid ball", Icon::sphere, true},
    {"mesh", "Mesh", "a cloth from a mesh file", Icon::mesh, true},
    {"capsule", "Capsule", "a solid capsule", Icon::capsule, false},
    {"plane", "Plane", "the solid half space below a plane", Icon::plane, false},
    {"solid", "Solid", "a mesh file as a solid", Icon::mesh, false},
    {"wind", "Wind", "a wind source", Icon::wind, false},
    {"stitch", "Stitch", "ties two points of cloth together", Icon::stitch, false},
};

Json at_height(float height) {
    return Json{{"position", {0, number(height), 0}}};
}

/// m: beside the colliders that are there.
float free_place(const Document& document) {
    constexpr float gap = 0.6f;
    float x = 0;
    for (const SceneCollider& one : document.scene.colliders)
        if (!std::holds_alternative<PlaneDesc>(one.shape)) x = std::max(x, one.transform.position.x + gap);
    return x;
}

Json collider(const Document& document, const char* shape, const char* name, Json values, float height) {
    return Json{{"name", free_name(document, name)},
                {shape, std::move(values)},
                {"transform", {{"position", {number(free_place(document)), number(height), 0}}}}};
}

/// `shirt` of `folder/shirt.obj`.
std::string name_of_file(const std::string& file) {
    return std::filesystem::path(file).stem().string();
}

Addition append(const Document& document, const std::string& list, Json value) {
    return {{{list + "/-", std::move(value)}}, place_after_append(document, list)};
}

// Linear RGB. Cloths get colors that differ at a glance, colliders neutral ones.
constexpr std::array<Vec3, 8> cloth_colors{{
    {0.0231f, 0.208f, 0.227f},   // teal
    {0.453f, 0.0869f, 0.0446f},  // brick
    {0.592f, 0.316f, 0.0415f},   // ochre
    {0.0582f, 0.0915f, 0.311f},  // indigo
    {0.251f, 0.0619f, 0.164f},   // plum
    {0.164f, 0.212f, 0.0511f},   // olive
    {0.56f, 0.139f, 0.177f},     // rose
    {0.0697f, 0.267f, 0.41f},    // sky
}};
constexpr std::array<Vec3, 4> collider_colors{{
    {0.349f, 0.32f, 0.28f},    // warm gray
    {0.164f, 0.19f, 0.227f},   // slate
    {0.56f, 0.476f, 0.349f},   // sand
    {0.106f, 0.106f, 0.117f},  // charcoal
}};

/// The first color that no object of the list has; if all are used, the next one in turn.
Json free_color(const Document& document, const std::string& list, std::span<const Vec3> colors) {
    const Json* objects = find(document.json, list);
    const auto as_json = [](Vec3 c) { return Json{number(c.x), number(c.y), number(c.z)}; };
    for (const Vec3 color : colors) {
        const Json wanted = as_json(color);
        bool used = false;
        for (std::size_t i = 0; objects && i < objects->size(); ++i) {
            const Json* of = find(document.json, list + "/" + std::to_string(i) + "/material/color");
            used = used || (of && *of == wanted);
        }
        if (!used) return wanted;
    }
    return as_json(colors[(objects ? objects->size() : 0) % colors.size()]);
}

Json colored(const Document& document, const std::string& list, std::span<const Vec3> colors, Json object) {
    object["material"]["color"] = free_color(document, list, colors);
    return object;
}
Json colored_cloth(const Document& document, Json cloth) {
    return colored(document, "/cloths", cloth_colors, std::move(cloth));
}
Json colored_collider(const Document& document, Json collider) {
    return colored(document, "/colliders", collider_colors, std::move(collider));
}

}  // namespace

std::span<const AddableObject> addable_objects() {
    return addable;
}

Room room_of(const WorldFrame& world) {
    Room room;
    for (const ClothFrame& cloth : world.frame().cloths)
        for (const Vec4& p : cloth.positions) room.objects.include(p.xyz());
    for (const Collider& collider : world.colliders()) {
        if (const Bounds solid = bounds_of(collider); !solid.empty()) room.objects.include(solid);
        if (collider.shape != ShapeKind::plane) continue;
        const PickSurface plane = pick_surface(collider, nullptr);
        if (!plane.plane) continue;
        if ((plane.pose.rotation * plane.plane->normal).y < 0.99f) continue;
        const float height = to_world(plane.pose, plane.plane->normal * plane.plane->offset).y;
        room.floor = std::max(room.floor.value_or(height), height);
    }
    return room;
}

Vec3 place_above(const Bounds& mesh, const Room& room) {
    constexpr float gap = 0.1f;  // m
    if (mesh.empty() || (room.objects.empty() && !room.floor)) return {};
    const auto millimeters = [](float x) { return std::round(x * 1000) / 1000; };
    Vec3 place;
    if (!room.objects.empty()) {
        const Vec3 from = (mesh.min + mesh.max) * 0.5f, to = (room.objects.min + room.objects.max) * 0.5f;
        place = {millimeters(to.x - from.x), 0, millimeters(to.z - from.z)};
    }
    const float top = room.objects.empty() ? *room.floor : std::max(room.objects.max.y, room.floor.value_or(-far_away));
    place.y = millimeters(top + gap - mesh.min.y);
    return place;
}

Result<Addition> addition(const Document& document, std::string_view name, const std::string& file,
                          std::optional<Vec3> position, bool has_colors) {
    if (name == "cloth") {
        Json sheet{{"name", free_name(document, "sheet")},
                   {"mesh", {{"grid", {{"size", {1, 1}}, {"resolution", {64, 64}}}}}},
                   {"transform", at_height(1 + 0.25f * static_cast<float>(document.scene.cloths.size()))}};
        return append(document, "/cloths", colored_cloth(document, std::move(sheet)));
    }
    if (name == "mesh" || name == "solid") {
        if (file.empty()) return Error{"mesh", "needs the name of a mesh file"};
        const std::string called = free_name(document, name_of_file(file));
        Json cloth{{"name", called}, {"mesh", {{"file", file}}}};
        if (position && *position != Vec3{})
            cloth["transform"] = {{"position", {number(position->x), number(position->y), number(position->z)}}};
        if (name == "mesh")
            return append(document, "/cloths", has_colors ? std::move(cloth) : colored_cloth(document, cloth));
        return append(document, "/colliders",
                      colored_collider(document, Json{{"name", called}, {"mesh", {{"file", file}}}}));
    }
    if (name == "box")
        return append(document, "/colliders",
                      colored_collider(
                          document, collider(document, "box", "box", Json{{"half_extents", {0.2, 0.2, 0.2}}}, 0.2f)));
    if (name == "sphere")
        return append(document, "/colliders",
                      colored_collider(document, collider(document, "sphere", "ball", Json{{"radius", 0.25}}, 0.25f)));
    if (name == "capsule")
        return append(document, "/colliders",
                      colored_collider(document, collider(document, "capsule", "capsule",
                                                          Json{{"radius", 0.1}, {"half_height", 0.2}}, 0.3f)));
    if (name == "plane")
        return append(document, "/colliders", Json{{"name", free_name(document, "floor")}, {"plane", Json::object()}});
    if (name == "wind") return append(document, "/air/wind", Json{{"velocity", {3, 0, 0}}});
    if (name == "stitch") {
        const auto stitch = new_element(document, "/stitches");
        if (!stitch) return Error{"stitch", "needs a cloth; add one first"};
        return append(document, "/stitches", *stitch);
    }
    return Error{"add", "\"" + std::string(name) + "\" is no kind of object"};
}

Result<Addition> duplication(const Document& document, const std::string& place) {
    const Json* object = find(document.json, place);
    if (!is_object(place) || !object) return Error{place, "cannot be duplicated"};
    Json copy = *object;
    if (copy.contains("name")) copy["name"] = free_name(document, copy["name"].get<std::string>());
    Json& position = copy["transform"]["position"];
    if (!position.is_array() || position.size() != 3) position = {0, 0, 0};
    position[0] = number(position[0].get<float>() + 0.25f);
    return append(document, place.substr(0, place.rfind('/')), std::move(copy));
}

std::vector<Edit> removal(const Document& document, const std::string& place) {
    std::vector<Edit> edits;
    const Json* object = find(document.json, place);
    const std::string name = object && object->is_object() ? object->value("name", "") : "";
    const SceneDesc& scene = document.scene;
    if (place.starts_with("/colliders/")) {
        for (std::size_t i = 0; i < scene.cloths.size(); ++i)
            for (std::size_t k = 0; k < scene.cloths[i].pins.size(); ++k)
                if (scene.cloths[i].pins[k].attach == name)
                    edits.push_back({"/cloths/" + std::to_string(i) + "/pins/" + std::to_string(k) + "/attach", {}});
    } else if (place.starts_with("/cloths/")) {
        for (std::size_t i = scene.stitches.size(); i-- > 0;)
            if (scene.stitches[i].a.cloth == name || scene.stitches[i].b.cloth == name)
                edits.push_back({"/stitches/" + std::to_string(i), {}});
    }
    edits.push_back({place, {}});
    return edits;
}

bool is_object(const std::string& place) {
    const std::string pattern = pattern_of(place);
    return pattern == "/cloths/*" || pattern == "/colliders/*" || pattern == "/air/wind/*" || pattern == "/stitches/*";
}

std::string describe_object(const Document& document, const std::string& place) {
    if (place == "/.") return "Scene";
    const Json* object = find(document.json, place);
    const std::string name = object && object->is_object() ? object->value("name", "") : "";
    if (!name.empty()) return name;
    const std::string pattern = pattern_of(place);
    const std::string number = " " + place.substr(place.rfind('/') + 1);
    if (pattern == "/air/wind/*") return "wind" + number;
    if (pattern == "/stitches/*") return "stitches" + number;
    return label_of_key(place.substr(place.rfind('/') + 1));
}

Icon icon_of(const Document& document, const std::string& place) {
    const std::string pattern = pattern_of(place);
    if (pattern == "/cloths/*") return Icon::cloth;
    if (pattern == "/air/wind/*" || place == "/air") return Icon::wind;
    if (pattern == "/stitches/*") return Icon::stitch;
    if (place == "/light") return Icon::light;
    if (place == "/camera") return Icon::camera;
    if (place == "/solver") return Icon::settings;
    const Json* object = find(document.json, place);
    const auto has = [&](const char* key) { return object && object->is_object() && object->contains(key); };
    if (has("sphere")) return Icon::sphere;
    if (has("box")) return Icon::box;
    if (has("capsule") || has("tapered_capsule")) return Icon::capsule;
    if (has("plane")) return Icon::plane;
    if (has("mesh") || has("convex")) return Icon::mesh;
    return Icon::file;
}

}  // namespace weft::editor
