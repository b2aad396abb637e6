#include "editor/core/simulator.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace weft::editor {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_now() {
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

constexpr double most_lag = 0.05;          // s: a run that is later than this does not catch up
constexpr double smoothing = 0.1;          // of the step time
constexpr double measure_interval = 0.25;  // s
constexpr double progress_window = 1.0;    // s

/// Whether the second command makes the first one needless: only the last place of the pointer, and the last value of
/// a slider, counts.
bool replaces(const Action& later, const Action& earlier) {
    if (std::holds_alternative<MoveGrab>(later)) return std::holds_alternative<MoveGrab>(earlier);
    const auto* a = std::get_if<ChangeScene>(&earlier);
    const auto* b = std::get_if<ChangeScene>(&later);
    if (!a || !b || a->gesture == 0 || a->gesture != b->gesture || a->edits.size() != b->edits.size()) return false;
    return std::ranges::equal(a->edits, b->edits, [](const Edit& x, const Edit& y) {
        return x.place == y.place && !x.place.ends_with("/-") && x.value && y.value;
    });
}

}  // namespace

Simulator::Simulator(Stage stage, Hooks hooks, std::optional<ActionLog> log)
    : stage_(std::move(stage)), hooks_(std::move(hooks)), log_(std::move(log)) {
    publish();
    thread_ = std::thread([this] { loop(); });
}

Simulator::~Simulator() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
    if (log_) log_->finish(stage_.frame());
}

std::uint64_t Simulator::post(Action action) {
    const std::lock_guard lock(mutex_);
    const std::uint64_t number = next_number_++;
    if (!commands_.empty() && commands_.back().action && replaces(action, *commands_.back().action))
        commands_.pop_back();
    commands_.push_back({number, std::move(action), {}});
    changed_.notify_all();
    return number;
}

void Simulator::run(std::function<void(Stage&)> task) {
    const std::lock_guard lock(mutex_);
    commands_.push_back({next_number_++, {}, std::move(task)});
    changed_.notify_all();
}

void Simulator::look(std::function<void(const Stage&)> task) {
    const std::lock_guard lock(mutex_);
    commands_.push_back({next_number_++, {}, std::move(task), false});
    changed_.notify_all();
}

void Simulator::play(bool on) {
    const std::lock_guard lock(mutex_);
    playing_ = on;
    asked_ = true;
    changed_.notify_all();
}

void Simulator::set_speed(double speed) {
    const std::lock_guard lock(mutex_);
    speed_ = std::max(0.0, speed);
    asked_ = true;
    changed_.notify_all();
}

PublishedPtr Simulator::newest() const {
    const std::lock_guard lock(mutex_);
    return newest_;
}

std::vector<Failure> Simulator::take_failures() {
    const std::lock_guard lock(mutex_);
    return std::exchange(failures_, {});
}

std::vector<std::string> Simulator::take_notes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notes_, {});
}

void Simulator::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return commands_.empty() && !asked_ && !working_; });
}

void Simulator::loop() {
    double due = seconds_now();
    while (true) {
        std::deque<Command> commands;
        bool playing = false, asked = false;
        double speed = 1;
        {
            std::unique_lock lock(mutex_);
            const auto has_work = [&] { return stop_ || !commands_.empty() || asked_; };
            if (!playing_)
                changed_.wait(lock, [&] { return has_work() || playing_; });
            else if (speed_ > 0 && due > seconds_now() && !has_work())
                changed_.wait_for(lock, std::chrono::duration<double>(due - seconds_now()), has_work);
            if (stop_ && commands_.empty()) return;
            commands = std::exchange(commands_, {});
            asked = std::exchange(asked_, false);
            working_ = true;
            playing = playing_ && !stop_;
            speed = speed_;
        }
        bool changed = carry_out(std::move(commands)) || asked;
        const double now = seconds_now();
        if (playing && (speed == 0 || now >= due)) {
            step();
            changed = true;
            const double frame_seconds = stage_.world().frame_seconds() / std::max(speed, 1e-3);
            due = now - due > most_lag ? now : due + frame_seconds;
        }
        if (changed) publish();
        const std::lock_guard lock(mutex_);
        working_ = false;
        changed_.notify_all();
    }
}

bool Simulator::carry_out(std::deque<Command> commands) {
    for (const Command& command : commands) carry_out(command);
    return std::ranges::any_of(commands, &Command::changes);
}

void Simulator::carry_out(const Command& command) {
    Errors errors;
    const std::uint64_t at = stage_.frame();
    try {
        if (command.task) command.task(stage_);
        if (command.action) {
            if (auto done = stage_.apply(*command.action); !done) errors = done.errors();
        }
    } catch (const std::exception& error) {
        errors = {Error::of_machine("", error.what())};
    }
    acknowledged_ = command.number;
    if (command.action && errors.empty() && log_) log_->add({at, *command.action});
    if (errors.empty()) return;
    const auto* change = std::get_if<ChangeScene>(&*command.action);
    const std::lock_guard lock(mutex_);
    failures_.push_back(
        {command.number, change ? change->label : std::string(kind_of(*command.action)), std::move(errors)});
}

void Simulator::stop_playing() {
    const std::lock_guard lock(mutex_);
    playing_ = false;
}

void Simulator::step() {
    Errors errors;
    try {
        if (auto stepped = stage_.step(); !stepped) errors = stepped.errors();
    } catch (const std::exception& error) {
        errors = {Error::of_machine("", error.what())};
    }
    const Frame& frame = stage_.world().world().summary();
    step_ms_ = step_ms_ == 0 ? frame.step_ms : step_ms_ + smoothing * (frame.step_ms - step_ms_);
    // A cloth that diverges would fail in each further frame.
    if (frame.reports & report_non_finite) {
        std::string cause = "a value that is not finite";
        std::string name;
        for (const ClothFrame& cloth : frame.cloths) {
            if (!(cloth.reports & report_non_finite)) continue;
            name = cloth.model->name;
            if (!cloth.detail.empty()) cause = cloth.detail;
        }
        errors.push_back({"cloth '" + name + "'", "has diverged (" + cause + ") and was set back to the frame before"});
    }
    if (errors.empty()) return;
    stop_playing();
    const std::lock_guard lock(mutex_);
    failures_.push_back({0, "simulation", std::move(errors)});
}

void Simulator::publish() {
    auto next = std::make_shared<Published>();
    World& world = stage_.world().world();
    const Frame& frame = world.summary();
    next->serial = ++serial_;
    next->acknowledged = acknowledged_;
    next->frame = frame.index;
    next->time = frame.time;
    next->document = stage_.document();
    if (hooks_.observe) next->picture = hooks_.observe(stage_);
    for (const Step& step : stage_.history().done())
        next->done.push_back({step.number, step.frame, step.label, step.moment != nullptr});
    next->undone = stage_.history().undone_labels();
    next->undo_bytes = stage_.history().bytes();
    next->valid = stage_.timeline().valid(stage_.lineage());
    next->stale = stage_.timeline().stale(stage_.lineage());
    next->last_recorded = stage_.timeline().last();
    next->memory_bytes = stage_.timeline().bytes_in_memory();
    next->disk_bytes = stage_.timeline().bytes_on_disk();
    next->backend = world.backend().name();
    next->device = world.backend().device();
    next->threads = world.backend().threads();
    for (std::size_t i = 0; i < world.cloth_count(); ++i)
        next->particles += world.model(world.cloth_id(i))->particle_count;
    next->step_ms = step_ms_;
    next->stage_ms = frame.stage_ms;
    next->reports = report_names(frame.reports);
    next->grabs = stage_.grabs();
    // Measuring takes as long as a substep.
    if (seconds_now() - measured_at_ > measure_interval) {
        const ClothMeasures measures = world.measure();
        mean_stretch_ = measures.strain.stretch.mean;
        mean_residual_ = measures.residual.mean;
        measured_at_ = seconds_now();
    }
    next->mean_stretch = mean_stretch_;
    next->mean_residual = mean_residual_;
    progress_.emplace_back(seconds_now(), frame.time);
    while (progress_.back().first - progress_.front().first > progress_window) progress_.pop_front();
    const double clock = progress_.back().first - progress_.front().first;
    next->real_time_factor = clock > 0 ? (progress_.back().second - progress_.front().second) / clock : 0;
    std::vector<std::string> notes = stage_.take_notes();
    if (log_ && !log_->problem().empty()) {
        notes.push_back("the log of this session " + log_->problem() + "; it is not continued");
        log_.reset();
    }
    {
        const std::lock_guard lock(mutex_);
        next->playing = playing_;
        next->speed = speed_;
        newest_ = std::move(next);
        notes_.insert(notes_.end(), std::make_move_iterator(notes.begin()), std::make_move_iterator(notes.end()));
    }
    if (hooks_.wake) hooks_.wake();
}

}  // namespace weft::editor
