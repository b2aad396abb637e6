#include "scene/check.h"

#include "scene/scene_keys.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>

namespace weft {
namespace {

// Shorter than this, a direction is an accident.
constexpr double min_normal_length = 1e-9;

// Element `index` of a value; memcpy because the struct behind `base` is known by its offsets alone.
template <class T>
T element(const Parameter& parameter, const void* base, std::size_t index) {
    T value;
    std::memcpy(&value, static_cast<const std::byte*>(base) + parameter.offset + index * sizeof(T), sizeof(T));
    return value;
}

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

void check_grid(const GridDesc& grid, const std::string& pointer, Problems& problems) {
    check_values(grid_keys, &grid, pointer, problems);
    if (problems.concern(at(pointer, "resolution"))) return;
    if (const std::uint64_t count = vertex_count(grid); count > max_grid_vertices)
        problems.add(at(pointer, "resolution"), "must give at most " + std::to_string(max_grid_vertices) +
                                                    " particles, got " + std::to_string(count));
}

void check_mesh_file(const MeshFileDesc& mesh, const std::string& pointer, Problems& problems) {
    check_values(mesh_file_keys, &mesh, pointer, problems);
    if (mesh.file.empty()) problems.add(at(pointer, "file"), "must name a file");
}

void check_vertex_pins(const VertexPins& pins, const GridDesc* grid, const std::string& pointer, Problems& problems) {
    if (!grid) return;
    const std::uint64_t count = vertex_count(*grid);
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

// Without a grid nothing is known of the particles.
void check_pin(const PinDesc& pin, const GridDesc* grid, const std::string& pointer, Problems& problems) {
    if (const auto* vertices = std::get_if<VertexPins>(&pin.select)) {
        check_vertex_pins(*vertices, grid, at(pointer, "vertices"), problems);
    } else if (const auto* box = std::get_if<BoxPins>(&pin.select)) {
        check_box(box->box, at(pointer, "box"), problems);
    } else if (const auto* color = std::get_if<ColorPins>(&pin.select)) {
        check_values(color_pin_keys, color, pointer, problems);
        if (grid) problems.add(at(pointer, "color"), "needs a mesh with vertex colors, which a grid has not");
    }
}

void check_cloth(const ClothDesc& cloth, const std::string& pointer, Problems& problems) {
    check_values(cloth_keys, &cloth, pointer, problems);
    const auto* grid = std::get_if<GridDesc>(&cloth.mesh);
    if (grid)
        check_grid(*grid, at(at(pointer, "mesh"), "grid"), problems);
    else if (const auto* file = std::get_if<MeshFileDesc>(&cloth.mesh))
        check_mesh_file(*file, at(pointer, "mesh"), problems);
    check_values(transform_keys, &cloth.transform, at(pointer, "transform"), problems);
    for (const FabricTable& table : fabric_tables())
        check_values(table.parameters, reinterpret_cast<const std::byte*>(&cloth.fabric) + table.offset,
                     at(pointer, "fabric"), problems);
    const GridDesc* sound_grid = problems.concern(at(pointer, "mesh")) ? nullptr : grid;
    for (std::size_t i = 0; i < cloth.pins.size(); ++i)
        check_pin(cloth.pins[i], sound_grid, at(at(pointer, "pins"), i), problems);
}

void check_plane(const PlaneDesc& plane, const std::string& pointer, Problems& problems) {
    check_values(plane_keys, &plane, pointer, problems);
    const double x = plane.normal.x, y = plane.normal.y, z = plane.normal.z;
    if (std::sqrt(x * x + y * y + z * z) < min_normal_length) problems.add(at(pointer, "normal"), "must not be zero");
}

void check_collider(const ColliderDesc& collider, const std::string& pointer, Problems& problems) {
    check_values(collider_keys, &collider, pointer, problems);
    if (const auto* plane = std::get_if<PlaneDesc>(&collider.shape))
        check_plane(*plane, at(pointer, "plane"), problems);
    else if (const auto* sphere = std::get_if<SphereDesc>(&collider.shape))
        check_values(sphere_keys, sphere, at(pointer, "sphere"), problems);
    check_values(pose_keys, &collider.transform, at(pointer, "transform"), problems);
}

template <class Named>
void check_names(const std::vector<Named>& all, const std::string& pointer, Problems& problems) {
    std::set<std::string_view> taken;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!all[i].name.empty() && !taken.insert(all[i].name).second)
            problems.add(at(at(pointer, i), "name"), "is taken: another before it is called " + in_quotes(all[i].name));
}

// Each grid may be fine by itself.
void check_total(const SceneDesc& scene, Problems& problems) {
    std::uint64_t total = 0;
    for (const ClothDesc& cloth : scene.cloths)
        if (const auto* grid = std::get_if<GridDesc>(&cloth.mesh)) total += vertex_count(*grid);
    if (total > max_grid_vertices && !problems.concern("/cloths"))
        problems.add("/cloths", "must have at most " + std::to_string(max_grid_vertices) + " particles together, got " +
                                    std::to_string(total));
}

template <class Named>
void name_unnamed(std::vector<Named>& all, const std::string& kind) {
    std::set<std::string> taken;
    for (const Named& one : all) taken.insert(one.name);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t number = i; all[i].name.empty(); ++number)
            if (const std::string name = kind + ' ' + std::to_string(number); taken.insert(name).second)
                all[i].name = name;
}

}  // namespace

std::string range_problem(const Parameter& parameter, double value, std::string_view got) {
    const bool integer = parameter.kind == ParameterKind::integer;
    const std::string text = got.empty() ? number_text(value) : std::string(got);
    // Limits as floats, so that a limit written in a file lies within.
    const double min = integer ? parameter.min : static_cast<float>(parameter.min);
    const double max = integer ? parameter.max : static_cast<float>(parameter.max);
    const bool below = parameter.min_excluded ? value <= min : value < min;
    // A side without a limit still ends where floats do.
    if (!std::isfinite(value) || (below ? min == -any_float : value > max && max == any_float))
        return "must be a finite number, got " + text;
    if (!below && value <= max) return {};
    std::string bound =
        below ? (parameter.min_excluded ? "> " : "≥ ") + number_text(parameter.min) : "≤ " + number_text(parameter.max);
    if (!parameter.unit.empty()) (bound += ' ') += parameter.unit;
    return "must be " + bound + ", got " + text;
}

std::vector<std::string_view> choice_names(const Parameter& parameter) {
    std::vector<std::string_view> names;
    for (std::string_view rest = parameter.choices; !rest.empty();) {
        const std::size_t end = std::min(rest.find('|'), rest.size());
        names.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return names;
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
                // Only a program can get this wrong.
                if (element<unsigned>(p, base, 0) >= choice_names(p).size())
                    problems.add(place, "is not one of its enumerators");
                break;
            case ParameterKind::text:
                check_text(*reinterpret_cast<const std::string*>(static_cast<const std::byte*>(base) + p.offset), place,
                           problems);
                break;
            case ParameterKind::flag:
            case ParameterKind::object:
            case ParameterKind::list:
                break;
        }
    }
}

void check_scene(const SceneDesc& scene, Problems& problems) {
    check_values(scene_keys, &scene, "", problems);
    check_values(solver_keys, &scene.solver, "/solver", problems);
    if (scene.cloths.empty()) problems.add("/cloths", "must hold at least one cloth");
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) check_cloth(scene.cloths[i], at("/cloths", i), problems);
    for (std::size_t i = 0; i < scene.colliders.size(); ++i)
        check_collider(scene.colliders[i], at("/colliders", i), problems);
    check_names(scene.cloths, "/cloths", problems);
    check_names(scene.colliders, "/colliders", problems);
    check_total(scene, problems);
}

Errors check_scene(const SceneDesc& scene) {
    Problems problems;
    check_scene(scene, problems);
    return std::move(problems).take();
}

void name_unnamed(SceneDesc& scene) {
    name_unnamed(scene.cloths, "cloth");
    name_unnamed(scene.colliders, "collider");
}

}  // namespace weft
