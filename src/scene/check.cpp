#include "scene/check.h"

#include "scene/nearest_name.h"
#include "scene/scene_keys.h"
#include "scene/values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>

namespace weft {
namespace {

template <class T>
void check_numbers(const Parameter& p, const void* base, const std::string& pointer, Problems& problems) {
    const T first = element<T>(p, base, 0);
    bool alike = true;
    for (std::size_t i = 1; i < p.count; ++i) alike = alike && element<T>(p, base, i) == first;
    const bool one_for_all = p.count == 1 || (alike && p.kind == ParameterKind::number);
    for (std::size_t i = 0; i < (one_for_all ? 1 : p.count); ++i) {
        const T value = element<T>(p, base, i);
        if (std::string what = range_problem(p, value, number_text(value)); !what.empty())
            problems.add(one_for_all ? pointer : at(pointer, i), std::move(what));
    }
}

void check_text(std::string_view text, const std::string& pointer, Problems& problems) {
    if (std::ranges::any_of(text, is_control))
        problems.add(pointer, "must not hold control characters, got " + in_quotes(text));
}

std::uint64_t vertex_count(const GridDesc& grid) {
    const std::uint64_t nx = grid.resolution[0], nz = grid.resolution[1];
    const bool centers = grid.diagonal == GridDiagonal::cross && nx > 0 && nz > 0;
    return nx * nz + (centers ? (nx - 1) * (nz - 1) : 0);
}

std::uint64_t vertex_count(const SphereMeshDesc& sphere) {
    // A bound above the limit of the key that still does not overflow.
    return (std::uint64_t{10} << 2 * std::min(sphere.subdivisions, 20u)) + 2;
}

std::uint64_t vertex_count(const BoxMeshDesc& box) {
    std::uint64_t cells[3];
    for (std::size_t i = 0; i < 3; ++i) cells[i] = std::max(box.resolution[i], 1u) - 1;
    return 2 * (cells[0] * cells[1] + cells[1] * cells[2] + cells[2] * cells[0]) + 2;
}

// A mesh that the scene describes by parameters. Its size is known before the mesh is built.
struct MadeMesh {
    std::string_view key;
    std::uint64_t vertices = 0;
};

std::optional<MadeMesh> made_mesh(const MeshDesc& mesh) {
    if (const auto* grid = std::get_if<GridDesc>(&mesh)) return MadeMesh{"grid", vertex_count(*grid)};
    if (const auto* sphere = std::get_if<SphereMeshDesc>(&mesh)) return MadeMesh{"sphere", vertex_count(*sphere)};
    if (const auto* box = std::get_if<BoxMeshDesc>(&mesh)) return MadeMesh{"box", vertex_count(*box)};
    return {};
}

// Checks the size of a grid or a box, which follows from its `resolution`.
void check_resolution(std::uint64_t vertices, const std::string& pointer, Problems& problems) {
    const std::string place = at(pointer, "resolution");
    if (vertices > max_made_vertices && !problems.concern(place))
        problems.add(place, "must give at most " + std::to_string(max_made_vertices) + " particles, got " +
                                std::to_string(vertices));
}

void check_mesh_file(const MeshFileDesc& mesh, const std::string& pointer, Problems& problems) {
    check_values(mesh_file_keys, &mesh, pointer, problems);
    if (mesh.file.empty()) problems.add(at(pointer, "file"), "must name a file");
}

// Checks array sizes only; building the topology checks the rest.
void check_given_mesh(const TriangleMesh& mesh, const std::string& pointer, Problems& problems) {
    const auto check_size = [&](std::size_t size, std::string_view what) {
        if (size != 0 && size != mesh.positions.size())
            problems.add(pointer, "must have as many " + std::string(what) + " as positions, or none, got " +
                                      std::to_string(size) + " and " + std::to_string(mesh.positions.size()));
    };
    check_size(mesh.uvs.size(), "uvs");
    check_size(mesh.normals.size(), "normals");
    check_size(mesh.colors.size(), "colors");
}

void check_mesh(const MeshDesc& mesh, const std::string& pointer, Problems& problems) {
    if (const auto* grid = std::get_if<GridDesc>(&mesh)) {
        check_values(grid_keys, grid, at(pointer, "grid"), problems);
        check_resolution(vertex_count(*grid), at(pointer, "grid"), problems);
    } else if (const auto* sphere = std::get_if<SphereMeshDesc>(&mesh)) {
        check_values(sphere_mesh_keys, sphere, at(pointer, "sphere"), problems);
    } else if (const auto* box = std::get_if<BoxMeshDesc>(&mesh)) {
        check_values(box_mesh_keys, box, at(pointer, "box"), problems);
        check_resolution(vertex_count(*box), at(pointer, "box"), problems);
    } else if (const auto* file = std::get_if<MeshFileDesc>(&mesh)) {
        check_mesh_file(*file, pointer, problems);
    } else if (const auto* given = std::get_if<TriangleMesh>(&mesh)) {
        check_given_mesh(*given, pointer, problems);
    }
}

void check_vertex_pins(const VertexPins& pins, std::uint64_t count, const std::string& pointer, Problems& problems) {
    for (std::size_t i = 0; i < pins.vertices.size(); ++i)
        if (pins.vertices[i] >= count)
            problems.add(at(pointer, i), "must be less than " + std::to_string(count) +
                                             ", the number of particles, got " + std::to_string(pins.vertices[i]));
}

void check_box(const Bounds& box, const std::string& pointer, Problems& problems) {
    check_values(box_keys, &box, pointer, problems);
    const float low[] = {box.min.x, box.min.y, box.min.z}, high[] = {box.max.x, box.max.y, box.max.z};
    for (std::size_t i = 0; i < 3; ++i)
        if (std::isfinite(low[i]) && std::isfinite(high[i]) && low[i] > high[i])
            problems.add(at(at(pointer, "min"), i), "must not be greater than the same element of \"max\", " +
                                                        number_text(high[i]) + ", got " + number_text(low[i]));
}

template <class Key>
void check_keys(const std::vector<Key>& keys, std::span<const Parameter> table, const std::string& pointer,
                Problems& problems) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        check_values(table, &keys[i], at(pointer, i), problems);
        if (i > 0 && keys[i].time <= keys[i - 1].time)
            problems.add(at(at(pointer, i), "time"), "must be later than that of the key before, " +
                                                         number_text(keys[i - 1].time) + ", got " +
                                                         number_text(keys[i].time));
    }
}

// `made` is empty for meshes from files or from the program: their particles are not known here.
void check_selection(const VertexPins& vertices, const std::optional<MadeMesh>& made, const std::string& pointer,
                     Problems& problems) {
    if (!vertices.group.empty()) return;  // check_group
    if (vertices.vertices.empty()) problems.add(at(pointer, "vertices"), "must name at least one vertex");
    if (made) check_vertex_pins(vertices, made->vertices, at(pointer, "vertices"), problems);
}

void check_selection(const BoxPins& box, const std::optional<MadeMesh>&, const std::string& pointer,
                     Problems& problems) {
    check_box(box.box, at(pointer, "box"), problems);
}

std::string needs_colors(const MadeMesh& made) {
    return "needs a mesh with vertex colors, which a " + std::string(made.key) + " has not";
}

void check_selection(const ColorPins& color, const std::optional<MadeMesh>& made, const std::string& pointer,
                     Problems& problems) {
    check_values(color_pin_keys, &color, pointer, problems);
    if (made) problems.add(at(pointer, "color"), needs_colors(*made));
}

void check_pin(const PinDesc& pin, const std::optional<MadeMesh>& made, const std::string& pointer,
               Problems& problems) {
    std::visit([&](const auto& select) { check_selection(select, made, pointer, problems); }, pin.select);
    check_values(pin_motion_keys, &pin, pointer, problems);
    check_keys(pin.motion, offset_key_keys, at(pointer, "motion"), problems);
    if (!pin.attach.empty() && !pin.motion.empty())
        problems.add(at(pointer, "motion"), "must not stand beside \"attach\": the collider moves the pin");
}

template <class Shape>
void check_shape(const Shape& shape, std::span<const Parameter> keys, const std::string& pointer, Problems& problems) {
    check_values(keys, &shape, pointer, problems);
    if (const ShapeProblem problem = shape_problem(shape); !problem.what.empty())
        problems.add(at(pointer, problem.key), std::string(problem.what));
}

template <class Named>
void check_names(const std::vector<Named>& all, const std::string& pointer, Problems& problems) {
    std::set<std::string_view> taken;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!all[i].name.empty() && !taken.insert(all[i].name).second)
            problems.add(at(at(pointer, i), "name"), "is taken: another before it is called " + in_quotes(all[i].name));
}

// Checks the sum over all cloths; each mesh alone may be within its limit.
void check_total(const SceneDesc& scene, Problems& problems) {
    std::uint64_t total = 0;
    bool drawn = false;
    for (const SceneCloth& cloth : scene.cloths) {
        if (const auto made = made_mesh(cloth.mesh)) total += made->vertices;
        if (const auto made = cloth.render_mesh ? made_mesh(*cloth.render_mesh) : std::nullopt)
            total += made->vertices, drawn = true;
    }
    if (total > max_made_vertices && !problems.concern("/cloths"))
        problems.add("/cloths", "must have at most " + std::to_string(max_made_vertices) +
                                    (drawn ? " particles and drawn vertices" : " particles") + " together, got " +
                                    std::to_string(total));
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all, const std::string& kind) {
    std::set<std::string> taken;
    std::vector<std::string> names;
    for (const Named& one : all) names.push_back(one.name), taken.insert(one.name);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t number = i; names[i].empty(); ++number)
            if (const std::string name = kind + ' ' + std::to_string(number); taken.insert(name).second)
                names[i] = name;
    return names;
}

/// The parts between '|'.
std::vector<std::string_view> split(std::string_view text) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('|'), text.size());
        parts.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

}  // namespace

std::string range_problem(const Parameter& parameter, double value, std::string_view got) {
    const bool integer = parameter.kind == ParameterKind::integer;
    const std::string text = got.empty() ? number_text(value) : std::string(got);
    // The limits are rounded to float, so that a limit written in a file is within the range.
    const double min = integer ? parameter.min : static_cast<float>(parameter.min);
    const double max = integer ? parameter.max : static_cast<float>(parameter.max);
    const bool below = parameter.min_excluded ? value <= min : value < min;
    if (parameter.zero_too && value == 0) return {};
    // A side without a limit still has the range of float.
    if (!std::isfinite(value) || (below ? min == -any_float : value > max && max == any_float))
        return "must be a finite number, got " + text;
    if (!below && value <= max) return {};
    std::string bound = below ? (parameter.zero_too ? "0 or " : "") +
                                    std::string(parameter.min_excluded ? "> " : "≥ ") + number_text(parameter.min)
                              : "≤ " + number_text(parameter.max);
    if (!parameter.unit.empty()) (bound += ' ') += parameter.unit;
    return "must be " + bound + ", got " + text + std::string(below ? "" : parameter.above_hint);
}

std::vector<std::string_view> choice_names(const Parameter& parameter) {
    return split(parameter.choices);
}

std::vector<std::string_view> choice_words(const Parameter& parameter) {
    return split(parameter.choice_words);
}

void check_values(std::span<const Parameter> table, const void* base, const std::string& pointer, Problems& problems) {
    for (const Parameter& p : table) {
        const std::string place = at(pointer, p.key);
        switch (p.kind) {
            case ParameterKind::number:
            case ParameterKind::vector:
                check_numbers<float>(p, base, place, problems);
                break;
            case ParameterKind::angle_or_mesh:
                if (!std::isnan(element<float>(p, base, 0))) check_numbers<float>(p, base, place, problems);
                break;
            case ParameterKind::integer:
                check_numbers<std::uint32_t>(p, base, place, problems);
                break;
            case ParameterKind::choice:
                // Only a program can pass such a value; the reader rejects it in files.
                if (element<unsigned>(p, base, 0) >= choice_names(p).size())
                    problems.add(place, "is not one of its enumerators");
                break;
            case ParameterKind::text:
                check_text(text_of(p, base), place, problems);
                break;
            case ParameterKind::flag:
            case ParameterKind::object:
            case ParameterKind::list:
                break;
        }
    }
}

void check_solver(const SolverDesc& solver, const std::string& pointer, Problems& problems) {
    check_values(solver_keys, &solver, pointer, problems);
    if (solver.method == Method::pbd && solver.projection == Projection::lines)
        problems.add(at(pointer, "projection"), "must not be \"lines\" with method \"pbd\", which has no such form");
    if (solver.method == Method::pbd && solver.compensation == Compensation::on)
        problems.add(at(pointer, "compensation"), "must not be \"on\" with method \"pbd\", which has none");
}

void check_air(const AirDesc& air, const std::string& pointer, Problems& problems) {
    check_values(air_keys, &air, pointer, problems);
    for (std::size_t i = 0; i < air.wind.size(); ++i) {
        const std::string place = at(at(pointer, "wind"), i);
        const WindDesc& wind = air.wind[i];
        check_values(wind_keys, &wind, place, problems);
#define WEFT_WIND(name, Name) \
    if (const auto* kind = std::get_if<Name##Desc>(&wind.kind)) check_values(name##_parameters, kind, place, problems);
#include "physics/air/winds.def"
#undef WEFT_WIND
        check_values(pose_keys, &wind.transform, at(place, "transform"), problems);
        check_keys(wind.motion, wind_key_keys, at(at(place, "motion"), "keys"), problems);
        if (wind.box) check_values(wind_box_keys, &*wind.box, at(place, "box"), problems);
        check_values(gust_keys, &wind.gust, at(place, "gust"), problems);
        check_values(turbulence_keys, &wind.turbulence, at(place, "turbulence"), problems);
    }
}

void check_pins(const std::vector<PinDesc>& pins, const MeshDesc& mesh, const std::string& pointer,
                Problems& problems) {
    const auto made = made_mesh(mesh);
    for (std::size_t i = 0; i < pins.size(); ++i) check_pin(pins[i], made, at(pointer, i), problems);
}

namespace {

void check_path(const std::variant<PathCut, PlaneCut>& along, const std::string& pointer, Problems& problems) {
    if (const auto* plane = std::get_if<PlaneCut>(&along)) {
        const std::string place = at(pointer, "plane");
        check_values(cut_plane_keys, plane, place, problems);
        const PlaneDesc same{plane->normal, plane->offset};
        if (const ShapeProblem problem = shape_problem(same); !problem.what.empty())
            problems.add(at(place, problem.key), std::string(problem.what));
        return;
    }
    const std::string place = at(pointer, "points");
    const auto& points = std::get<PathCut>(along).points;
    if (points.size() < 2 && !problems.concern(place))
        problems.add(place, "must hold at least two points, got " + std::to_string(points.size()));
    constexpr Parameter coordinate = {.min = -far_away, .max = far_away, .unit = "m"};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float numbers[] = {points[i].x, points[i].y, points[i].z};
        for (std::size_t k = 0; k < 3; ++k)
            if (const std::string problem = range_problem(coordinate, double{numbers[k]}); !problem.empty())
                problems.add(at(at(place, i), k), problem);
    }
}

// `desc`: a ResistanceDesc or a WeightDesc.
template <class Desc>
void check_factors(const Desc& desc, const std::string& pointer, Problems& problems) {
    const auto& factors = desc.factors;
    if (factors.empty() || problems.concern(pointer)) return;
    const auto* vertices = std::get_if<VertexPins>(&desc.select);
    if (!vertices || !vertices->group.empty()) return problems.add(pointer, "needs \"vertices\"");
    if (factors.size() != vertices->vertices.size())
        problems.add(pointer, "must hold a number per vertex, " + std::to_string(vertices->vertices.size()) + ", got " +
                                  std::to_string(factors.size()));
    for (std::size_t i = 0; i < factors.size(); ++i)
        if (const std::string problem = range_problem(one_factor, double{factors[i]}, number_text(factors[i]));
            !problem.empty())
            problems.add(at(pointer, i), problem);
}

// The same. `keys`: that of its factor.
template <class Desc>
void check_painted(const Desc& desc, std::span<const Parameter> keys, const std::optional<MadeMesh>& made,
                   const std::string& pointer, Problems& problems) {
    check_values(keys, &desc, pointer, problems);
    check_factors(desc, at(pointer, "factors"), problems);
    if (const auto* channel = std::get_if<PaintedChannel>(&desc.select)) {
        check_values(painted_channel_keys, channel, pointer, problems);
        if (made) problems.add(at(pointer, "channel"), needs_colors(*made));
    } else if (const auto* vertices = std::get_if<VertexPins>(&desc.select)) {
        check_selection(*vertices, made, pointer, problems);
    } else if (const auto* box = std::get_if<BoxPins>(&desc.select)) {
        check_selection(*box, made, pointer, problems);
    } else {
        check_selection(std::get<ColorPins>(desc.select), made, pointer, problems);
    }
}

}  // namespace

void check_weights(const std::vector<WeightDesc>& weights, const MeshDesc& mesh, const std::string& pointer,
                   Problems& problems) {
    const auto made = made_mesh(mesh);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        check_values(weight_keys, &weights[i], at(pointer, i), problems);
        check_painted(weights[i], weight_factor_keys, made, at(pointer, i), problems);
    }
}

void check_resistance(const std::vector<ResistanceDesc>& resistance, const MeshDesc& mesh, const std::string& pointer,
                      Problems& problems) {
    const auto made = made_mesh(mesh);
    for (std::size_t i = 0; i < resistance.size(); ++i)
        check_painted(resistance[i], resistance_factor_keys, made, at(pointer, i), problems);
}

namespace {

void check_groups(const std::vector<VertexGroup>& groups, const std::optional<MadeMesh>& made,
                  const std::string& pointer, Problems& problems) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const std::string place = at(pointer, i);
        check_values(group_keys, &groups[i], place, problems);
        if (groups[i].name.empty() && !problems.concern(at(place, "name")))
            problems.add(at(place, "name"), "must not be empty");
        if (!problems.concern(at(place, "vertices")))
            check_selection(VertexPins{groups[i].vertices}, made, place, problems);
    }
    check_names(groups, pointer, problems);
}

void check_tearing(const SceneCloth& cloth, const MeshDesc& mesh, const std::string& pointer, Problems& problems) {
    const auto needs = [&](bool has, std::string_view key, bool able, const char* what) {
        if (has && !able) problems.add(at(pointer, key), "needs \"tearing\": " + std::string(what) + " in this cloth");
    };
    const bool split = cloth.tearing == Tearing::split, erode = cloth.tearing == Tearing::erode;
    for (std::size_t i = 0; i < cloth.cuts.size(); ++i) check_cut(cloth.cuts[i], at(at(pointer, "cuts"), i), problems);
    needs(!cloth.cuts.empty(), "cuts", cloth.tearing != Tearing::off, "\"cuts\", \"split\" or \"erode\"");
    for (std::size_t i = 0; i < cloth.seams.size(); ++i) {
        const std::string place = at(at(pointer, "seams"), i);
        check_values(seam_keys, &cloth.seams[i], place, problems);
        check_path(cloth.seams[i].along, place, problems);
    }
    needs(!cloth.seams.empty(), "seams", split, "\"split\"");
    check_resistance(cloth.resistance, mesh, at(pointer, "resistance"), problems);
    needs(!cloth.resistance.empty(), "resistance", split || erode, "\"split\" or \"erode\"");
}

}  // namespace

void check_cut(const CutDesc& cut, const std::string& pointer, Problems& problems) {
    check_values(cut_keys, &cut, pointer, problems);
    check_path(cut.along, pointer, problems);
}

void check_attachments(const std::vector<PinDesc>& pins, std::span<const std::string_view> names,
                       const std::string& pointer, Problems& problems) {
    for (std::size_t i = 0; i < pins.size(); ++i) {
        const std::string& to = pins[i].attach;
        if (to.empty()) continue;
        const std::string place = at(at(pointer, i), "attach");
        if (std::ranges::find(names, to) == names.end())
            problems.add(place, "unknown collider " + in_quotes(to) + suggestion(to, {names.begin(), names.end()}));
    }
}

void check_cloth(const SceneCloth& cloth, const std::string& pointer, Problems& problems) {
    check_values(cloth_keys, &cloth, pointer, problems);
    check_mesh(cloth.mesh, at(pointer, "mesh"), problems);
    if (cloth.render_mesh) check_mesh(*cloth.render_mesh, at(pointer, "render_mesh"), problems);
    check_values(transform_keys, &cloth.transform, at(pointer, "transform"), problems);
    for (const FabricTable& table : fabric_tables())
        check_values(table.parameters, reinterpret_cast<const std::byte*>(&cloth.fabric) + table.offset,
                     at(pointer, "fabric"), problems);
    const BendMaterial& bend = cloth.fabric.bend;
    if (bend.edges == BendEdges::no_diagonals && bend.model != BendModel::dihedral && bend.model != BendModel::distance)
        problems.add(at(at(pointer, "fabric"), "bend_edges"),
                     "needs \"bend_model\": \"dihedral\" or \"distance\" for \"no-diagonals\"");
    // If a mesh has errors, its number of particles is unknown.
    const bool sound = !problems.concern(at(pointer, "mesh"));
    const MeshDesc unknown = MeshFileDesc(), &mesh = sound ? cloth.mesh : unknown;
    check_groups(cloth.groups, made_mesh(mesh), at(pointer, "groups"), problems);
    check_pins(cloth.pins, mesh, at(pointer, "pins"), problems);
    check_weights(cloth.weights, mesh, at(pointer, "weights"), problems);
    check_tearing(cloth, mesh, pointer, problems);
    check_material(cloth.material, at(pointer, "material"), problems);
}

namespace {

void check_body(const ColliderDesc& collider, const std::string& pointer, Problems& problems) {
    const BodyDesc& body = *collider.body;
    const std::string place = at(at(pointer, "motion"), "dynamic");
    check_values(rigid_body_parameters, &body, place, problems);
    if (!collider.motion.empty())
        problems.add(place, "must not stand beside \"keys\": a body moves by forces, not by keys");
    if (std::holds_alternative<PlaneDesc>(collider.shape))
        problems.add(place, "must not stand beside \"plane\": a plane has no volume, so it cannot be a body");
    const auto* mesh = std::get_if<SolidMeshDesc>(&collider.shape);
    if (mesh && mesh->contact == MeshContact::surface)
        problems.add(at(at(pointer, "mesh"), "contact"),
                     "must not be \"surface\" with a \"dynamic\" motion: bodies are solids");
    const std::string moments = at(place, "inertia");
    if (const auto what = inertia_problem(body.inertia); !what.empty() && !problems.concern(moments))
        problems.add(moments, std::string(what) + ", got [" + number_text(body.inertia.x) + ", " +
                                  number_text(body.inertia.y) + ", " + number_text(body.inertia.z) + "]");
}

}  // namespace

void check_collider(const ColliderDesc& collider, const std::string& pointer, Problems& problems) {
    check_values(collider_keys, &collider, pointer, problems);
#define WEFT_SHAPE(name, Name)                                        \
    if (const auto* shape = std::get_if<Name##Desc>(&collider.shape)) \
        check_shape(*shape, name##_parameters, at(pointer, #name), problems);
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
    check_values(pose_keys, &collider.transform, at(pointer, "transform"), problems);
    check_keys(collider.motion, pose_key_keys, at(at(pointer, "motion"), "keys"), problems);
    if (collider.body) check_body(collider, pointer, problems);
}

void check_mesh_point(const MeshPoint& point, const std::string& pointer, Problems& problems) {
    check_values(surface_point_keys, &point, pointer, problems);
    const Vec3 w = point.weights;
    if (std::abs(w.x + w.y + w.z - 1) > 1e-3f && !problems.concern(at(pointer, "weights")))
        problems.add(at(pointer, "weights"), "must have the sum 1, got " + number_text(w.x + w.y + w.z));
}

namespace {

void check_stitch_end(const StitchEnd& end, std::span<const std::string_view> names, const std::string& pointer,
                      Problems& problems) {
    check_values(stitch_end_keys, &end, pointer, problems);
    if (std::ranges::find(names, end.cloth) == names.end() && !problems.concern(at(pointer, "cloth")))
        problems.add(at(pointer, "cloth"),
                     "unknown cloth " + in_quotes(end.cloth) + suggestion(end.cloth, {names.begin(), names.end()}));
    for (std::size_t i = 0; i < end.points.size(); ++i)
        check_mesh_point(end.points[i], at(at(pointer, "points"), i), problems);
    if (end.vertices.empty() == end.points.empty())
        problems.add(pointer, "must hold either \"vertices\" or \"points\", at least one");
}

}  // namespace

void check_stitches(const StitchDesc& stitches, std::span<const std::string_view> names, const std::string& pointer,
                    Problems& problems) {
    check_values(stitch_keys, &stitches, pointer, problems);
    check_stitch_end(stitches.a, names, at(pointer, "a"), problems);
    check_stitch_end(stitches.b, names, at(pointer, "b"), problems);
    const auto count = [](const StitchEnd& end) { return end.vertices.size() + end.points.size(); };
    if (count(stitches.a) != count(stitches.b) && !problems.concern(pointer))
        problems.add(at(pointer, "b"), "must have as many points as the other side, " +
                                           std::to_string(count(stitches.a)) + ", got " +
                                           std::to_string(count(stitches.b)));
}

void check_scene(const SceneDesc& scene, Problems& problems) {
    if (scene.cloths.empty()) problems.add("/cloths", "must hold at least one cloth");
    check_parts(scene, problems);
}

void check_parts(const SceneDesc& scene, Problems& problems) {
    check_values(scene_keys, &scene, "", problems);
    check_solver(scene.solver, "/solver", problems);
    if (scene.air) check_air(*scene.air, "/air", problems);
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
        check_cloth(scene.cloths[i], at("/cloths", i), problems);
        // Jacobi sums corrections by lists of constraints per particle, which openings do not change.
        const Tearing tearing = scene.cloths[i].tearing;
        if ((tearing == Tearing::split || tearing == Tearing::erode) && scene.solver.projection == Projection::jacobi)
            problems.add(at(at("/cloths", i), "tearing"),
                         "\"split\" and \"erode\" cannot be used with the projection \"jacobi\"");
    }
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
        check_collider(scene.colliders[i], at("/colliders", i), problems);
        check_material(scene.colliders[i].material, at(at("/colliders", i), "material"), problems);
    }
    check_names(scene.cloths, "/cloths", problems);
    check_names(scene.colliders, "/colliders", problems);
    const std::vector<std::string> called = collider_names(scene);
    const std::vector<std::string_view> names(called.begin(), called.end());
    for (std::size_t i = 0; i < scene.cloths.size(); ++i)
        check_attachments(scene.cloths[i].pins, names, at(at("/cloths", i), "pins"), problems);
    check_names(scene.stitches, "/stitches", problems);
    const std::vector<std::string> sheets = cloth_names(scene);
    const std::vector<std::string_view> sheet_names(sheets.begin(), sheets.end());
    for (std::size_t i = 0; i < scene.stitches.size(); ++i)
        check_stitches(scene.stitches[i], sheet_names, at("/stitches", i), problems);
    check_total(scene, problems);
    if (scene.camera) check_camera(*scene.camera, "/camera", problems);
    check_light(scene.light, "/light", problems);
}

Errors check_scene(const SceneDesc& scene) {
    Problems problems;
    check_scene(scene, problems);
    return std::move(problems).take();
}

std::vector<std::string> cloth_names(const SceneDesc& scene) {
    return names_of(scene.cloths, "cloth");
}

std::vector<std::string> collider_names(const SceneDesc& scene) {
    return names_of(scene.colliders, "collider");
}

void name_unnamed(SceneDesc& scene) {
    const std::vector<std::string> cloths = cloth_names(scene), colliders = collider_names(scene);
    for (std::size_t i = 0; i < cloths.size(); ++i) scene.cloths[i].name = cloths[i];
    for (std::size_t i = 0; i < colliders.size(); ++i) scene.colliders[i].name = colliders[i];
    const std::vector<std::string> stitches = names_of(scene.stitches, "stitches");
    for (std::size_t i = 0; i < stitches.size(); ++i) scene.stitches[i].name = stitches[i];
}

}  // namespace weft
