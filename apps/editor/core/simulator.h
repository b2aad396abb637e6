// A thread that simulates. It carries out actions between two frames. Other threads post them and do not wait.
#pragma once

#include "editor/core/action_log.h"
#include "editor/core/stage.h"
#include "solver/plan/pass.h"

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace weft::editor {

/// A step of the history, as the user sees it.
struct StepLabel {
    std::uint64_t number = 0, frame = 0;
    std::string label;
    bool cloth_returns = true;  ///< false: only the document comes back, because the moment was dropped
};

/// What the simulating thread tells about the present. Immutable.
struct Published {
    std::uint64_t serial = 0;        ///< of this value
    std::uint64_t acknowledged = 0;  ///< number of the last action that was carried out or refused
    bool playing = false;
    double speed = 1;  ///< simulated seconds per second; 0: as fast as possible
    std::uint64_t frame = 0;
    double time = 0;  ///< s
    DocumentPtr document;
    std::shared_ptr<const void> picture;  ///< result of Observe

    std::vector<StepLabel> done;
    std::vector<std::string> undone;
    std::size_t undo_bytes = 0;
    std::vector<FrameRange> valid, stale;
    std::uint64_t last_recorded = 0;
    std::size_t memory_bytes = 0, disk_bytes = 0;

    std::string backend, device;
    std::uint32_t threads = 1;
    std::uint64_t particles = 0;
    double step_ms = 0;           ///< of one frame, smoothed
    double real_time_factor = 0;  ///< simulated time per clock time in the last second
    std::array<double, stage_count> stage_ms{};
    std::vector<std::string_view> reports;  ///< of the last frame
    bool grabs = false;
    /// Of all cloths, measured a few times per second: |ℓ/ℓ₀ − 1| along warp and weft, and the part of it that the
    /// solver has left unsolved.
    double mean_stretch = 0, mean_residual = 0;
};
using PublishedPtr = std::shared_ptr<const Published>;

/// An action that could not be carried out.
struct Failure {
    std::uint64_t number = 0;
    std::string what;  ///< its kind or label
    Errors errors;
};

class Simulator {
  public:
    /// Copies what the view draws. Called on the simulating thread after each frame and action.
    using Observe = std::function<std::shared_ptr<const void>(Stage& stage)>;
    struct Hooks {
        Observe observe = {};
        std::function<void()> wake = {};  ///< called on the simulating thread when something was published
    };

    /// `log`: each action that was carried out is written there.
    Simulator(Stage stage, Hooks hooks, std::optional<ActionLog> log = {});
    ~Simulator();
    Simulator(const Simulator&) = delete;
    Simulator& operator=(const Simulator&) = delete;

    // From any thread. None of these waits for a frame.

    /// Returns the number of the action (Published::acknowledged).
    std::uint64_t post(Action action);
    void play(bool on);
    void set_speed(double speed);
    /// Runs `task` between two frames. The stage is valid only during the call.
    void run(std::function<void(Stage&)> task);
    /// The same for a task that changes nothing: nothing is published after it.
    void look(std::function<void(const Stage&)> task);

    PublishedPtr newest() const;
    std::vector<Failure> take_failures();
    std::vector<std::string> take_notes();

    /// Waits until all that was posted is done, for tests and for the end of the program.
    void finish();

  private:
    struct Command {
        std::uint64_t number = 0;
        std::optional<Action> action = {};
        std::function<void(Stage&)> task = {};
        bool changes = true;
    };
    void loop();
    bool carry_out(std::deque<Command> commands);
    void carry_out(const Command& command);
    void step();
    void publish();
    void stop_playing();

    Stage stage_;
    Hooks hooks_;
    std::optional<ActionLog> log_;

    mutable std::mutex mutex_;  // guards what follows
    std::condition_variable changed_;
    std::deque<Command> commands_;
    std::uint64_t next_number_ = 1;
    bool playing_ = false, stop_ = false;
    bool asked_ = false;    ///< playing or speed changed and was not published yet
    bool working_ = false;  ///< the thread carries out what it has taken
    double speed_ = 1;
    PublishedPtr newest_;
    std::vector<Failure> failures_;
    std::vector<std::string> notes_;

    // Of the simulating thread.
    std::uint64_t serial_ = 0, acknowledged_ = 0;
    double step_ms_ = 0;
    double measured_at_ = -1;  ///< s
    double mean_stretch_ = 0, mean_residual_ = 0;
    std::deque<std::pair<double, double>> progress_;  ///< clock time and simulated time of the last second
    std::thread thread_;                              // last member
};

}  // namespace weft::editor
