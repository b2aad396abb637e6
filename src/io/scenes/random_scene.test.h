// Random scenes that use every key. They are small and valid.
#pragma once

#include "scene/check.h"
#include "scene/materials.h"
#include "scene/scene_keys.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

namespace weft {

class RandomScene {
  public:
    explicit RandomScene(std::uint64_t seed) : state_(seed) {}

    SceneDesc draw() {
        SceneDesc scene;
        fill(scene_keys, &scene);
        fill(solver_keys, &scene.solver);
        scene.solver.substeps = 1 + below(3);
        scene.solver.iterations = 1 + below(2);
        if (scene.solver.method == Method::pbd) {  // it has no lines, and nothing to keep
            scene.solver.projection = Projection::automatic;
            scene.solver.compensation = Compensation::automatic;
        }
        if (maybe()) draw(scene.air.emplace());
        for (std::uint32_t i = below(3); i > 0; --i) draw(static_cast<ColliderDesc&>(scene.colliders.emplace_back()));
        for (std::uint32_t i = 1 + below(3); i > 0; --i) draw(scene.cloths.emplace_back());
        if (scene.solver.projection == Projection::jacobi) {  // cloth cannot tear by itself with it
            for (SceneCloth& cloth : scene.cloths) {
                if (cloth.tearing != Tearing::off) cloth.tearing = Tearing::cuts;
                cloth.seams.clear(), cloth.resistance.clear();
            }
        }
        name(scene.cloths, "sheet"), name(scene.colliders, "body");
        name_unnamed(scene);
        for (SceneCloth& cloth : scene.cloths) {
            for (PinDesc& pin : cloth.pins) {
                if (pin.motion.empty() && !scene.colliders.empty() && !scene.colliders[0].body && maybe())
                    pin.attach = scene.colliders[0].name;
            }
        }
        for (std::uint32_t i = below(3); i > 0; --i) draw(scene.stitches.emplace_back(), scene);
        name_unnamed(scene);
        if (maybe()) {
            fill(camera_parameters, &scene.camera.emplace());
            scene.camera->target.x = scene.camera->position.x < 0 ? 1.0f : -1.0f;
        }
        fill(lighting_parameters, &scene.light);
        fill(sun_parameters, &scene.light.sun);
        fill(sky_parameters, &scene.light.sky);
        fill(environment_parameters, &scene.light.environment);
        for (SceneCloth& cloth : scene.cloths) draw(cloth.material, default_material(cloth));
        for (SceneCollider& collider : scene.colliders) draw(collider.material, default_material(collider));
        return scene;
    }

    // <random> is not used, because its distributions give different numbers with different libraries.
    std::uint32_t below(std::uint32_t limit) {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::uint32_t>(state_ >> 33) % limit;
    }

  private:
    bool maybe() { return below(2) == 0; }

    float number(const Parameter& p) {
        const double min = std::max(p.min, -1e30), max = std::min<double>(p.max, 1e30);
        const auto fits = [&](float x) { return range_problem(p, x).empty() && x >= min && x <= max; };
        for (int attempt = 0; attempt < 20; ++attempt) {
            const double part = below(1u << 30) / double(1u << 30);
            const double choices[] = {min,
                                      max,
                                      -0.0,
                                      static_cast<double>(below(20)) / 10,
                                      min + (max - min) * part,
                                      std::ldexp(part, static_cast<int>(below(60)) - 40),
                                      -std::ldexp(part, static_cast<int>(below(60)) - 40)};
            const float x = static_cast<float>(choices[below(7)]);
            if (fits(x)) return x;
        }
        return static_cast<float>(min + (std::min(max, min + 1) - min) / 2);
    }

    std::string text() {
        static const char* const texts[] = {"a", "b \"c\"", "d/~e\\", "größer\u2026", "x.png"};
        return texts[below(5)];
    }

    template <class T>
    void store(const Parameter& p, void* base, std::size_t index, T value) {
        std::memcpy(static_cast<std::byte*>(base) + p.offset + index * sizeof(T), &value, sizeof(T));
    }

    void fill(std::span<const Parameter> table, void* base) {
        for (const Parameter& p : table)
            if (below(3) != 0) fill(p, base);
    }

    void fill(const Parameter& p, void* base) {
        const bool alike = p.kind == ParameterKind::number && maybe();
        const float one = p.kind <= ParameterKind::vector ? number(p) : 0;
        for (unsigned i = 0; i < p.count; ++i) {
            switch (p.kind) {
                case ParameterKind::number:
                case ParameterKind::vector:
                    store(p, base, i, alike ? one : number(p));
                    break;
                case ParameterKind::angle_or_mesh:
                    store(p, base, i, maybe() ? one : std::numeric_limits<float>::quiet_NaN());
                    break;
                case ParameterKind::integer:
                    store(p, base, i, static_cast<std::uint32_t>(p.min) + below(5));
                    break;
                case ParameterKind::flag:
                    store(p, base, i, maybe());
                    break;
                case ParameterKind::choice:
                    store(p, base, i, static_cast<int>(below(static_cast<std::uint32_t>(choice_names(p).size()))));
                    break;
                case ParameterKind::text:
                    *reinterpret_cast<std::string*>(static_cast<std::byte*>(base) + p.offset) = text();
                    break;
                case ParameterKind::object:
                case ParameterKind::list:
                    break;
            }
        }
    }

    void draw(AirDesc& air) {
        fill(air_keys, &air);
        for (std::uint32_t i = below(3); i > 0; --i) {
            WindDesc& wind = air.wind.emplace_back();
            fill(wind_keys, &wind);
            std::uint32_t kind = below(3);
#define WEFT_WIND(name, Name) \
    if (kind-- == 0) fill(name##_parameters, &wind.kind.emplace<Name##Desc>());
#include "physics/air/winds.def"
#undef WEFT_WIND
            fill(pose_keys, &wind.transform);
            draw_keys(
                wind.motion, wind_key_keys,
                WindKey{.position = wind.transform.position, .rotation_degrees = wind.transform.rotation_degrees});
            if (maybe()) fill(wind_box_keys, &wind.box.emplace());
            fill(gust_keys, &wind.gust);
            fill(turbulence_keys, &wind.turbulence);
        }
    }

    MeshDesc mesh(bool of_a_file) {
        if (of_a_file) {
            MeshFileDesc file;
            fill(mesh_file_keys, &file);
            file.file = text();
            return file;
        }
        switch (below(3)) {
            case 0: {
                GridDesc grid{.size = {1, 1}, .resolution = {3, 5}};
                fill(grid_keys, &grid);
                if (grid.resolution[0] > 9) grid.resolution = {3, 5};
                return grid;
            }
            case 1: {
                SphereMeshDesc sphere;
                fill(sphere_mesh_keys, &sphere);
                sphere.subdivisions %= 3;
                return sphere;
            }
            default: {
                BoxMeshDesc box{.size = {1, 1, 1}, .resolution = {2, 3, 4}};
                fill(box_mesh_keys, &box);
                return box;
            }
        }
    }

    template <class Key>
    void draw_keys(std::vector<Key>& keys, std::span<const Parameter> table, const Key& like) {
        float time = 0;
        for (std::uint32_t i = below(4); i > 0; --i) {
            Key& key = keys.emplace_back(like);
            fill(table, &key);
            key.time = time;
            time += 0.01f + static_cast<float>(below(100)) / 7;
        }
    }

    void draw(SceneCloth& cloth) {
        fill(cloth_keys, &cloth);
        cloth.mesh = mesh(below(4) == 0);
        const bool of_a_file = std::holds_alternative<MeshFileDesc>(cloth.mesh);
        if (below(3) == 0) cloth.render_mesh = mesh(maybe());
        fill(transform_keys, &cloth.transform);
        const auto presets = fabric_presets();
        const FabricPreset& preset = presets[below(static_cast<std::uint32_t>(presets.size()))];
        cloth.fabric_name = preset.name;
        cloth.fabric = preset.fabric;
        if (maybe())
            for (const FabricTable& table : fabric_tables())
                fill(table.parameters, reinterpret_cast<std::byte*>(&cloth.fabric) + table.offset);
        if (cloth.fabric.bend.edges == BendEdges::no_diagonals) cloth.fabric.bend.model = BendModel::dihedral;
        for (std::uint32_t i = below(3); i > 0; --i)
            cloth.groups.push_back({"group " + std::to_string(i), {below(4), below(4)}});
        for (std::uint32_t i = below(3); i > 0; --i) draw(cloth.pins.emplace_back(), of_a_file);
        for (PinDesc& pin : cloth.pins)
            if (auto* vertices = std::get_if<VertexPins>(&pin.select); vertices && !cloth.groups.empty() && maybe())
                *vertices = {cloth.groups[0].vertices, cloth.groups[0].name};
        for (std::uint32_t i = below(3); i > 0; --i) {
            fill(weight_keys, &cloth.weights.emplace_back());
            draw_painted(cloth.weights.back(), weight_factor_keys, of_a_file);
        }
        if (cloth.tearing == Tearing::off) return;
        cloth.fabric.stretch.model = StretchModel::edges;  // membranes do not open
        for (std::uint32_t i = below(3); i > 0; --i) draw(cloth.cuts.emplace_back(), cut_keys);
        if (cloth.tearing == Tearing::split)
            for (std::uint32_t i = below(3); i > 0; --i) {
                draw(cloth.seams.emplace_back(), seam_keys);
                if (cloth.seams.back().strength == 0) cloth.seams.back().strength = 5;  // the key is required
            }
        if (cloth.tearing == Tearing::cuts) return;
        for (std::uint32_t i = below(3); i > 0; --i)
            draw_painted(cloth.resistance.emplace_back(), resistance_factor_keys, of_a_file);
    }

    template <class Desc>
    void draw_painted(Desc& painted, std::span<const Parameter> keys, bool of_a_file) {
        fill(keys, &painted);
        const std::uint32_t kind = below(of_a_file ? 4 : 2);
        if (kind == 0) painted.select = VertexPins{{below(4), below(4)}};
        if (kind == 0 && maybe()) painted.factors = {0.25f, 7};
        if (kind == 1) painted.select = BoxPins{{{-1e3f, -0.0f, -2.5f}, {1, 0.1f, 1e20f}}};
        if (kind == 2) fill(color_pin_keys, &painted.select.template emplace<ColorPins>());
        if (kind == 3) fill(painted_channel_keys, &painted.select.template emplace<PaintedChannel>());
    }

    template <class Path>
    void draw(Path& cut, std::span<const Parameter> keys) {
        fill(keys, &cut);
        if (maybe()) {
            fill(cut_plane_keys, &cut.along.template emplace<PlaneCut>());
            std::get<PlaneCut>(cut.along).normal.z = 0.3f;
        } else {
            cut.along = PathCut{{{-0.5f, -0.0f, 0.1f}, {0.25f, 1e-20f, 3}}};
        }
    }

    void draw(PinDesc& pin, bool of_a_file) {
        fill(pin_motion_keys, &pin);
        pin.attach.clear();
        const std::uint32_t kind = below(of_a_file ? 3 : 2);
        if (kind == 0) pin.select = VertexPins{{below(4), below(4)}};
        if (kind == 1) pin.select = BoxPins{{{-1e3f, -0.0f, -2.5f}, {1, 0.1f, 1e20f}}};
        if (kind == 2) fill(color_pin_keys, &pin.select.emplace<ColorPins>());
        if (maybe()) draw_keys(pin.motion, offset_key_keys, OffsetKey());
    }

    void draw(StitchDesc& stitches, const SceneDesc& scene) {
        fill(stitch_keys, &stitches);
        stitches.name.clear();
        const std::uint32_t count = 1 + below(3);
        for (StitchEnd* end : {&stitches.a, &stitches.b}) {
            end->cloth = scene.cloths[below(static_cast<std::uint32_t>(scene.cloths.size()))].name;
            const bool vertices = maybe();
            for (std::uint32_t k = 0; k < count; ++k) {
                if (vertices) end->vertices.push_back(below(4));
                if (!vertices) end->points.push_back({below(2), maybe() ? Vec3{0.25f, 0.5f, 0.25f} : Vec3{0, 1, 0}});
            }
        }
    }

    void draw(ColliderDesc& collider) {
        fill(collider_keys, &collider);
        std::uint32_t kind = below(std::size(shape_keys));
#define WEFT_SHAPE(name, Name) \
    if (kind-- == 0) fill(name##_parameters, &collider.shape.emplace<Name##Desc>());
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
        with_mesh_shape(collider.shape, [](auto& shape) {
            if (shape.file.empty()) shape.file = "stone.obj";
            for (float* scale : {&shape.scale.x, &shape.scale.y, &shape.scale.z})
                if (*scale == 0) *scale = -2;
        });
        if (auto* plane = std::get_if<PlaneDesc>(&collider.shape)) plane->normal.y = 0.3f;
        fill(pose_keys, &collider.transform);
        draw_keys(collider.motion, pose_key_keys,
                  PoseKey{.time = 0,
                          .position = collider.transform.position,
                          .rotation_degrees = collider.transform.rotation_degrees});
        if (collider.motion.empty() && !std::holds_alternative<PlaneDesc>(collider.shape) && maybe()) {
            fill(rigid_body_parameters, &collider.body.emplace());
            const Vec3 moments = collider.body->inertia;
            if (!inertia_problem(moments).empty()) collider.body->inertia = {moments.x, moments.x, moments.x};
            if (auto* mesh = std::get_if<SolidMeshDesc>(&collider.shape))
                if (mesh->contact == MeshContact::surface) mesh->contact = MeshContact::solid;
        }
    }

    // Some get a name, each a different one.
    template <class Named>
    void name(std::vector<Named>& all, const std::string& word) {
        for (std::size_t i = 0; i < all.size(); ++i) all[i].name = maybe() ? "" : word + " \"" + std::to_string(9 - i);
    }

    void draw(std::optional<SceneMaterial>& material, const MaterialPreset& own) {
        if (maybe()) return;
        const auto presets = material_presets();
        const MaterialPreset& preset = maybe() ? own : presets[below(static_cast<std::uint32_t>(presets.size()))];
        material = {.preset = std::string(preset.name), .values = preset.material};
        if (maybe()) fill(material_parameters, &material->values);
    }

    std::uint64_t state_;
};

}  // namespace weft
