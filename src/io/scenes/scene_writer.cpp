#include "io/scenes/scene_writer.h"

#include "io/scenes/json_text.h"
#include "io/scenes/json_writer.h"
#include "scene/check.h"
#include "scene/materials.h"
#include "scene/scene_keys.h"
#include "scene/values.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

namespace weft {
namespace {

/// The value under a key that is an object or a list; nothing if there is nothing to write.
using Child = std::optional<JsonNode>;

class SceneWriter {
  public:
    JsonNode scene(const SceneDesc& scene);
    Problems& problems() { return problems_; }

  private:
    using Children = std::function<Child(std::string_view key, const std::string& place)>;
    /// A key that takes the value of another key, its leader, if the file gives only the leader.
    struct Following {
        std::string_view leader, follower;
    };

    void values(JsonNode& to, std::span<const Parameter> table, const void* base, const void* defaults,
                const std::string& place, const Children& children = {}, Following following = {});
    JsonNode value(const Parameter& p, const void* base, const std::string& place);
    JsonNode text(std::string_view value, const std::string& place);
    template <class Desc>
    JsonNode object(std::span<const Parameter> table, const Desc& desc, const Desc& defaults, const std::string& place,
                    const Children& children = {});
    template <class Item, class Write>
    JsonNode list(const std::vector<Item>& items, const std::string& place, Write&& write);

    JsonNode air(const AirDesc& air, const std::string& place);
    JsonNode wind(const WindDesc& wind, const std::string& place);
    JsonNode mesh(const MeshDesc& mesh, const std::string& place);
    Child fabric(const SceneCloth& cloth, const std::string& place);
    Child material(const std::optional<SceneMaterial>& material, const MaterialPreset& otherwise,
                   const std::string& place);
    JsonNode pin(const PinDesc& pin, const std::string& place);
    template <class Select>
    void selection(JsonNode& node, const Select& select, const std::string& place);
    template <class Desc>
    JsonNode path(std::span<const Parameter> keys, const Desc& desc, const std::string& place);
    template <class Desc>
    void painted(JsonNode& node, std::span<const Parameter> keys, const Desc& desc, const std::string& place);
    JsonNode cloth(const SceneCloth& cloth, std::size_t index, const std::string& place);
    template <class Key>
    Child motion(const std::vector<Key>& keys, std::span<const Parameter> table, const Key& like,
                 const std::string& place);
    JsonNode dynamic(const BodyDesc& body, const std::string& place);
    JsonNode points(const std::vector<Vec3>& points, const std::string& place);
    template <class Shape>
    Child points_of(const Shape& shape, const std::string& place);
    JsonNode collider(const SceneCollider& collider, std::size_t index, const std::string& place);
    JsonNode stitches(const StitchDesc& stitches, std::size_t index, const std::string& place);
    JsonNode light(const Lighting& light, const std::string& place);

    Problems problems_;
    std::vector<VertexGroup> groups_;  ///< of the cloth that is written
};

// Whether two members of one struct, of the same type and count, have the same value.
bool same_value_as(const Parameter& leader, const Parameter& follower, const void* base) {
    return same_value(leader, base, static_cast<const std::byte*>(base) + (follower.offset - leader.offset));
}

Child unless_empty(JsonNode node) {
    return node.empty() ? Child() : Child(std::move(node));
}

template <class Number>
JsonNode numbers_of(const std::vector<Number>& all) {
    JsonNode node = JsonNode::list();
    for (const Number one : all) node.add(JsonNode::number(one));
    return node;
}

template <class Read>
JsonNode numbers(const Parameter& p, bool one_for_all, Read&& read) {
    bool alike = true;
    for (std::size_t i = 1; i < p.count; ++i) alike = alike && read(i).pretty() == read(0).pretty();
    if (p.count == 1 || (one_for_all && alike)) return read(0);
    JsonNode list = JsonNode::list();
    for (std::size_t i = 0; i < p.count; ++i) list.add(read(i));
    return list;
}

JsonNode SceneWriter::text(std::string_view value, const std::string& place) {
    if (auto node = JsonNode::text(value)) return std::move(*node);
    problems_.add(place, "must be UTF-8 to be written to a file");
    return JsonNode::object();
}

JsonNode SceneWriter::value(const Parameter& p, const void* base, const std::string& place) {
    const auto number = [&](std::size_t i) { return JsonNode::number(element<float>(p, base, i)); };
    switch (p.kind) {
        case ParameterKind::number:
            return numbers(p, true, number);
        case ParameterKind::vector:
            return numbers(p, false, number);
        case ParameterKind::angle_or_mesh:
            return std::isnan(element<float>(p, base)) ? text("mesh", place) : number(0);
        case ParameterKind::integer:
            return numbers(p, false,
                           [&](std::size_t i) { return JsonNode::number(element<std::uint32_t>(p, base, i)); });
        case ParameterKind::flag:
            return JsonNode::flag(element<bool>(p, base));
        case ParameterKind::choice:
            return text(choice_names(p).at(static_cast<std::size_t>(element<int>(p, base))), place);
        case ParameterKind::text:
            return text(text_of(p, base), place);
        case ParameterKind::object:
        case ParameterKind::list:
            break;
    }
    return JsonNode::object();
}

// `children` writes the values of objects and lists; keys are written in the order of the table.
void SceneWriter::values(JsonNode& to, std::span<const Parameter> table, const void* base, const void* defaults,
                         const std::string& place, const Children& children, Following following) {
    const Parameter* leader = nullptr;  // set once it has been written
    for (const Parameter& p : table) {
        const std::string where = at(place, p.key);
        const bool follows = leader && p.key == following.follower;
        const bool as_expected = follows ? same_value_as(*leader, p, base) : same_value(p, base, defaults);
        if (p.kind == ParameterKind::object || p.kind == ParameterKind::list) {
            if (auto child = children ? children(p.key, where) : Child()) to.add(p.key, std::move(*child));
        } else if (p.required || !as_expected) {
            to.add(p.key, value(p, base, where));
            if (p.key == following.leader) leader = &p;
        }
    }
}

template <class Desc>
JsonNode SceneWriter::object(std::span<const Parameter> table, const Desc& desc, const Desc& defaults,
                             const std::string& place, const Children& children) {
    JsonNode node = JsonNode::object();
    values(node, table, &desc, &defaults, place, children);
    return node;
}

template <class Item, class Write>
JsonNode SceneWriter::list(const std::vector<Item>& items, const std::string& place, Write&& write) {
    JsonNode node = JsonNode::list();
    for (std::size_t i = 0; i < items.size(); ++i) node.add(write(items[i], at(place, i)));
    return node;
}

JsonNode SceneWriter::wind(const WindDesc& desc, const std::string& place) {
    const WindDesc defaults;
    const WindHead head{static_cast<int>(desc.kind.index())};
    JsonNode node = object(wind_head_keys, head, WindHead(), place);
#define WEFT_WIND(name, Name)                                     \
    if (const auto* kind = std::get_if<Name##Desc>(&desc.kind)) { \
        const Name##Desc otherwise;                               \
        values(node, name##_parameters, kind, &otherwise, place); \
    }
#include "physics/air/winds.def"
#undef WEFT_WIND
    values(node, wind_keys, &desc, &defaults, place, [&](std::string_view key, const std::string& where) -> Child {
        if (key == "transform") return unless_empty(object(pose_keys, desc.transform, defaults.transform, where));
        if (key == "motion")
            return motion(
                desc.motion, wind_key_keys,
                WindKey{.position = desc.transform.position, .rotation_degrees = desc.transform.rotation_degrees},
                where);
        if (key == "box") return desc.box ? Child(object(wind_box_keys, *desc.box, WindBoxDesc(), where)) : Child();
        if (key == "gust") return unless_empty(object(gust_keys, desc.gust, defaults.gust, where));
        assert(key == "turbulence");
        return unless_empty(object(turbulence_keys, desc.turbulence, defaults.turbulence, where));
    });
    return node;
}

JsonNode SceneWriter::air(const AirDesc& desc, const std::string& place) {
    return object(air_keys, desc, AirDesc(), place, [&](std::string_view, const std::string& where) {
        return unless_empty(
            list(desc.wind, where, [&](const WindDesc& one, const std::string& below) { return wind(one, below); }));
    });
}

JsonNode SceneWriter::mesh(const MeshDesc& desc, const std::string& place) {
    if (const auto* file = std::get_if<MeshFileDesc>(&desc)) {
        return object(mesh_file_keys, *file, MeshFileDesc(), place);
    }
    JsonNode node = JsonNode::object();
    if (const auto* grid = std::get_if<GridDesc>(&desc)) {
        node.add("grid", object(grid_keys, *grid, GridDesc(), at(place, "grid")));
    } else if (const auto* sphere = std::get_if<SphereMeshDesc>(&desc)) {
        node.add("sphere", object(sphere_mesh_keys, *sphere, SphereMeshDesc(), at(place, "sphere")));
    } else if (const auto* box = std::get_if<BoxMeshDesc>(&desc)) {
        node.add("box", object(box_mesh_keys, *box, BoxMeshDesc(), at(place, "box")));
    } else {
        problems_.add(place, "is a mesh in memory, for which a scene file must name a file");
    }
    return node;
}

Child SceneWriter::fabric(const SceneCloth& cloth, const std::string& place) {
    const std::string standard = FabricHead().preset;
    const FabricPreset* known = find_fabric(cloth.fabric_name);
    const FabricHead head{known ? cloth.fabric_name : standard};
    const FabricPreset& preset = known ? *known : *find_fabric(standard);
    const auto in = [](const Fabric& fabric, const FabricTable& table) {
        return reinterpret_cast<const std::byte*>(&fabric) + table.offset;
    };
    JsonNode node = object(fabric_keys, head, FabricHead(), place);
    const bool named = !node.empty();
    for (const FabricTable& table : fabric_tables())
        values(node, table.parameters, in(cloth.fabric, table), in(preset.fabric, table), place, {},
               {.leader = "stretch", .follower = "compression"});  // see follow_stretch()
    if (named && cloth.fabric == preset.fabric) return text(head.preset, place);
    return unless_empty(std::move(node));
}

// `otherwise`: the material of an object without `material`.
Child SceneWriter::material(const std::optional<SceneMaterial>& desc, const MaterialPreset& otherwise,
                            const std::string& place) {
    if (!desc) return {};
    const MaterialPreset* preset = find_material(desc->preset);
    const Material defaults = preset ? preset->material : Material();
    JsonNode node = JsonNode::object();
    if (preset && preset != &otherwise) node.add("preset", text(desc->preset, at(place, "preset")));
    const bool named = !node.empty();
    values(node, material_parameters, &desc->values, &defaults, place, {},
           {.leader = "color", .follower = "weft_color"});  // see follow_color()
    const bool as_named = node.empty() || (named && desc->values == defaults);
    return preset && as_named ? text(desc->preset, place) : node;
}

// Vertices, a group, a box or a color.
template <class Select>
void SceneWriter::selection(JsonNode& node, const Select& select, const std::string& place) {
    if (const auto* vertices = std::get_if<VertexPins>(&select)) {
        // A program may name a group that the cloth has not.
        if (std::ranges::find(groups_, VertexGroup{vertices->group, vertices->vertices}) != groups_.end())
            node.add("group", text(vertices->group, at(place, "group")));
        else
            node.add("vertices", numbers_of(vertices->vertices));
    } else if (const auto* box = std::get_if<BoxPins>(&select)) {
        node.add("box", object(box_keys, box->box, Bounds(), at(place, "box")));
    } else if (const auto* color = std::get_if<ColorPins>(&select)) {
        // The color is written even if it is the default, because it marks the selection as one by color.
        node.add("color", value(color_pin_keys[0], color, at(place, "color")));
        const ColorPins none_said;
        values(node, std::span(color_pin_keys).subspan(1), color, &none_said, place);
    }
}

JsonNode SceneWriter::pin(const PinDesc& desc, const std::string& place) {
    JsonNode node = JsonNode::object();
    selection(node, desc.select, place);
    const PinDesc defaults;
    values(node, pin_motion_keys, &desc, &defaults, place, [&](std::string_view, const std::string& where) {
        return unless_empty(list(desc.motion, where, [&](const OffsetKey& key, const std::string& below) {
            return object(offset_key_keys, key, OffsetKey(), below);
        }));
    });
    return node;
}

// A cut or a seam.
template <class Desc>
JsonNode SceneWriter::path(std::span<const Parameter> keys, const Desc& desc, const std::string& place) {
    return object(keys, desc, Desc(), place, [&](std::string_view key, const std::string& where) -> Child {
        const auto* path = std::get_if<PathCut>(&desc.along);
        if (key == "points") return path ? Child(points(path->points, where)) : Child();
        assert(key == "plane");
        return path ? Child() : object(cut_plane_keys, std::get<PlaneCut>(desc.along), PlaneCut(), where);
    });
}

// `desc`: a ResistanceDesc or a WeightDesc. `keys`: that of its factor.
template <class Desc>
void SceneWriter::painted(JsonNode& node, std::span<const Parameter> keys, const Desc& desc, const std::string& place) {
    selection(node, desc.select, place);
    if (const auto* painted = std::get_if<PaintedChannel>(&desc.select))
        node.add("channel", value(painted_channel_keys[0], painted, at(place, "channel")));
    if (!desc.factors.empty()) node.add("factors", numbers_of(desc.factors));
    const Desc defaults;
    values(node, keys, &desc, &defaults, place);
}

JsonNode SceneWriter::cloth(const SceneCloth& desc, std::size_t index, const std::string& place) {
    SceneCloth defaults;
    defaults.name = "cloth " + std::to_string(index);
    groups_ = desc.groups;
    return object(cloth_keys, desc, defaults, place, [&](std::string_view key, const std::string& where) -> Child {
        if (key == "mesh") return desc.mesh == defaults.mesh ? Child() : mesh(desc.mesh, where);
        if (key == "render_mesh") return desc.render_mesh ? Child(mesh(*desc.render_mesh, where)) : Child();
        if (key == "transform") return unless_empty(object(transform_keys, desc.transform, defaults.transform, where));
        if (key == "fabric") return fabric(desc, where);
        if (key == "material") return material(desc.material, default_material(desc), where);
        if (key == "groups")
            return unless_empty(list(desc.groups, where, [&](const VertexGroup& one, const std::string& below) {
                return object(group_keys, one, VertexGroup(), below,
                              [&](std::string_view, const std::string&) { return Child(numbers_of(one.vertices)); });
            }));
        if (key == "cuts")
            return unless_empty(list(desc.cuts, where, [&](const CutDesc& one, const std::string& below) {
                return path(cut_keys, one, below);
            }));
        if (key == "seams")
            return unless_empty(list(desc.seams, where, [&](const SeamDesc& one, const std::string& below) {
                return path(seam_keys, one, below);
            }));
        if (key == "resistance")
            return unless_empty(list(desc.resistance, where, [&](const ResistanceDesc& one, const std::string& below) {
                JsonNode node = JsonNode::object();
                painted(node, resistance_factor_keys, one, below);
                return node;
            }));
        if (key == "weights")
            return unless_empty(list(desc.weights, where, [&](const WeightDesc& one, const std::string& below) {
                JsonNode node = JsonNode::object();
                node.add("of", value(weight_keys[0], &one, at(below, "of")));
                painted(node, weight_factor_keys, one, below);
                return node;
            }));
        assert(key == "pins");
        return unless_empty(
            list(desc.pins, where, [&](const PinDesc& one, const std::string& below) { return pin(one, below); }));
    });
}

// `like`: values that a key does not give.
template <class Key>
Child SceneWriter::motion(const std::vector<Key>& keys, std::span<const Parameter> table, const Key& like,
                          const std::string& place) {
    if (keys.empty()) return {};
    JsonNode node = JsonNode::object();
    node.add("keys", list(keys, at(place, "keys"),
                          [&](const Key& key, const std::string& where) { return object(table, key, like, where); }));
    return node;
}

JsonNode SceneWriter::dynamic(const BodyDesc& body, const std::string& place) {
    JsonNode node = JsonNode::object();
    node.add("dynamic", object(rigid_body_parameters, body, BodyDesc(), at(place, "dynamic")));
    return node;
}

JsonNode SceneWriter::points(const std::vector<Vec3>& points, const std::string& place) {
    return list(points, place, [](Vec3 p, const std::string&) {
        JsonNode point = JsonNode::list();
        for (const float x : {p.x, p.y, p.z}) point.add(JsonNode::number(x));
        return point;
    });
}

// The points of a hull, if the shape is one without a file.
template <class Shape>
Child SceneWriter::points_of(const Shape& shape, const std::string& place) {
    if constexpr (std::is_same_v<Shape, ConvexDesc>) {
        if (shape.file.empty()) return unless_empty(points(shape.mesh.positions, place));
    }
    return {};
}

JsonNode SceneWriter::collider(const SceneCollider& desc, std::size_t index, const std::string& place) {
    with_mesh_shape(desc.shape, [&](const auto& shape) {
        // Points without triangles are written as they are.
        const bool points = std::holds_alternative<ConvexDesc>(desc.shape) && shape.mesh.triangles.empty();
        if (shape.file.empty() && !points)
            problems_.add(place, "has a mesh in memory, for which a scene file must name a file");
    });
    const auto lists_of = [&](const auto& shape) -> Children {
        return [&](std::string_view, const std::string& below) { return points_of(shape, below); };
    };
    ColliderDesc defaults;
    defaults.name = "collider " + std::to_string(index);
    return object(collider_keys, static_cast<const ColliderDesc&>(desc), defaults, place,
                  [&](std::string_view key, const std::string& where) -> Child {
                      if (key == "transform")
                          return unless_empty(object(pose_keys, desc.transform, defaults.transform, where));
                      if (key == "motion" && desc.body) return dynamic(*desc.body, where);
                      if (key == "motion")
                          return motion(desc.motion, pose_key_keys,
                                        PoseKey{.position = desc.transform.position,
                                                .rotation_degrees = desc.transform.rotation_degrees},
                                        where);
                      if (key == "material") return material(desc.material, default_material(desc), where);
#define WEFT_SHAPE(name, Name)                                                  \
    if (const auto* shape = std::get_if<Name##Desc>(&desc.shape); key == #name) \
        return shape ? Child(object(name##_parameters, *shape, Name##Desc(), where, lists_of(*shape))) : Child();
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
                      assert(false);
                      return {};
                  });
}

JsonNode SceneWriter::stitches(const StitchDesc& desc, std::size_t index, const std::string& place) {
    const auto end = [&](const StitchEnd& one, const std::string& where) {
        return object(stitch_end_keys, one, StitchEnd(), where, [&](std::string_view key, const std::string& below) {
            if (key == "vertices")
                return unless_empty(list(one.vertices, below, [](std::uint32_t vertex, const std::string&) {
                    return JsonNode::number(vertex);
                }));
            return unless_empty(list(one.points, below, [&](const MeshPoint& point, const std::string& at_point) {
                return object(surface_point_keys, point, MeshPoint(), at_point);
            }));
        });
    };
    StitchDesc defaults;
    defaults.name = "stitches " + std::to_string(index);
    return object(stitch_keys, desc, defaults, place, [&](std::string_view key, const std::string& where) {
        return Child(end(key == "a" ? desc.a : desc.b, where));
    });
}

JsonNode SceneWriter::light(const Lighting& desc, const std::string& place) {
    const Lighting defaults;
    return object(
        lighting_parameters, desc, defaults, place, [&](std::string_view key, const std::string& where) -> Child {
            if (key == "sun") return unless_empty(object(sun_parameters, desc.sun, defaults.sun, where));
            if (key == "sky") return unless_empty(object(sky_parameters, desc.sky, defaults.sky, where));
            assert(key == "environment");
            return unless_empty(object(environment_parameters, desc.environment, defaults.environment, where));
        });
}

JsonNode SceneWriter::scene(const SceneDesc& desc) {
    const SceneHead head;
    const SceneDesc defaults;
    JsonNode node = JsonNode::object();
    values(node, head_keys, &head, &head, "");
    values(node, scene_keys, &desc, &defaults, "", [&](std::string_view key, const std::string& where) -> Child {
        std::size_t index = 0;
        if (key == "solver") return unless_empty(object(solver_keys, desc.solver, defaults.solver, where));
        if (key == "air") return desc.air ? Child(air(*desc.air, where)) : Child();
        if (key == "cloths")
            return list(desc.cloths, where,
                        [&](const SceneCloth& one, const std::string& below) { return cloth(one, index++, below); });
        if (key == "colliders")
            return unless_empty(list(desc.colliders, where, [&](const SceneCollider& one, const std::string& below) {
                return collider(one, index++, below);
            }));
        if (key == "stitches")
            return unless_empty(list(desc.stitches, where, [&](const StitchDesc& one, const std::string& below) {
                return stitches(one, index++, below);
            }));
        if (key == "camera")
            return desc.camera ? Child(object(camera_parameters, *desc.camera, Camera(), where)) : Child();
        assert(key == "light");
        return unless_empty(light(desc.light, where));
    });
    return node;
}

}  // namespace

Result<std::string> write_scene(const SceneDesc& scene) {
    if (scene.cloths.empty()) return Error{"/cloths", "must hold at least one cloth to be written to a file"};
    SceneWriter writer;
    const JsonNode node = writer.scene(scene);
    if (!writer.problems().none()) return std::move(writer.problems()).take();
    std::string text = node.pretty();
    if (text.size() > max_json_bytes)
        return Error{"", "would be longer than the " + std::to_string(max_json_bytes >> 20) + " MiB of a scene file"};
    return text;
}

}  // namespace weft
