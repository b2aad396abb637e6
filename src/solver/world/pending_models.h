// Models that are built in the background while their cloths move. Each is used from a frame that is fixed in advance.
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

/// Must not access data that a World changes, because it may run on another thread.
using BuildModel = std::function<Result<std::shared_ptr<const ClothModel>>()>;

/// Frames until a model of this many particles is used: five times the build time on one core of 2024 at 60 frames per
/// second, so that a frame rarely has to wait. It depends only on the size, so every run uses the model from the same
/// frame.
constexpr std::uint64_t frames_to_build(std::uint32_t particles) {
    return 1 + particles / 1024;
}

/// Copies share the builds, so a copy keeps what was pending when it was made.
class PendingModels {
  public:
    struct Ready {
        ClothId cloth;
        Result<std::shared_ptr<const ClothModel>> model;
    };

    /// Replaces the pending model of the cloth.
    void add(ClothId cloth, std::uint64_t due_frame, BuildModel build);
    /// Does not wait: a running build continues, and its result is discarded.
    void drop(ClothId cloth);
    bool contains(ClothId cloth) const;
    /// Starts building the next model in the background, one at a time. A model that was not started is built when it
    /// is due.
    void start_next();
    /// Returns the next model that is due in `frame`, in the order of adding. Waits until it is built.
    std::optional<Ready> take_due(std::uint64_t frame);
    /// The same for any due frame.
    std::optional<Ready> take_any() { return take_due(~std::uint64_t{0}); }
    bool empty() const { return pending_.empty(); }
    /// The builds go on for another cloth with the same particles.
    void rename(ClothId cloth, ClothId to);

  private:
    struct Build {
        explicit Build(BuildModel build);
        std::optional<Result<std::shared_ptr<const ClothModel>>> result;
        LaterWork work;  ///< writes to `result`; destroyed first
    };
    struct Pending {
        ClothId cloth;
        std::uint64_t due;
        std::shared_ptr<Build> build;
    };
    std::vector<Pending> pending_;
    std::vector<Pending> dropped_;  ///< dropped builds that are still running
};

}  // namespace weft
