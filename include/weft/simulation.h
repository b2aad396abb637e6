// Simulates cloth: a scene from a file, or a world that a program fills and changes as it runs.
#pragma once

#include <weft/export.h>
#include <weft/feedback.h>
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

/// Reads the mesh that a cloth names by file (MeshFileDesc). `folder` is that of the scene; empty where there is none.
using MeshReader = std::function<Result<TriangleMesh>(const std::string& file, const std::filesystem::path& folder)>;

/// Overrides of what the scene says, and where to compute.
struct Options {
    /// "cpu", "vulkan", or "auto": Vulkan where there is a GPU for it, else the CPU.
    std::string backend = "auto";
    /// Vulkan: part of the device's name, in whatever case; empty takes the best.
    std::string device = {};
    /// Vulkan: how a frame becomes dispatches, "auto", "streamed" (one per pass), "grouped" (coarse levels in one) or
    /// "fused" (one for all, a workgroup to a cloth). The same bits.
    std::string execution = "auto";
    /// Threads in all, the calling one included, 1…256. The result has the same bits whatever the number.
    unsigned threads = 1;
    /// Solver options that replace those of the scene, by the keys of its `solver` (docs/scene.md):
    /// `{{"substeps", 8}, {"method", "pbd"}, {"hierarchy", false}}`.
    ParameterValues solver = {};
    /// Instruction set: "avx512", "avx2", "sse4", "neon", "scalar"; empty takes the widest. Same bits for all of them.
    std::string isa = {};
    /// Keep account of what cloth does to colliders: Simulation::feedback().
    bool feedback = false;
    /// Vulkan: time each stage of a frame, which costs a little.
    bool stage_timings = false;
    /// Without it, a cloth that names a mesh file is refused; Simulation::load then takes read_mesh_file of
    /// <weft/files.h>.
    MeshReader read_mesh = {};
};

/// What holds for everything in a world.
struct WorldDesc {
    Vec3 gravity{0, -9.81f, 0};  ///< m/s²
    SolverDesc solver = {};
    std::optional<AirDesc> air = {};  ///< without, a vacuum
    float frame_rate = 60;            ///< 1/s: of step()
};

/// The drawn surface of one cloth. Views into the simulation, valid until its next step or change.
struct Surface {
    std::string_view name;
    std::span<const Vec3> positions;  ///< m, per vertex of the mesh as it was loaded
    std::span<const Vec3> normals;    ///< unit
    std::span<const Vec2> uvs;        ///< empty if the mesh has none
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// How well the last step went.
struct Measures {
    double mean_stretch = 0, max_stretch = 0;    ///< |ℓ/ℓ₀ − 1| of the edges along warp and weft
    double mean_shear = 0, max_shear = 0;        ///< the same of the others
    double mean_residual = 0, max_residual = 0;  ///< of that, what the solver left unsolved
    double kinetic_energy = 0;                   ///< J
    double max_speed = 0;                        ///< m/s
    double max_penetration = 0;                  ///< m beyond a collider's surface
};

/// Functions that take an id fail, or give nothing, if it names nothing in this simulation (any more). A simulation is
/// used from one thread at a time.
class WEFT_API Simulation {
  public:
    /// Reads a scene file and everything it names. Fails with every problem found, each with its place. This, save()
    /// and save_scene() are in the library weft::io, all else is in weft::core.
    static Result<Simulation> load(const std::filesystem::path& scene, const Options& options = {});
    /// An empty world, to be filled.
    static Result<Simulation> create(const WorldDesc& world = {}, const Options& options = {});

    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();

    /// Advances by one frame of the world's frame rate. On a device the frame may be under way still when this returns:
    /// what asks for something that came of it waits, as do changes and the next step; feedback(), frame(), time(),
    /// set_friction(), move(), and what says what is in the world do not.
    void step();
    /// Advances by one frame of dt seconds; fails, and does nothing, unless 0 < dt ≤ 1000.
    Result<Done> step(double dt);

    std::uint64_t frame() const;  ///< 0 is the start
    double time() const;          ///< s

    // What is in the world. Everything may come and go between two steps.

    /// Pins may attach to colliders that are there, by name. The mesh is copied. Names of cloths differ, and so do
    /// those of colliders; what has none gets one.
    Result<ClothId> add(const ClothDesc& cloth);
    Result<ColliderId> add(const ColliderDesc& collider);
    /// Ties cloths together that are there already, from where they are now. Stitches go with either of their cloths.
    Result<StitchId> add(const StitchDesc& stitches);
    Result<Done> remove(ClothId id);
    /// Pins that it carried stay where they are.
    Result<Done> remove(ColliderId id);
    Result<Done> remove(StitchId id);

    std::vector<ClothId> cloths() const;  ///< in the order in which they were added
    std::vector<ColliderId> colliders() const;
    std::vector<StitchId> stitches() const;
    ClothId find_cloth(std::string_view name) const;  ///< no id if there is none of that name
    ColliderId find_collider(std::string_view name) const;

    // Change while it runs. Cloth goes on moving as it was.

    /// Acts from the next step on. The model of the cloth is built anew only where it needs other constraints: where
    /// the cloth loses all stiffness in a direction or gets some, where `bend_model`, `hinges` or `rest_angle` change,
    /// and where `bend` changes with the bend model `plate`. Otherwise this computes new numbers for the constraints
    /// that there are (docs/performance.md has the times). Coarse levels and tethers are then those of the former
    /// fabric for some frames; they change in the same frame on every run.
    Result<Done> set_fabric(ClothId id, const FabricDesc& fabric);
    /// In place of those that it has. Particles are held where they are now; a box selects those that are in it now.
    /// The cost is that of the particles concerned; where pins with a compliance come, go or change, springs are made
    /// anew and the rest of the cloth's model is kept. It is built anew where more of these are added than it has room
    /// for: eight more than it began with. Coarse levels and tethers follow some frames later, in the same frame on
    /// every run.
    Result<Done> set_pins(ClothId id, std::vector<PinDesc> pins);
    /// During the next frame the collider moves there from where it is, and takes cloth along; then it stays there.
    /// Rotation as in a scene, in degrees. Ends a motion by keys.
    Result<Done> move(ColliderId id, Vec3 position, Vec3 rotation_degrees = {});
    Result<Done> set_friction(ColliderId id, float static_friction, float kinetic_friction);
    Result<Done> set_gravity(Vec3 gravity);
    Result<Done> set_solver(const SolverDesc& solver);
    Result<Done> set_air(const std::optional<AirDesc>& air);

    // What came of it.

    Surface surface(ClothId id) const;
    std::size_t cloth_count() const;
    Surface cloth(std::size_t index) const;  ///< in the order of cloths(); empty from cloth_count() on
    /// Of the surface's vertices, for normal maps: unit tangents along which u grows, and in w the handedness, 1 or −1:
    /// bitangent = w · normal × tangent. Empty if the mesh has no UVs. Valid as long as the surface, and until the next
    /// call.
    std::span<const Vec4> tangents(ClothId id) const;

    Measures measure() const;
    /// With Options::feedback, what the cloths did to the colliders in a frame, which it names: of the last step if
    /// anything has waited for that one since, as surface() and measure() do; of the step before if not. Never waits.
    /// The same on every backend, whichever frame it is. Empty before, and after restore_state(). A cloth that was not
    /// finite in the frame did nothing. Valid until it is called again, or a step or change.
    const Feedback& feedback() const;
    /// What the last step held back or caught, by name ("SpeedCapped", "NonFinite", "ContactsFull"); empty if all went
    /// well.
    std::vector<std::string_view> reports() const;
    /// 16 hexadecimal digits that differ as soon as one bit of the state does.
    std::string state_hash() const;

    /// All that moves: what restore_state() brings back. The steps after it then have the same bits as they had, as
    /// long as the same cloths and colliders are there and settings are what they were.
    std::vector<std::byte> save_state() const;
    /// Fails, and changes nothing, on what save_state() did not give, or gave in another world.
    Result<Done> restore_state(std::span<const std::byte> state);

    /// Writes the surfaces as they are now: `.obj`, `.ply` or `.glb`.
    Result<Done> save(const std::filesystem::path& file) const;
    /// Writes what is in the world as a scene file: what was loaded or added, with every change since, but not where
    /// cloth and colliders have moved. Loading it gives a simulation that starts as one would in which all of it had
    /// been there from the start. Meshes that were given in memory go into .ply files beside it. Fails for a world
    /// without a cloth.
    Result<Done> save_scene(const std::filesystem::path& file) const;

  private:
    friend struct SimulationAccess;  // of weft::io
    struct Impl;
    explicit Simulation(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft
