#include "editor/core/stage.h"

#include "base/hash.h"
#include "io/meshes/mesh_file.h"

#include <weft/files.h>

#include <algorithm>
#include <utility>

namespace weft::editor {
namespace {

Options with_reader(Options options) {
    if (!options.read_mesh) options.read_mesh = read_mesh_file;
    return options;
}

Result<std::unique_ptr<SceneWorld>> make_world(const SceneDesc& scene, const Options& options,
                                               const std::filesystem::path& folder) {
    auto world = SceneWorld::create(scene, options, folder);
    if (!world) return world.errors();
    return std::make_unique<SceneWorld>(std::move(*world));
}

/// The list and the index in a place such as `/cloths/2`.
struct ObjectPlace {
    std::string list;
    std::size_t index = 0;
};
std::optional<ObjectPlace> object_at(const Document& document, const std::string& place) {
    const std::size_t slash = place.rfind('/');
    if (slash == std::string::npos || slash == 0 || !find(document.json, place)) return {};
    const std::string list = place.substr(1, slash - 1);
    if (list != "cloths" && list != "colliders") return {};
    return ObjectPlace{list, std::stoul(place.substr(slash + 1))};
}

/// The edits that give an object another name wherever the scene says it.
std::vector<Edit> rename_edits(const Document& document, const ObjectPlace& object, const std::string& place,
                               const std::string& name) {
    const Json& json = document.json;
    const std::string old = find(json, place)->value("name", "");
    std::vector<Edit> edits{{place + "/name", name}};
    const auto replace = [&](const std::string& where) {
        const Json* value = find(json, where);
        if (value && value->is_string() && *value == old) edits.push_back({where, name});
    };
    if (object.list == "colliders") {
        for (std::size_t i = 0; i < document.scene.cloths.size(); ++i)
            for (std::size_t k = 0; k < document.scene.cloths[i].pins.size(); ++k)
                replace("/cloths/" + std::to_string(i) + "/pins/" + std::to_string(k) + "/attach");
    } else {
        for (std::size_t i = 0; i < document.scene.stitches.size(); ++i)
            for (const char* side : {"/a/cloth", "/b/cloth"}) replace("/stitches/" + std::to_string(i) + side);
    }
    return edits;
}

bool lacks_particles(const Checkpoint& checkpoint) {
    const WorldMoment& moment = checkpoint.moment;
    for (std::size_t i = 0; i < moment.models.size() && i < moment.state.cloths.size(); ++i)
        if (moment.models[i]->particle_count > 0 && moment.state.cloths[i].position.empty()) return true;
    return false;
}

}  // namespace

Result<Stage> Stage::open(DocumentPtr document, StageOptions options) {
    options.simulation = with_reader(std::move(options.simulation));
    auto world = make_world(document->scene, options.simulation, document->folder);
    if (!world) return world.errors();
    Stage stage;
    stage.history_ = History(options.undo_memory);
    stage.timeline_ = Timeline(options.timeline);
    stage.options_ = std::move(options);
    stage.document_ = stage.followed_ = std::move(document);
    stage.world_ = std::move(*world);
    stage.begin_branch();
    stage.record();
    return stage;
}

Result<void> Stage::apply(const Action& action) {
    return std::visit([&](const auto& one) { return act(one); }, action);
}

Result<void> Stage::step() {
    if (auto followed = follow_document(); !followed) return followed;
    if (std::exchange(let_go_, false)) begin_branch();
    world_->advance();
    if (world_->world().summary().reports & report_device_failed) return recover();
    record();
    return {};
}

// --- Moments

MomentPtr Stage::moment() {
    const auto take = [&] { return std::make_shared<const Moment>(Moment{document_, world_->checkpoint(), lineage_}); };
    MomentPtr now = take();
    // A device that is lost while it is read gives no state back.
    if (lacks_particles(now->world) && recover()) now = take();
    return now;
}

Result<void> Stage::go_to(const Moment& moment) {
    if (auto gone = world_->go_to(moment.world); !gone) return gone;
    // The documents of world and stage are the same object unless a jump has parted them.
    followed_ = *moment.world.scene == moment.document->scene ? moment.document : nullptr;
    document_ = moment.document;
    lineage_ = moment.lineage;
    return {};
}

Result<void> Stage::go_back(const History::Return& back) {
    if (back.moment) return go_to(*back.moment);
    return follow(back.document);
}

void Stage::begin_branch() {
    const std::uint64_t now = world_ ? frame() : 0;
    std::erase_if(lineage_, [&](const Branch& branch) { return branch.after >= now && &branch != &lineage_.front(); });
    if (now == 0) lineage_.clear();
    lineage_.push_back({next_branch_++, now});
}

void Stage::record() {
    if (!options_.record) return;
    const MomentPtr now = moment();  // first: it may go back to an earlier frame
    timeline_.record(frame(), *now);
}

Result<void> Stage::follow(DocumentPtr next) {
    if (auto changed = world_->change_to(next->scene); !changed) return changed;
    begin_branch();
    document_ = followed_ = std::move(next);
    if (frame() == 0) record();
    return {};
}

Result<void> Stage::follow_document() {
    return follows_document() ? Result<void>() : follow(document_);
}

Result<void> Stage::as_step(const std::string& label, std::uint64_t gesture,
                            const std::function<Result<void>()>& change) {
    if (auto followed = follow_document(); !followed) return followed;
    MomentPtr before = history_.joins(gesture) ? nullptr : moment();
    const std::uint64_t at = frame();
    if (auto changed = change(); !changed) return changed;
    history_.add(label, at, gesture, std::move(before), document_);
    return {};
}

// --- Actions

Result<void> Stage::act(const ChangeScene& action) {
    auto next = edited(*document_, action.edits);
    if (!next) return next.errors();
    return as_step(action.label, action.gesture, [&] { return follow(std::move(*next)); });
}

Result<void> Stage::act(const Rename& action) {
    const auto object = object_at(*document_, action.place);
    if (!object) return Error{action.place, "is no cloth and no collider of this scene"};
    auto next = edited(*document_, rename_edits(*document_, *object, action.place, action.name));
    if (!next) return next.errors();
    return as_step("Rename to " + action.name, 0, [&]() -> Result<void> {
        if (auto renamed = world_->rename((*next)->scene); !renamed) return renamed;
        document_ = followed_ = *next;
        return {};
    });
}

Result<void> Stage::act(const Cut& action) {
    auto cloth = cloth_called(action.cloth);
    if (!cloth) return cloth.errors();
    if (action.points.size() < 2) return Error{"cut", "needs at least two points"};
    const CutDesc cut{.along = PathCut{action.points}};
    return as_step("Cut of " + action.cloth, 0, [&]() -> Result<void> {
        // Ids of cloths may have changed with the document.
        const auto id = cloth_called(action.cloth);
        const CutPositions on = action.at_start ? CutPositions::start : CutPositions::current;
        if (auto opened = world_->cut(*id, cut, on); !opened) return opened;
        begin_branch();
        return {};
    });
}

Result<void> Stage::act(const Reset&) {
    const MomentPtr before = moment();
    auto start = timeline_.moment_at(0);
    Result<void> gone;
    if (start) {
        gone = world_->go_to((*start)->world);
    } else if (auto world = make_world(document_->scene, options_.simulation, document_->folder)) {
        world_ = std::move(*world);
    } else {
        gone = world.errors();
    }
    if (!gone) return gone;
    let_go();
    const bool same = world_->scene() == document_->scene;
    followed_ = same ? document_ : nullptr;
    if (start && same)
        lineage_ = (*start)->lineage;
    else if (same)
        begin_branch();
    if (auto followed = follow_document(); !followed) {
        (void)go_to(*before);
        return followed;
    }
    history_.add("Reset", before->world.moment.state.frame, 0, before, document_);
    return {};
}

Result<void> Stage::act(const Seek& action) {
    auto then = timeline_.moment_at(action.frame);
    if (!then) return then.errors();
    const Lineage lineage = lineage_;
    const DocumentPtr document = document_;
    if (auto gone = go_to(**then); !gone) return gone;
    let_go();
    // The document stays as it is. The world follows it when the run goes on.
    document_ = document;
    followed_ = *(*then)->world.scene == document->scene ? document : nullptr;
    const auto valid = timeline_.valid(lineage);
    if (std::ranges::any_of(valid, [&](FrameRange r) { return r.first <= action.frame && action.frame <= r.last; }))
        lineage_ = lineage;
    return {};
}

Result<void> Stage::act(const Undo&) {
    if (history_.done().empty()) return Error{"undo", "there is nothing to undo"};
    auto gone = go_back(*history_.undo(moment()));
    let_go();
    return gone;
}

Result<void> Stage::act(const Redo&) {
    if (history_.undone() == 0) return Error{"redo", "there is nothing to redo"};
    auto gone = go_back(*history_.redo());
    let_go();
    return gone;
}

Result<void> Stage::act(const UndoSetting& action) {
    const Step* const step = history_.find(action.step);
    if (!step) return Error{"undo", "there is no step " + std::to_string(action.step)};
    const std::vector<Edit> back = difference(step->after->json, step->before->json);
    if (back.empty()) return Error{"undo", "\"" + step->label + "\" has not changed a setting"};
    auto next = edited(*document_, back);
    if (!next) return next.errors();
    return as_step("Undo of " + step->label, 0, [&] { return follow(std::move(*next)); });
}

Result<void> Stage::act(const UseBackend& action) {
    Options options = options_.simulation;
    options.backend = action.backend;
    options.threads = std::max(1u, action.threads);
    if (action.backend == "cpu") options.device.clear();
    return move_to(options, world_->checkpoint());
}

Result<void> Stage::act(const Advance& action) {
    for (std::uint64_t i = 0; i < action.frames; ++i)
        if (auto stepped = step(); !stepped) return stepped;
    return {};
}

// --- Backends

// The new world gets all objects from the checkpoint, with their models.
Result<void> Stage::move_to(const Options& options, const Checkpoint& state) {
    SceneDesc empty = *state.scene;
    empty.cloths.clear(), empty.colliders.clear(), empty.stitches.clear();
    auto world = make_world(empty, options, document_->folder);
    if (!world) return world.errors();
    if (auto gone = (*world)->go_to(state); !gone) return gone;
    world_ = std::move(*world);
    options_.simulation = options;
    notes_taken_ = 0;
    return {};
}

Result<void> Stage::recover() {
    const Frame& failed = world_->world().summary();
    std::string why = "the device failed";
    for (const ClothFrame& cloth : failed.cloths)
        if (!cloth.detail.empty()) why = cloth.detail;
    std::uint64_t last = frame();
    while (last > 0 && !timeline_.contains(last)) --last;
    auto then = timeline_.moment_at(last);
    Options options = options_.simulation;
    options.backend = "cpu";
    options.device.clear();
    if (!then || lacks_particles((*then)->world)) {
        // It was lost before a frame was kept.
        auto world = make_world(document_->scene, options, document_->folder);
        if (!world) return world.errors();
        world_ = std::move(*world);
        options_.simulation = options;
        notes_taken_ = 0;
        followed_ = document_;
        if (last > 0) begin_branch();
        let_go();
        notes_.push_back(why + "; the CPU begins again at frame 0");
        return {};
    }
    if (auto moved = move_to(options, (*then)->world); !moved) return moved;
    followed_ = *(*then)->world.scene == document_->scene ? document_ : nullptr;
    let_go();
    notes_.push_back(why + "; the CPU goes on from frame " + std::to_string(last));
    return {};
}

// --- Rest

Result<ClothId> Stage::cloth_called(const std::string& name) const {
    const auto& cloths = world_->scene().cloths;
    const auto found = std::ranges::find(cloths, name, &SceneCloth::name);
    if (found == cloths.end()) return Error{"cloth '" + name + "'", "is not in this scene"};
    return world_->world().cloth_id(static_cast<std::size_t>(found - cloths.begin()));
}

std::string Stage::hash() {
    StateHash hash;
    for (const char letter : document_->json.dump()) hash.add(static_cast<std::uint32_t>(letter));
    return world_->world().state_hash() + hash.text() + std::to_string(frame());
}

std::vector<std::string> Stage::take_notes() {
    std::vector<std::string> notes = std::exchange(notes_, {});
    const auto& all = world_->notes();
    for (; notes_taken_ < all.size(); ++notes_taken_) notes.push_back(all[notes_taken_]);
    return notes;
}

Result<void> Stage::act(const Saved& action) {
    FileTextPtr text = make_file_text(action.text);
    if (!text) return Error{"text", "is not JSON"};
    saved_ = SavedFile{action.file, text, document_->json};
    const DocumentPtr saved = saved_in(*document_, action.file, std::move(text));
    if (followed_ == document_) followed_ = saved;
    document_ = saved;
    return {};
}

}  // namespace weft::editor
