// The parts of a cloth that change when edges of its mesh are opened: corners of triangles, the particles of
// constraints, masses. A model is made from them after an edit (with_edit); a backend keeps them while the cloth tears.
#pragma once

#include "physics/stretch/stretch_law.h"
#include "solver/model/cloth_edit.h"
#include "solver/model/tear_table.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// Arrays as in ClothModel, with room for all particles that can be appended.
struct OpenedArrays {
    struct Rows {
        AlignedVector<std::uint32_t> particles;
        AlignedVector<float> fields, geometry;
        std::uint32_t rows = 0;  ///< without padding
    };
    AlignedVector<std::uint32_t> faces;
    std::array<Rows, constraint_kind_count> rows;
    std::vector<LineBlock> blocks;  ///< of the stretch table
    /// Per lane_padding rows of the stretch table's second halves: whether any is in use.
    std::vector<std::uint8_t> halves_used;
    /// Per stretch constraint of a cloth that erodes: whether it has the stiffness of the one triangle that is left.
    std::vector<std::uint8_t> settled;
    AlignedVector<float> mass;               ///< kg, per particle
    std::vector<std::uint32_t> copied_from;  ///< per appended particle: the particle that was copied
    std::vector<float> strayed;              ///< m, per vertex: that of a rip which ends there (Opening)
    std::vector<std::array<std::uint32_t, 2>> without_row;
    std::vector<std::uint32_t> fan;  ///< scratch: per entry of the tear table
    std::uint32_t particle_count = 0;
    std::uint32_t room = 0;  ///< particles that can still be appended

    OpenedArrays() = default;
    /// Copies the arrays of a model.
    explicit OpenedArrays(const ClothModel& model);

  private:
    void find_settled(const ClothModel& model);
};

/// Sets the masses of particles at vertices that have copies, in the way that Opener does.
void weigh_opened(const ClothModel& model, std::span<float> mass);

/// Opens edges by the rules of tearing (physics/tear/rules.kernel.h). The result depends only on the order of the
/// openings.
class Opener {
  public:
    /// `model` must have a tear table, and must be the one from which `arrays` were copied or an earlier one.
    Opener(const ClothModel& model, OpenedArrays& arrays);
    /// `law`: that of the model's fabric.
    Opener(const ClothModel& model, OpenedArrays& arrays, const StretchLaw& law)
        : model_(model), arrays_(arrays), law_(law) {}

    /// Removes the triangle of a link, or parts the triangles at the vertex of the links along these edges. If they
    /// then form several fans, the first fan keeps the particle, and each other fan gets a copy. The same is done at
    /// the far ends, where an edge that was open before now parts them. Constraints follow their triangles; those that
    /// cross an open edge end. Returns false and changes nothing if there is no room for the copies.
    bool open(const Opening& opening);

  private:
    void update_rows(std::uint32_t vertex);

    const ClothModel& model_;
    OpenedArrays& arrays_;
    StretchLaw law_;
};

}  // namespace weft
