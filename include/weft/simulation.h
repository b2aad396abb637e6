// A cloth simulation: loaded from a scene file, or created empty and filled by the program.
#pragma once

#include <weft/contact_forces.h>
#include <weft/export.h>
#include <weft/grab.h>
#include <weft/ids.h>
#include <weft/mesh.h>
#include <weft/result.h>
#include <weft/scene.h>
#include <weft/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Reads the mesh file of a cloth (MeshFileDesc). `folder` is the folder of the scene file, or empty if there is none.
using MeshReader = std::function<Result<TriangleMesh>(const std::string& file, const std::filesystem::path& folder)>;

/// Where and how to compute, and solver settings that replace those of the scene.
struct Options {
    /// "cpu", "vulkan" or "auto". "auto" uses Vulkan if there is a suitable GPU, otherwise the CPU. For a
    /// scene file with self-collision, "auto" uses the CPU if `device` is empty.
    std::string backend = "auto";
    /// Vulkan: part of the device's name, case-insensitive; empty: the best device.
    std::string device = {};
    /// Vulkan: how a frame is split into dispatches. "streamed": one per pass; "grouped": passes of small coarse levels
    /// share one; "fused": one per frame, with a workgroup per cloth; "auto": chosen by size and device
    /// (docs/vulkan.md). The result has the same bits in each case.
    std::string execution = "auto";
    /// CPU: number of threads including the calling one, 1…256. The result has the same bits for every number.
    unsigned threads = 1;
    /// Solver options that replace those of the scene. Keys are those of a scene's `solver` (docs/scene.md):
    /// `{{"substeps", 8}, {"method", "pbd"}, {"hierarchy", false}}`.
    ParameterValues solver = {};
    /// CPU: instruction set, "avx512", "avx2", "sse4", "neon" or "scalar"; empty: the widest available one. The result
    /// has the same bits for all of them.
    std::string isa = {};
    /// Record contacts for Simulation::contact_forces(). The motion has the same bits with and without it.
    bool contact_forces = false;
    /// Vulkan: measure the time of each stage of a frame, at a small cost.
    bool stage_timings = false;
    /// Reads mesh files of cloths. If empty, Simulation::load uses read_mesh_file of <weft/files.h>, and in a
    /// simulation made by Simulation::create a cloth with a mesh file is an error.
    MeshReader read_mesh = {};
    /// Folder that keeps the distance fields of mesh colliders from run to run. nullopt: that of the environment,
    /// $WEFT_CACHE or $XDG_CACHE_HOME/weft or ~/.cache/weft. Empty: none.
    std::optional<std::filesystem::path> field_cache = {};
};

/// Settings of a whole simulation. Ranges are those of a scene file (docs/scene.md).
struct WorldDesc {
    Vec3 gravity{0, -9.81f, 0};  ///< m/s²
    SolverDesc solver = {};
    std::optional<AirDesc> air = {};  ///< nullopt: no air
    float frame_rate = 60;            ///< frames/s of step(), > 0, ≤ 100000
};

/// The render mesh of one cloth. The views point into the simulation and are valid until its next step or change.
struct Surface {
    std::string_view name;
    std::span<const Vec3> positions;  ///< m, one per vertex of the mesh as loaded; then those of cuts
    std::span<const Vec3> normals;    ///< unit, one per vertex
    std::span<const Vec2> uvs;        ///< one per vertex; empty if the mesh has no UVs
    std::span<const std::array<std::uint32_t, 3>> triangles;  ///< three vertex indices each
};

/// Measures of the state after the last step, over all cloths.
struct Measures {
    double mean_stretch = 0, max_stretch = 0;    ///< |ℓ/ℓ₀ − 1| of edges along warp or weft
    double mean_shear = 0, max_shear = 0;        ///< |ℓ/ℓ₀ − 1| of all other edges
    double mean_residual = 0, max_residual = 0;  ///< unsolved part of the stretch: |C + α̃λ| / ℓ₀
    double kinetic_energy = 0;                   ///< J
    double max_speed = 0;                        ///< m/s, of the fastest particle
    double max_penetration = 0;                  ///< m, largest depth below the true surface of a collider
};

/// A rigid body: a collider that gravity, cloth, colliders and other bodies move.
struct BodyMotion {
    Vec3 position;  ///< m, of the collider
    Vec4 rotation;  ///< unit quaternion x, y, z, w: from the collider's axes to the world's
    Vec3 center;    ///< m, of mass
    Vec3 velocity;  ///< m/s, of the center of mass
    Vec3 spin;      ///< °/s, angular velocity about the world's axes
    double mass;    ///< kg, with the particles of cloth that are rigidly pinned to it
    double energy;  ///< J, kinetic
};

/// What Simulation::save() writes besides the cloths and the bodies.
struct SaveOptions {
    bool colliders = false;  ///< `.glb`: also the colliders that are no bodies, except planes
};

/// A world of cloths and colliders. Functions that take an id return an error or an empty value if the id does not name
/// an object of this simulation, or its object was removed. A function that returns an error has not changed the
/// simulation. A Simulation is not thread-safe: use it from one thread at a time.
class WEFT_API Simulation {
  public:
    /// Reads a scene file and all files that it names. On failure it returns all problems found, each with its place in
    /// the file. load(), save() and save_scene() are in the library weft::io, all other functions in weft::core.
    static Result<Simulation> load(const std::filesystem::path& scene, const Options& options = {});
    /// Creates a simulation without cloths and colliders. Fails on values out of range or an unavailable backend.
    static Result<Simulation> create(const WorldDesc& world = {}, const Options& options = {});

    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();

    /// Advances by one frame, 1/frame_rate seconds. On a device it returns as soon as the frame is submitted. Queries
    /// of results, edits and the next step wait for the frame to finish. contact_forces(), frame(), time(), move() and
    /// the functions that list and find objects do not wait.
    void step();
    /// Advances by one frame of dt seconds. Fails unless 0 < dt ≤ 1000.
    Result<void> step(double dt);

    std::uint64_t frame() const;  ///< number of frames since the start
    double time() const;          ///< s, simulated time since the start

    // Objects of the simulation. All can be added and removed between two steps.

    /// Adds a cloth. Its mesh is copied. Its pins can attach to existing colliders by name. The name must differ from
    /// those of the other cloths; an empty name is replaced by a free one such as `cloth 0`. Fails with all problems
    /// found: values out of range, a mesh that cannot be read or simulated, not enough device memory.
    Result<ClothId> add(const ClothDesc& cloth);
    /// Adds a collider. Names follow the same rules as those of cloths.
    Result<ColliderId> add(const ColliderDesc& collider);
    /// Stitches existing cloths together at their current positions. The stitches are removed with either of their
    /// cloths.
    Result<StitchId> add(const StitchDesc& stitches);
    Result<void> remove(ClothId id);
    /// Pins that are attached to the collider stay at their current positions.
    Result<void> remove(ColliderId id);
    Result<void> remove(StitchId id);

    std::vector<ClothId> cloths() const;  ///< in the order of adding
    std::vector<ColliderId> colliders() const;
    std::vector<StitchId> stitches() const;
    ClothId find_cloth(std::string_view name) const;        ///< a null id if no cloth has this name
    ColliderId find_collider(std::string_view name) const;  ///< a null id if no collider has this name

    // Changes between two steps. Cloths keep their positions and velocities.

    /// Changes the fabric from the next step on. Normally this computes new parameters for the existing constraints
    /// (times: docs/performance.md). The model of the cloth is rebuilt only if it needs other constraints: if a
    /// stiffness changes between zero and nonzero, if `stretch_model`, `bend_model`, `bend_edges`, `bend_fit` or
    /// `rest_angle` change, if `bend` changes with the bend model `plate`, or if `stretch`, `compression` or `shear`
    /// change with the stretch model `membrane`. Without a rebuild, coarse levels and tethers remain those of the old
    /// fabric for some frames. They change in the same frame on every run.
    Result<void> set_fabric(ClothId id, const FabricDesc& fabric);
    /// Replaces all pins of the cloth. Particles are pinned at their current positions, and a box selects by current
    /// positions. The cost is proportional to the number of particles concerned. If pins with a compliance are added,
    /// removed or changed, only the springs of the model are rebuilt. The whole model is rebuilt if the springs exceed
    /// its room, which is at least eight more than it was built with. Coarse levels and tethers follow some frames
    /// later, in the same frame on every run.
    Result<void> set_pins(ClothId id, std::vector<PinDesc> pins);
    /// Replaces all weights of the cloth, from the next step on. A box selects by the positions at the start. The model
    /// is rebuilt. A place that becomes heavier, stiffer or thicker does so at once; cloth that then overlaps is pushed
    /// apart at 1 m/s at most.
    Result<void> set_weights(ClothId id, std::vector<WeightDesc> weights);
    /// Replaces the resistance of all particles, from the next step on. A box selects by the positions at the start.
    /// Fails unless the cloth's tearing is `split` or `erode`.
    Result<void> set_resistance(ClothId id, std::vector<ResistanceDesc> resistance);
    /// Opens edges of the cloth along a path or a plane, before the next frame; CutDesc::time is ignored. Particles on
    /// the cut are doubled, so surface() may have more vertices afterwards, appended to those of the mesh. The cloth
    /// needs a tearing other than `off`. The open edges are part of save_state(), not of save_scene(). Fails if the cut
    /// meets no closed edge, parts nothing (a single edge inside the cloth), leaves the cloth, or needs more copies of
    /// particles than the cloth has room for (ClothDesc::tear_room).
    Result<void> cut(ClothId id, const CutDesc& cut, CutPositions positions = CutPositions::current);
    /// Moves the collider from its current pose to this one during the next frame; cloth in contact moves with it. The
    /// collider then stays there. Position in m; rotation in degrees, R = Rz·Ry·Rx. Ends a motion by keys. A body is
    /// put there at once, at rest.
    Result<void> move(ColliderId id, Vec3 position, Vec3 rotation_degrees = {});
    /// Makes the collider a body at its current place, with the velocity and the spin of the description; nullopt: it
    /// is no body any more and stays where it is. Ends a motion by keys. Cloth that is pinned to the collider stays
    /// pinned, and pulls a body. Fails on values out of range, for planes and for shapes that have no mass, and with
    /// more bodies than the backend moves (256 on Vulkan).
    Result<void> set_body(ColliderId id, const std::optional<BodyDesc>& body);
    /// Puts a body elsewhere at once. Position in m; rotation in degrees, R = Rz·Ry·Rx; velocity of the center of mass
    /// in m/s; spin in °/s about the world's axes. What is there already is pushed out slowly. move() does the same,
    /// without velocity and spin. Fails if the collider is no body.
    Result<void> place_body(ColliderId id, Vec3 position, Vec3 rotation_degrees = {}, Vec3 velocity = {},
                            Vec3 spin = {});
    /// Changes the velocity and the spin of a body by an impulse in N·s at a point in world space, in m. The impulse
    /// of a force over a frame is the force times its seconds. Fails if the collider is no body.
    Result<void> push(ColliderId id, Vec3 impulse, Vec3 point);
    /// nullopt if the id names no body.
    std::optional<BodyMotion> body(ColliderId id) const;
    /// Friction coefficients of the collider, 0…100.
    Result<void> set_friction(ColliderId id, float static_friction, float kinetic_friction);
    Result<void> set_gravity(Vec3 gravity);  ///< m/s²
    /// Rebuilds the models of all cloths if coarse levels (`hierarchy`) or the `projection` require another layout.
    Result<void> set_solver(const SolverDesc& solver);
    /// nullopt: no air.
    Result<void> set_air(const std::optional<AirDesc>& air);

    // Grabs: a hand, or the mouse, pulls a cloth at a point. Any number at a time, also at one triangle. They belong to
    // save_state() and state_hash(), not to save_scene().

    /// Pulls the point of the cloth toward the place `to` in world space (m, each coordinate up to 1e6), from the next
    /// frame on. A grab follows its triangle through cuts and tears, and stays when fabric, pins or solver change. It
    /// is released with its cloth, and when its triangle is eroded. Pinned corners do not move. Fails if the triangle
    /// is not in the mesh, is not simulated or has been removed, if the weights do not sum to 1, and on values out of
    /// the ranges of GrabDesc.
    Result<GrabId> grab(ClothId id, const MeshPoint& point, Vec3 to, const GrabDesc& grab = {});
    /// The target moves evenly from its place to `to` during the next frame, then stays there. Does not wait.
    Result<void> move_grab(GrabId id, Vec3 to);
    Result<void> release(GrabId id);
    std::vector<GrabId> grabs() const;  ///< in the order of grabbing
    /// N: the force on the cloth in the last frame, its mean over the substeps. In each of them it is at most
    /// `max_force`. 0 if the id names nothing.
    Vec3 grab_force(GrabId id) const;
    /// m: the place of the grabbed point. 0 if the id names nothing.
    Vec3 grab_position(GrabId id) const;

    // Results.

    Surface surface(ClothId id) const;  ///< empty if the id names nothing
    std::size_t cloth_count() const;
    Surface cloth(std::size_t index) const;  ///< in the order of cloths(); empty if out of range
    /// One tangent per vertex of the surface, for normal maps. xyz is the unit direction in which u grows; w is the
    /// handedness, 1 or −1: bitangent = w · normal × tangent. Empty if the mesh has no UVs. Valid until the next call
    /// of tangents(), and until the next step or change.
    std::span<const Vec4> tangents(ClothId id) const;

    /// Computed on each call.
    Measures measure() const;
    /// Contacts and forces of one frame; ContactForces::frame is its number. Requires Options::contact_forces. It is
    /// the last frame if a call such as surface() or measure() has waited for that frame, otherwise the frame before.
    /// Never waits. Every backend returns the same frame with the same values. Empty before the first frame and after
    /// restore_state(). A cloth that was not finite in the frame contributes nothing. The reference is valid until the
    /// next call of contact_forces(), step or change.
    const ContactForces& contact_forces() const;
    /// Names of the problems in the last step; empty if there were none. "SpeedCapped": particles were slowed to the
    /// largest speed. "NonFinite": a NaN or infinity arose, and the cloth and those stitched to it were restored to the
    /// start of the frame. "DeviceFailed": the device is lost or out of memory. "ContactsFull": some contacts are
    /// missing from the list of contact_forces().
    std::vector<std::string_view> reports() const;
    /// A 64-bit hash of the state of all cloths, as 16 hexadecimal digits.
    std::string state_hash() const;

    /// The state of everything that moves, for restore_state(). Steps after restore_state() give the same bits as the
    /// steps after save_state() did, if cloths, colliders and settings are the same.
    std::vector<std::byte> save_state() const;
    /// Fails on data that save_state() did not write, and on a state of other cloths or colliders.
    Result<void> restore_state(std::span<const std::byte> state);

    /// Writes the current surfaces of all cloths to an `.obj`, `.ply` or `.glb` file. A `.glb` also holds the rigid
    /// bodies of this moment, at their poses.
    Result<void> save(const std::filesystem::path& file, const SaveOptions& options = {}) const;
    /// Writes a scene file with all objects and all changes to them, but without the current positions: the new scene
    /// begins at the start. Meshes that were given in memory are written to .ply files beside it. Fails if there is no
    /// cloth.
    Result<void> save_scene(const std::filesystem::path& file) const;

  private:
    friend struct SimulationAccess;  // of weft::io
    struct Impl;
    explicit Simulation(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft
