// Models that are being built while their cloths move, each to be used from a frame that is known beforehand.
#pragma once

#include "base/workers.h"
#include "solver/model/cloth_model.h"

#include <weft/ids.h>
#include <weft/result.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace weft {

/// Touches nothing that a world does.
using BuildModel = std::function<Result<std::shared_ptr<const ClothModel>>()>;

/// Frames that a model of so many particles may take to build: five times what one core of 2024 needs for it at 60
/// frames a second, so a frame hardly ever waits. It depends on the size alone, so every run uses the model from the
/// same frame.
constexpr std::uint64_t frames_to_build(std::uint32_t particles) {
    return 1 + particles / 1024;
}

class PendingModels {
  public:
    struct Ready {
        ClothId cloth;
        Result<std::shared_ptr<const ClothModel>> model;
    };

    /// In place of what was pending for the cloth.
    void add(ClothId cloth, std::uint64_t due_frame, BuildModel build);
    /// Waits for nothing: what is being built for the cloth is left to itself.
    void drop(ClothId cloth);
    bool contains(ClothId cloth) const;
    /// Has the next model built in the background, one at a time. Without calls of this each is built when it is due.
    void start_next();
    /// The next one that is due in `frame`, in the order in which they were added. Waits for it.
    std::optional<Ready> take_due(std::uint64_t frame);
    /// Likewise, whenever it is due.
    std::optional<Ready> take_any() { return take_due(~std::uint64_t{0}); }

  private:
    struct Pending {
        ClothId cloth;
        std::uint64_t due;
        std::unique_ptr<std::optional<Result<std::shared_ptr<const ClothModel>>>> result;
        std::unique_ptr<LaterWork> work;  ///< writes to the result; ends before that goes
    };
    std::vector<Pending> pending_;
    std::vector<Pending> dropped_;  ///< while they run
};

}  // namespace weft
