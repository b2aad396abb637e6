#include "editor/app/session.h"

#include <algorithm>
#include <utility>

namespace weft::editor {
namespace {

constexpr std::size_t most_messages = 6;

/// The name of the object at a place such as `/cloths/0`; empty if it is no cloth and no collider.
std::string name_at(const Document& document, const std::string& place) {
    if (!place.starts_with("/cloths/") && !place.starts_with("/colliders/")) return {};
    const Json* object = find(document.json, place);
    return object && object->is_object() ? object->value("name", "") : "";
}

std::string list_of(const std::string& place) {
    return place.substr(0, place.rfind('/'));
}

}  // namespace

Session::Session(Simulator& simulator) : simulator_(simulator), published_(simulator.newest()) {
    document_ = published_->document;
    file_ = document_->file;
    saved_ = document_->json;
}

void Session::begin_frame(double now) {
    now_ = now;
    const PublishedPtr newest = simulator_.newest();
    if (newest != published_) {
        const bool same = newest->document == published_->document;
        published_ = newest;
        const std::size_t waiting = pending_.size();
        while (!pending_.empty() && pending_.front().number <= published_->acknowledged) pending_.pop_front();
        if (!same || waiting != pending_.size()) rebuild();
    }
    for (Failure& failure : simulator_.take_failures()) say(failure.what, failure.errors);
    for (const std::string& note : simulator_.take_notes()) say(note);
}

// The published document with the changes that the simulator has still to carry out. One that it will refuse, because
// the document has changed meanwhile, is left out.
void Session::rebuild() {
    const DocumentPtr before = document_;
    document_ = published_->document;
    for (const Pending& pending : pending_)
        if (auto next = edited(*document_, pending.edits)) document_ = *next;
    keep_file();
    keep_selection(*before);
}

// Documents from before the last save, which undo brings back, know only an older text of the file.
void Session::keep_file() {
    if (file_text_ && document_->original != file_text_) document_ = saved_in(*document_, file_, file_text_);
}

void Session::change(const std::string& label, std::vector<Edit> edits, Change phase) {
    if (phase == Change::none) return;
    if (phase == Change::cancelled) {
        if (std::exchange(gesture_posted_, false)) undo();
        gesture_ = 0;
        return;
    }
    if (gesture_ == 0 || gesture_label_ != label) {
        gesture_ = next_gesture_++;
        gesture_label_ = label;
        gesture_posted_ = false;
    }
    auto next = edited(*document_, edits);
    if (!next) {
        if (phase == Change::finished) say(label, next.errors());
    } else if ((*next)->json != document_->json) {
        ChangeScene action{.label = label, .edits = edits, .gesture = gesture_};
        posted_ = simulator_.post(std::move(action));
        pending_.push_back({posted_, std::move(edits)});
        gesture_posted_ = true;
        const DocumentPtr before = std::exchange(document_, *next);
        keep_selection(*before);
    }
    if (phase == Change::finished) gesture_ = 0, gesture_posted_ = false;
}

void Session::post(Action action) {
    std::vector<Edit> edits;
    const auto* rename = std::get_if<Rename>(&action);
    if (rename) edits = {{rename->place + "/name", rename->name}};
    posted_ = simulator_.post(std::move(action));
    if (rename) pending_.push_back({posted_, std::move(edits)});
}

void Session::select(std::string place) {
    selected_ = std::move(place);
}

std::string Session::selected_name() const {
    return name_at(*document_, selected_);
}

// Cloths and colliders are followed by their names, because their indices change.
void Session::keep_selection(const Document& before) {
    if (selected_.empty()) return;
    const std::string name = name_at(before, selected_);
    if (name.empty()) {
        if (selected_.find('/', 1) != std::string::npos && !find(document_->json, selected_)) selected_.clear();
        return;
    }
    const std::string list = list_of(selected_);
    const Json* all = find(document_->json, list);
    for (std::size_t i = 0; all && i < all->size(); ++i) {
        if ((*all)[i].value("name", "") != name) continue;
        selected_ = list + "/" + std::to_string(i);
        return;
    }
    // Renamed, or gone.
    const std::string now = name_at(*document_, selected_);
    const Json* old = find(before.json, list);
    if (now.empty() || !old || !all || old->size() != all->size()) selected_.clear();
}

void Session::say(Message message) {
    message.since = now_;
    const auto same = std::ranges::find_if(
        messages_, [&](const Message& one) { return one.title == message.title && one.lines == message.lines; });
    if (same != messages_.end()) messages_.erase(same);
    messages_.push_back(std::move(message));
    if (messages_.size() > most_messages) messages_.erase(messages_.begin());
}

void Session::say(const std::string& title, const Errors& errors) {
    Message message{.is_error = true, .title = title, .lines = {}};
    for (const Error& error : errors) message.lines.push_back(error.where == title ? error.what : error.message());
    say(std::move(message));
}

void Session::say(const std::string& note) {
    say(Message{.is_error = false, .title = {}, .lines = {note}});
}

bool Session::has_changes() const {
    return document_->json != saved_;
}

void Session::mark_saved(const std::filesystem::path& file, FileTextPtr text) {
    mark_saved(file, std::move(text), document_->json);
}

void Session::mark_saved(const std::filesystem::path& file, FileTextPtr text, Json scene) {
    saved_ = std::move(scene);
    file_ = file;
    file_text_ = std::move(text);
    keep_file();
}

std::string place_after_append(const Document& document, const std::string& list) {
    const Json* all = find(document.json, list);
    return list + "/" + std::to_string(all && all->is_array() ? all->size() : 0);
}

std::string free_name(const Document& document, const std::string& wanted) {
    const auto taken = [&](const std::string& name) {
        return std::ranges::any_of(document.scene.cloths, [&](const auto& one) { return one.name == name; }) ||
               std::ranges::any_of(document.scene.colliders, [&](const auto& one) { return one.name == name; });
    };
    std::string name = wanted;
    for (int i = 2; taken(name); ++i) name = wanted + " " + std::to_string(i);
    return name;
}

}  // namespace weft::editor
