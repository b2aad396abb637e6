// The editor's state at one moment: document, world, and which recorded frames lead to it.
#pragma once

#include "editor/core/document.h"
#include "weft/checkpoint.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace weft::editor {

/// A run of frames without a change in between. Frames after `after` belong to it, until the next branch begins.
struct Branch {
    std::uint64_t number = 0;
    std::uint64_t after = 0;
    friend bool operator==(const Branch&, const Branch&) = default;
};

/// The branches that lead to the present, by ascending `after`. A recorded frame is stale if it is of another branch.
using Lineage = std::vector<Branch>;

struct Moment {
    DocumentPtr document;  ///< may differ from that of `world` after a jump to an earlier frame
    Checkpoint world;
    Lineage lineage;
};
using MomentPtr = std::shared_ptr<const Moment>;

inline std::size_t size_of(const Moment& moment) {
    return weft::size_of(moment.world) + sizeof moment;
}

}  // namespace weft::editor
