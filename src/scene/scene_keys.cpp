#include "scene/scene_keys.h"

#include <vector>

namespace weft {
namespace {

// Structs with the default values that the tables refer to.
namespace defaults {

const SceneHead scene_head;
const FabricHead fabric_head;
const SceneDesc scene;
const AirDesc air;
const WindHead wind_head;
const WindDesc wind;
const WindKey wind_key;
const WindBoxDesc wind_box;
#define WEFT_WIND(name, Name) const Name##Desc name##_wind;
#include "physics/air/winds.def"
#undef WEFT_WIND
const SceneCloth cloth;
const MeshFileDesc mesh_file;
const GridDesc grid;
const SphereMeshDesc sphere_mesh;
const BoxMeshDesc box_mesh;
const ColorPins color_pins;
const ColliderDesc collider;
#define WEFT_SHAPE(name, Name) const Name##Desc name##_shape;
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
const GroupHead group_head;
const VertexGroup group;
const PinDesc pin;
const OffsetKey offset_key;
const CutDesc cut;
const SeamDesc seam;
const ResistanceDesc resistance;
const WeightDesc weight;
const PaintedChannel painted_channel;
const PlaneCut cut_plane;
const PoseKey pose_key;
const BodyDesc body;
const Camera camera;
const MaterialHead material_head;
const StitchDesc stitch;
const StitchEnd stitch_end;
const MeshPoint surface_point;

}  // namespace defaults

std::vector<SceneTable> all_tables() {
    using namespace defaults;
    std::vector<SceneTable> tables = {
        {"", head_keys, &scene_head},
        {"", scene_keys, &scene},
        {"/solver", solver_keys, &scene.solver},
        {"/air", air_keys, &air},
        {"/air/wind/*", wind_head_keys, &wind_head},
        {"/air/wind/*", wind_keys, &wind},
#define WEFT_WIND(name, Name) {"/air/wind/*", name##_parameters, &name##_wind},
#include "physics/air/winds.def"
#undef WEFT_WIND
        {"/air/wind/*/transform", pose_keys, &wind.transform},
        {"/air/wind/*/motion", motion_keys, nullptr},
        {"/air/wind/*/motion/keys/*", wind_key_keys, &wind_key},
        {"/air/wind/*/box", wind_box_keys, &wind_box},
        {"/air/wind/*/gust", gust_keys, &wind.gust},
        {"/air/wind/*/turbulence", turbulence_keys, &wind.turbulence},
        {"/cloths/*", cloth_keys, &cloth},
        {"/cloths/*/mesh", mesh_keys, nullptr},
        {"/cloths/*/mesh", mesh_file_keys, &mesh_file},
        {"/cloths/*/mesh/grid", grid_keys, &grid},
        {"/cloths/*/mesh/sphere", sphere_mesh_keys, &sphere_mesh},
        {"/cloths/*/mesh/box", box_mesh_keys, &box_mesh},
        // Its shapes have the same keys as in `mesh`.
        {"/cloths/*/render_mesh", mesh_keys, nullptr},
        {"/cloths/*/render_mesh", mesh_file_keys, &mesh_file},
        {"/cloths/*/transform", transform_keys, &cloth.transform},
        {"/cloths/*/fabric", fabric_keys, &fabric_head},
    };
    for (const FabricTable& table : fabric_tables())
        tables.push_back(
            {"/cloths/*/fabric", table.parameters, reinterpret_cast<const std::byte*>(&cloth.fabric) + table.offset});
    const SceneTable rest[] = {
        {"/cloths/*/groups/*", group_keys, &group},
        {"/cloths/*/pins/*", pin_keys, nullptr},
        {"/cloths/*/pins/*", in_group_keys, &group_head},
        {"/cloths/*/pins/*", color_pin_keys, &color_pins},
        {"/cloths/*/pins/*", pin_motion_keys, &pin},
        {"/cloths/*/pins/*/motion/*", offset_key_keys, &offset_key},
        {"/cloths/*/pins/*/box", box_keys, nullptr},
        {"/cloths/*/cuts/*", cut_keys, &cut},
        {"/cloths/*/cuts/*/plane", cut_plane_keys, &cut_plane},
        {"/cloths/*/seams/*", seam_keys, &seam},
        {"/cloths/*/seams/*/plane", cut_plane_keys, &cut_plane},
        {"/cloths/*/resistance/*", resistance_vertex_keys, nullptr},
        {"/cloths/*/resistance/*", in_group_keys, &group_head},
        {"/cloths/*/resistance/*", resistance_keys, nullptr},
        {"/cloths/*/resistance/*", color_pin_keys, &color_pins},
        {"/cloths/*/resistance/*", painted_channel_keys, &painted_channel},
        {"/cloths/*/resistance/*", resistance_factor_keys, &resistance},
        {"/cloths/*/resistance/*/box", box_keys, nullptr},
        {"/cloths/*/weights/*", weight_keys, &weight},
        {"/cloths/*/weights/*", resistance_vertex_keys, nullptr},
        {"/cloths/*/weights/*", in_group_keys, &group_head},
        {"/cloths/*/weights/*", resistance_keys, nullptr},
        {"/cloths/*/weights/*", color_pin_keys, &color_pins},
        {"/cloths/*/weights/*", painted_channel_keys, &painted_channel},
        {"/cloths/*/weights/*", weight_factor_keys, &weight},
        {"/cloths/*/weights/*/box", box_keys, nullptr},
        {"/cloths/*/material", material_keys, &material_head},
        {"/cloths/*/material", material_parameters, nullptr},
        // Its material has the same keys as a cloth's material.
        {"/colliders/*", collider_keys, &collider},
        {"/colliders/*/transform", pose_keys, &collider.transform},
#define WEFT_SHAPE(name, Name) {"/colliders/*/" #name, name##_parameters, &name##_shape},
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
        {"/colliders/*/motion", collider_motion_keys, nullptr},
        {"/colliders/*/motion/keys/*", pose_key_keys, &pose_key},
        {"/colliders/*/motion/dynamic", rigid_body_parameters, &body},
        {"/stitches/*", stitch_keys, &stitch},
        {"/stitches/*/a", stitch_end_keys, &stitch_end},
        {"/stitches/*/a/points/*", surface_point_keys, &surface_point},
        // Its points have the same keys as in `a`.
        {"/stitches/*/b", stitch_end_keys, &stitch_end},
        {"/camera", camera_parameters, &camera},
        {"/light", lighting_parameters, &scene.light},
        {"/light/sun", sun_parameters, &scene.light.sun},
        {"/light/sky", sky_parameters, &scene.light.sky},
        {"/light/environment", environment_parameters, &scene.light.environment},
    };
    tables.insert(tables.end(), std::begin(rest), std::end(rest));
    return tables;
}

}  // namespace

std::span<const SceneTable> scene_tables() {
    static const std::vector<SceneTable> tables = all_tables();
    return tables;
}

}  // namespace weft
