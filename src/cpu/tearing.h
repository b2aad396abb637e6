// A cloth that tears on the CPU: finds where its load exceeds the fabric's limits, and opens edges there
// (physics/tear/tear.md).
#pragma once

#include "base/workers.h"
#include "cpu/passes.h"
#include "cpu/world_arrays.h"
#include "solver/model/cloth_model.h"
#include "solver/model/opened_cloth.h"
#include "solver/model/tear_law.h"
#include "solver/state/particle_weight.h"

#include <memory>
#include <span>
#include <vector>

namespace weft::cpu {

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
    void run(const ClothModel& model, const Particles& now, std::span<float> weights, std::uint32_t substep);

  private:
    struct Watched {
        std::uint32_t particle = 0;
        float load = 0;
        float x = 1, y = 0;  // direction of the tension, in the axes of the vertex
        bool end = false;    // a cut ends here
    };
    struct Choice {
        std::uint32_t link = none;
        float strayed = 0;
    };

    void list_ends(const ClothModel& model);
    void begin_watching(const ClothModel& model);
    void add_watched(std::uint32_t particle);
    void add_around(const ClothModel& model, std::uint32_t vertex);
    Watched load_of(const ClothModel& model, const Particles& now, std::uint32_t particle) const;
    float inverse_limit(const ClothModel& model, const Watched& at, std::uint32_t particle, float area) const;
    bool is_largest(const ClothModel& model, const Watched& candidate) const;
    Opening opening_at(const ClothModel& model, const Watched& at) const;
    Choice choose_link(const ClothModel& model, std::uint32_t particle, float along_x, float along_y, float strayed,
                       std::uint32_t taken) const;
    bool is_closed(const TearTable& table, std::uint32_t link) const;
    bool is_end(const ClothModel& model, std::uint32_t particle) const;
    void open(const ClothModel& model, const Opening& opening, const Particles& now, std::span<float> weights);

    template <class Visit>
    void for_each_entry(const TearTable& table, std::uint32_t particle, Visit&& visit) const;

    OpenedArrays arrays_;
    std::vector<Opening> openings_;
    std::vector<std::uint32_t> vertex_;     ///< per particle
    std::vector<std::uint16_t> hot_;        ///< per lane_padding triangles: a bit for each that is watched
    std::vector<std::uint32_t> ends_;       ///< particles at which a cut ends, ascending
    std::vector<std::uint8_t> is_watched_;  ///< per particle
    std::vector<std::uint32_t> watched_;    ///< particles
    std::vector<Watched> loads_;            ///< of `watched_`
    std::vector<std::uint32_t> place_;      ///< per particle that is watched: its place in `loads_`
    std::vector<Watched> chosen_;
    std::vector<ParticleWeight> weights_before_;  ///< those that this frame has changed, in the order of the changes
};

}  // namespace weft::cpu
