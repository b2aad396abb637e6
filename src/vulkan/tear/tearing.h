// Cloths that tear on the device: the shaders of src/vulkan/shaders/tear find where a load exceeds the fabric's limits,
// and open edges there by the rules in physics/tear/rules.kernel.h.
#pragma once

#include "gpu/commands.h"
#include "solver/model/cloth_edit.h"
#include "vulkan/cloth_state.h"
#include "vulkan/programs.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace weft::vulkan {

/// Lives as long as the models of its cloths: after a frame in which a cloth has torn, the cloth gets another model.
class Tearing {
  public:
    /// Cloths of one frame; those that do not tear are left out. Returns null if none tears.
    static Result<std::unique_ptr<Tearing>> create(gpu::Device& device, Programs& programs,
                                                   std::span<const ClothState* const> cloths, const std::string& name);

    Result<void> record(gpu::Commands& commands, const Pass& pass) const;
    void record_end(gpu::Commands& commands) const;
    /// The openings of the member in the last finished frame, in order.
    std::vector<Opening> openings(std::size_t member) const;

  private:
    struct Torn {
        std::size_t member = 0;
        std::uint32_t particles = 0;  ///< with those in reserve
        Arena arena, data_arena;
        Slot head, log, data;
        gpu::Buffer back;  ///< head and log
    };

    Tearing(gpu::Device& device, Programs& programs) : device_(device), programs_(programs) {}
    Result<void> add(const ClothState& cloth, std::size_t member, const std::string& name);

    gpu::Device& device_;
    Programs& programs_;
    std::vector<std::unique_ptr<Torn>> torn_;
};

}  // namespace weft::vulkan
