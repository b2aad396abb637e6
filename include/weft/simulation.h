// Runs a scene, frame by frame.
#pragma once

#include <weft/export.h>
#include <weft/result.h>
#include <weft/vector.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// Overrides of what the scene file says, and where to compute.
struct Options {
    std::string backend = "auto";  ///< "auto" or "cpu"
    /// Threads in all, the calling one included, 1…256. The result has the same bits whatever the number.
    unsigned threads = 1;
    std::optional<std::uint32_t> substeps = {};    ///< per frame, 1…10000
    std::optional<std::uint32_t> iterations = {};  ///< per substep, 1…10000
    /// Instruction set: "avx512", "avx2", "sse4", "neon", "scalar"; empty takes the widest. Same bits for all of them.
    std::string isa = {};
};

/// The drawn surface of one cloth. Views into the simulation, valid until its next step.
struct Surface {
    std::string_view name;
    std::span<const Vec3> positions;  ///< m, per vertex of the mesh as it was loaded
    std::span<const Vec3> normals;    ///< unit
    std::span<const Vec2> uvs;        ///< empty if the mesh has none
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

class WEFT_API Simulation {
  public:
    /// Reads a scene file and everything it names. Fails with every problem found, each with its place.
    static Result<Simulation> load(const std::filesystem::path& scene, const Options& options = {});

    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    ~Simulation();

    /// Advances by one frame of the scene's frame rate.
    void step();

    std::uint64_t frame() const;  ///< 0 is the start
    double time() const;          ///< s

    std::size_t cloth_count() const;
    Surface cloth(std::size_t index) const;

    /// What the last step held back or caught, by name ("SpeedCapped", "NonFinite"); empty if all went well.
    std::vector<std::string_view> reports() const;
    /// 16 hexadecimal digits that differ as soon as one bit of the state does.
    std::string state_hash() const;

    /// Writes the surfaces as they are now: `.obj`, `.ply` or `.glb`.
    Result<Done> save(const std::filesystem::path& file) const;

  private:
    struct Impl;
    explicit Simulation(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft
