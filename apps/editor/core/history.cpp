#include "editor/core/history.h"

#include <algorithm>
#include <utility>

namespace weft::editor {

bool History::joins(std::uint64_t gesture) const {
    return gesture != 0 && undone_.empty() && !done_.empty() && done_.back().gesture == gesture;
}

void History::add(std::string label, std::uint64_t frame, std::uint64_t gesture, MomentPtr before, DocumentPtr after) {
    if (joins(gesture)) {
        done_.back().after = std::move(after);
        return;
    }
    forget_undone();
    bytes_ += size_of(*before);
    const DocumentPtr document = before->document;
    done_.push_back({next_++, std::move(label), frame, gesture, document, std::move(after), std::move(before)});
    keep_budget();
}

std::optional<History::Return> History::undo(MomentPtr now) {
    if (done_.empty()) return {};
    Step step = std::move(done_.back());
    done_.pop_back();
    step.gesture = 0;  // a later change with this gesture is a new step
    Return back{step.before, step.moment};
    bytes_ += size_of(*now);
    undone_.push_back({std::move(step), std::move(now)});
    keep_budget();
    return back;
}

std::optional<History::Return> History::redo() {
    if (undone_.empty()) return {};
    Undone one = std::move(undone_.back());
    undone_.pop_back();
    Return back{one.after ? one.after->document : one.step.after, one.after};
    if (one.after) bytes_ -= size_of(*one.after);
    done_.push_back(std::move(one.step));
    return back;
}

const Step* History::find(std::uint64_t number) const {
    const auto found = std::ranges::find(done_, number, &Step::number);
    return found == done_.end() ? nullptr : &*found;
}

std::vector<std::string> History::undone_labels() const {
    std::vector<std::string> labels;
    for (const Undone& one : undone_) labels.push_back(one.step.label);
    return labels;
}

void History::set_budget(std::size_t bytes) {
    budget_ = bytes;
    keep_budget();
}

void History::forget_undone() {
    for (Undone& one : undone_) drop(one.after), drop(one.step.moment);
    undone_.clear();
}

// The newest moment stays in any case: it is that of the change that was just made.
void History::keep_budget() {
    for (std::size_t i = 0; i + 1 < done_.size() && bytes_ > budget_; ++i) drop(done_[i].moment);
    for (std::size_t i = 0; i + 1 < undone_.size() && bytes_ > budget_; ++i) drop(undone_[i].after);
}

void History::drop(MomentPtr& moment) {
    if (moment) bytes_ -= size_of(*moment);
    moment.reset();
}

}  // namespace weft::editor
