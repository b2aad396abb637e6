// The log of a session on disk. Each action is written as soon as it was carried out, so that a session that ended in a
// crash can be played again.
#pragma once

#include "editor/core/stage.h"

#include <weft/result.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace weft::editor {

/// The first line of a log: what the session began with.
struct LogHead {
    DocumentPtr document;
    std::string backend = "cpu";
    std::uint32_t threads = 1;
    std::string note = {};  ///< for the user, such as the time of the session
};

struct Log {
    LogHead head;
    std::vector<TimedAction> actions;
    std::uint64_t end = 0;  ///< the frame that the session had reached, as far as the log says
    bool complete = false;  ///< the session ended by itself
};

/// Reads a log. A last line that was not written completely is left out. Errors name the file and the line.
Result<Log> read_log(const std::filesystem::path& file);

class ActionLog {
  public:
    /// Creates or replaces the file. Errors name it.
    static Result<ActionLog> create(const std::filesystem::path& file, const LogHead& head);

    /// Appends an action. The first failure is kept in problem(); later actions are not written.
    void add(const TimedAction& action);
    /// Marks the session as complete.
    void finish(std::uint64_t frame);
    const std::string& problem() const { return problem_; }
    const std::filesystem::path& file() const { return path_; }

  private:
    void write(const std::string& line);
    struct Closer {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Closer> file_;
    std::string problem_;
};

/// Opens what the session began with.
Result<Stage> open_stage(const LogHead& head, StageOptions options);
/// Carries out the actions, each at its frame, and goes on to `until`. `progress` is called before each frame and each
/// action with the number of actions done; if it returns false, the playback ends there. Fails at the first action that
/// fails; `where` of the error is its line.
Result<void> play(Stage& stage, const std::vector<TimedAction>& actions, std::uint64_t until,
                  const std::function<bool(std::size_t)>& progress = {});

/// Where logs are kept: $XDG_STATE_HOME/weft or ~/.local/state/weft; empty if neither is set.
std::filesystem::path log_folder();
/// A name for a new log in the folder: it holds the number of this process.
std::filesystem::path new_log_file(const std::filesystem::path& folder);
/// Logs in the folder whose session has not ended by itself and whose process is gone, newest first.
std::vector<std::filesystem::path> abandoned_logs(const std::filesystem::path& folder);

/// What a log is about, to choose among several.
struct LogSummary {
    std::filesystem::path file;  ///< of the log
    std::string scene;           ///< file of the scene; empty: it was not saved yet
    std::string time;            ///< when the session began: `2026-03-01 14:05`; empty: not known
    std::size_t actions = 0;
    std::uintmax_t bytes = 0;
};
/// Reads the first line and counts the others. Of a file that cannot be read, only the name is known.
LogSummary summary_of(const std::filesystem::path& file);

}  // namespace weft::editor
