#include "solver/world/pending_models.h"

#include <algorithm>
#include <new>
#include <utility>

namespace weft {

void PendingModels::add(ClothId cloth, std::uint64_t due_frame, BuildModel build) {
    drop(cloth);
    Pending pending{.cloth = cloth, .due = due_frame, .result = {}, .work = {}};
    pending.result = std::make_unique<std::optional<Result<std::shared_ptr<const ClothModel>>>>();
    auto& result = *pending.result;
    pending.work = std::make_unique<LaterWork>([&result, build = std::move(build)] {
        try {
            result.emplace(build());
        } catch (const std::bad_alloc&) {  // an exception must not leave the build thread
            result.emplace(Error{"model", "not enough memory to build it"});
        }
    });
    pending_.push_back(std::move(pending));
}

void PendingModels::drop(ClothId cloth) {
    const auto one = std::ranges::find(pending_, cloth, &Pending::cloth);
    if (one == pending_.end()) return;
    if (one->work->started() && !one->work->done()) dropped_.push_back(std::move(*one));
    pending_.erase(one);
}

bool PendingModels::contains(ClothId cloth) const {
    return std::ranges::find(pending_, cloth, &Pending::cloth) != pending_.end();
}

void PendingModels::start_next() {
    std::erase_if(dropped_, [](const Pending& one) { return one.work->done(); });
    if (!dropped_.empty()) return;
    for (Pending& one : pending_) {
        if (one.work->done()) continue;
        if (!one.work->started()) one.work->start();
        return;
    }
}

std::optional<PendingModels::Ready> PendingModels::take_due(std::uint64_t frame) {
    const auto due = std::ranges::find_if(pending_, [&](const Pending& one) { return one.due <= frame; });
    if (due == pending_.end()) return {};
    due->work->wait();
    Ready ready{due->cloth, std::move(**due->result)};
    pending_.erase(due);
    return ready;
}

}  // namespace weft
