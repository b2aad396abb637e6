#include "solver/world/pending_models.h"

#include <algorithm>
#include <new>
#include <utility>

namespace weft {

PendingModels::Build::Build(BuildModel build)
    : work([this, build = std::move(build)] {
          try {
              result.emplace(build());
          } catch (const std::bad_alloc&) {  // an exception must not leave the build thread
              result.emplace(Error{"model", "not enough memory to build it"});
          }
      }) {}

void PendingModels::add(ClothId cloth, std::uint64_t due_frame, BuildModel build) {
    drop(cloth);
    pending_.push_back({cloth, due_frame, std::make_shared<Build>(std::move(build))});
}

void PendingModels::rename(ClothId cloth, ClothId to) {
    for (Pending& one : pending_)
        if (one.cloth == cloth) one.cloth = to;
}

void PendingModels::drop(ClothId cloth) {
    const auto one = std::ranges::find(pending_, cloth, &Pending::cloth);
    if (one == pending_.end()) return;
    if (one->build->work.started() && !one->build->work.done()) dropped_.push_back(std::move(*one));
    pending_.erase(one);
}

bool PendingModels::contains(ClothId cloth) const {
    return std::ranges::find(pending_, cloth, &Pending::cloth) != pending_.end();
}

void PendingModels::start_next() {
    std::erase_if(dropped_, [](const Pending& one) { return one.build->work.done(); });
    if (!dropped_.empty()) return;
    for (Pending& one : pending_) {
        if (one.build->work.done()) continue;
        if (!one.build->work.started()) one.build->work.start();
        return;
    }
}

std::optional<PendingModels::Ready> PendingModels::take_due(std::uint64_t frame) {
    const auto due = std::ranges::find_if(pending_, [&](const Pending& one) { return one.due <= frame; });
    if (due == pending_.end()) return {};
    due->build->work.wait();
    Ready ready{due->cloth, *due->build->result};
    pending_.erase(due);
    return ready;
}

}  // namespace weft
