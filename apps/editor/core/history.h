// Undo and redo. A step keeps the moment before it, so that undo brings back document and cloth to the bit.
#pragma once

#include "editor/core/moment.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace weft::editor {

/// One undo step.
struct Step {
    std::uint64_t number = 0;  ///< unique in the history
    std::string label;         ///< `Density of sheet`
    std::uint64_t frame = 0;   ///< at which it acted
    std::uint64_t gesture = 0;
    DocumentPtr before, after;
    MomentPtr moment;  ///< before the step; null: dropped to save memory, only the document comes back
};

/// The steps, oldest first. Moments beyond the memory budget are dropped, oldest first; the documents of their steps
/// stay.
class History {
  public:
    explicit History(std::size_t budget = std::size_t{512} << 20) : budget_(budget) {}

    /// Adds a step and forgets the undone ones. If `gesture` is not 0 and is that of the last step, the change joins
    /// this step, which keeps its moment, and `before` is not used.
    void add(std::string label, std::uint64_t frame, std::uint64_t gesture, MomentPtr before, DocumentPtr after);
    /// Whether a change with this gesture would join the last step.
    bool joins(std::uint64_t gesture) const;

    /// What to go back to.
    struct Return {
        DocumentPtr document;
        MomentPtr moment;  ///< null: only the document comes back
    };
    /// `now`: the present, to which redo() returns. Nothing if there is no step.
    std::optional<Return> undo(MomentPtr now);
    std::optional<Return> redo();

    const Step* find(std::uint64_t number) const;  ///< among the done ones
    const std::vector<Step>& done() const { return done_; }
    std::size_t undone() const { return undone_.size(); }
    /// Labels of the undone steps; the last one is redone first.
    std::vector<std::string> undone_labels() const;
    std::size_t bytes() const { return bytes_; }
    void set_budget(std::size_t bytes);

  private:
    struct Undone {
        Step step;
        MomentPtr after;  ///< the present when it was undone
    };
    void forget_undone();
    void keep_budget();
    void drop(MomentPtr& moment);

    std::size_t budget_, bytes_ = 0;
    std::uint64_t next_ = 1;
    std::vector<Step> done_;
    std::vector<Undone> undone_;
};

}  // namespace weft::editor
