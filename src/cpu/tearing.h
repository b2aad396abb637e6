// A cloth that tears on the CPU: finds where its load exceeds the fabric's limits, and opens edges there
// (physics/tear/rules.kernel.h).
#pragma once

#include "cpu/passes.h"
#include "cpu/world_arrays.h"
#include "solver/model/opened_cloth.h"
#include "solver/model/tear_cloth.h"
#include "solver/state/particle_weight.h"

#include <span>
#include <vector>

namespace weft::cpu {

/// What the particles of a cloth have, and their copies get.
struct TornParticles {
    Particles points;
    std::span<float> weights;
    std::span<float> thickness_factors;  ///< empty: all 1
};

class Tearing {
  public:
    /// Copies the model's arrays. The model must have a tear law.
    explicit Tearing(const ClothModel& model);

    /// The arrays after the openings of this frame.
    const OpenedArrays& arrays() const { return arrays_; }
    /// The openings since the model was set, in order.
    const std::vector<Opening>& openings() const { return openings_; }

    /// Goes on from the model that has these openings.
    void set_model(const ClothModel& model);
    /// Goes back to the model.
    void roll_back(const ClothModel& model, std::span<float> weights);

    /// Finds the triangles whose load may soon exceed a limit. Every worker calls it with its own triangles, once a
    /// frame.
    void watch(const Passes& passes, const ClothModel& model, const float* position, Range triangles);
    /// Opens edges. One worker calls it in every substep.
    void run(const Passes& passes, const ClothModel& model, const TornParticles& particles, std::uint32_t substep);

  private:
    void list_ends(const ClothModel& model);
    void begin_watching(const ClothModel& model);
    TearView view(const ClothModel& model, const float* position, const float* limits,
                  std::vector<std::uint16_t>& hot) const;
    void add_watched(const ClothModel& model, std::uint32_t particle);
    void list_loaded(const Passes& passes, const ClothModel& model, const float* position);
    void add_loaded(std::uint32_t particle);
    void add_ends_around(const scalar::TearAccess& access, std::uint32_t particle);
    void find_loads(const scalar::TearAccess& access, std::span<const float> weights, std::size_t from);
    void limit_end(const scalar::TearAccess& access, std::uint32_t particle);
    void add_around(const ClothModel& model, std::uint32_t vertex);
    void open(const scalar::TearAccess& access, const scalar::TearOpening& opening, const TornParticles& particles);
    void open_vertex(const scalar::TearAccess& access, std::uint32_t vertex, const Particles& now,
                     std::span<float> weights);

    OpenedArrays arrays_;
    std::vector<Opening> openings_;
    std::vector<std::uint32_t> vertex_;            ///< per particle
    std::vector<std::uint16_t> hot_;               ///< per lane_padding triangles: a bit for each that is watched
    std::vector<std::uint32_t> ends_;              ///< particles at which a cut ends, ascending
    AlignedVector<float> limits_;                  ///< as TearLaw::watch, with the limits of these ends
    std::vector<std::uint8_t> is_watched_;         ///< per particle
    std::vector<std::uint32_t> watched_;           ///< particles
    std::vector<std::uint32_t> near_;              ///< packets of the triangles at watched particles
    std::vector<std::uint8_t> is_near_;            ///< per packet
    std::vector<std::uint16_t> loaded_triangles_;  ///< as hot_, in this substep; valid in near packets
    std::vector<std::uint8_t> is_loaded_;          ///< per particle
    /// Watched particles that may open in this substep, and ends around them.
    std::vector<std::uint32_t> loaded_;
    std::vector<scalar::TearLoad> loads_;         ///< per particle; no load unless it is loaded
    std::vector<std::uint32_t> chosen_;           ///< particles
    std::vector<ParticleWeight> weights_before_;  ///< those that this frame has changed, in the order of the changes
};

}  // namespace weft::cpu
