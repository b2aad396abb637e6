#include "editor/core/action_log.h"

#include "io/files/atomic_file.h"
#include "io/files/buffered_file.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <system_error>
#include <utility>

namespace weft::editor {
namespace {

constexpr std::uint32_t log_format = 1;
constexpr const char* log_ending = ".weftlog";

Error at_line(const std::filesystem::path& file, std::size_t line, const Error& error) {
    return {file.string() + ":" + std::to_string(line), (error.where.empty() ? "" : error.where + ": ") + error.what};
}

Result<LogHead> read_head(const Json& json) {
    if (!json.is_object() || json.value("weft_log", 0u) != log_format)
        return Error{"", "is not a log of the editor: its first line must have \"weft_log\": 1"};
    const std::string file = json.value("file", ""), folder = json.value("folder", "");
    FileTextPtr original = make_file_text(json.value("text", ""));
    // The scene has the names that objects of the file got when it was opened.
    std::map<std::string, bool> given;
    if (original)
        if (const auto opened = make_document(original->json, file, folder)) given = (*opened)->given_names;
    auto document = make_document(json.value("scene", Json()), file, folder, std::move(original), std::move(given));
    if (!document) return document.errors();
    return LogHead{std::move(*document), json.value("backend", "cpu"), json.value("threads", 1u),
                   json.value("note", "")};
}

/// The number of the process in a log's name; 0 if it has none.
int process_of(const std::filesystem::path& file) {
    const std::string name = file.stem().string();
    const std::size_t dash = name.rfind('-');
    return dash == std::string::npos ? 0 : std::atoi(name.c_str() + dash + 1);
}

bool ended(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string last;
    for (std::string line; std::getline(in, line);)
        if (!line.empty()) last = line;
    return last.find("\"end\"") != std::string::npos && last.starts_with("{\"end\"");
}

}  // namespace

Result<Log> read_log(const std::filesystem::path& file) {
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) return Error{file.string(), "cannot be opened: " + system_reason(errno)};
    Log log;
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        const bool whole = !in.eof();  // the last line of a crashed session may lack its end
        if (line.empty()) continue;
        const Json json = Json::parse(line, nullptr, false);
        if (json.is_discarded()) {
            if (!whole) break;
            return Error{file.string() + ":" + std::to_string(number), "is not JSON"};
        }
        try {
            if (number == 1) {
                auto head = read_head(json);
                if (!head) return at_line(file, number, head.error());
                log.head = std::move(*head);
            } else if (json.is_object() && json.contains("end")) {
                log.end = json["end"].get<std::uint64_t>();
                log.complete = true;
            } else {
                auto action = action_from(json);
                if (!action) return at_line(file, number, action.error());
                log.actions.push_back({action->first.value_or(log.end), std::move(action->second)});
                log.end = log.actions.back().at;
            }
        } catch (const Json::exception&) {
            return Error{file.string() + ":" + std::to_string(number), "has a value of a wrong type"};
        }
    }
    if (!log.head.document) return Error{file.string(), "is empty"};
    return log;
}

Result<ActionLog> ActionLog::create(const std::filesystem::path& file, const LogHead& head) {
    if (auto made = make_folder_of(file); !made) return made.errors();
    ActionLog log;
    log.path_ = file;
    errno = 0;
    log.file_.reset(std::fopen(file.c_str(), "wb"));
    if (!log.file_) return Error::of_machine(file.string(), "cannot be written: " + system_reason(errno));
    const auto& folder = head.document->folder;
    const FileTextPtr& original = head.document->original;
    const Json json{{"weft_log", log_format},
                    {"text", original ? original->text : ""},
                    {"file", head.document->file.string()},
                    {"folder", folder.empty() ? "" : std::filesystem::absolute(folder).string()},
                    {"backend", head.backend},
                    {"threads", head.threads},
                    {"note", head.note},
                    {"scene", head.document->json}};
    log.write(json.dump(-1, ' ', false, Json::error_handler_t::replace));
    if (!log.problem_.empty()) return Error::of_machine(file.string(), log.problem_);
    return log;
}

void ActionLog::add(const TimedAction& action) {
    write(to_line(action));
}

void ActionLog::finish(std::uint64_t frame) {
    write(Json{{"end", frame}}.dump());
}

void ActionLog::write(const std::string& line) {
    if (!file_ || !problem_.empty()) return;
    errno = 0;
    const bool written = std::fputs(line.c_str(), file_.get()) >= 0 && std::fputc('\n', file_.get()) != EOF &&
                         std::fflush(file_.get()) == 0;
    if (!written) problem_ = "cannot be written: " + system_reason(errno);
}

Result<Stage> open_stage(const LogHead& head, StageOptions options) {
    options.simulation.backend = head.backend;
    options.simulation.threads = std::max(1u, head.threads);
    return Stage::open(head.document, std::move(options));
}

Result<void> play(Stage& stage, const std::vector<TimedAction>& actions, std::uint64_t until,
                  const std::function<bool(std::size_t)>& progress) {
    const auto advance_to = [&](std::uint64_t frame, std::size_t done) -> Result<bool> {
        while (stage.frame() < frame) {
            if (progress && !progress(done)) return false;
            if (auto stepped = stage.step(); !stepped) return stepped.errors();
        }
        return true;
    };
    for (std::size_t i = 0; i < actions.size(); ++i) {
        auto there = advance_to(actions[i].at, i);
        if (!there) return there.errors();
        if (!*there || (progress && !progress(i))) return {};
        if (auto done = stage.apply(actions[i].action); !done) {
            Errors errors = done.errors();
            for (Error& error : errors)
                error.where = "action " + std::to_string(i + 1) + " (" + std::string(kind_of(actions[i].action)) +
                              "): " + error.where;
            return errors;
        }
    }
    auto there = advance_to(until, actions.size());
    return there ? Result<void>() : Result<void>(there.errors());
}

std::filesystem::path log_folder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::filesystem::path(value ? value : "");
    };
    if (const auto state = variable("XDG_STATE_HOME"); !state.empty()) return state / "weft";
    const auto home = variable("HOME");
    return home.empty() ? std::filesystem::path() : home / ".local" / "state" / "weft";
}

std::filesystem::path new_log_file(const std::filesystem::path& folder) {
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return folder / ("session-" + std::to_string(now) + "-" + std::to_string(::getpid()) + log_ending);
}

LogSummary summary_of(const std::filesystem::path& file) {
    LogSummary summary;
    summary.file = file;
    std::error_code ignored;
    summary.bytes = std::filesystem::file_size(file, ignored);
    const std::string name = file.stem().string();  // session-SECONDS-PROCESS
    const std::time_t seconds = std::atoll(name.c_str() + std::min(name.size(), name.find('-') + 1));
    char text[32];
    if (std::tm local{};
        seconds > 0 && localtime_r(&seconds, &local) && std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local) > 0)
        summary.time = text;
    std::ifstream in(file, std::ios::binary);
    std::string line;
    if (!std::getline(in, line)) return summary;
    const Json head = Json::parse(line, nullptr, false);
    if (head.is_object()) summary.scene = head.value("file", "");
    while (std::getline(in, line)) ++summary.actions;
    return summary;
}

std::vector<std::filesystem::path> abandoned_logs(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> logs;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
        if (entry.path().extension() != log_ending) continue;
        const int process = process_of(entry.path());
        const bool runs = process > 0 && (::kill(process, 0) == 0 || errno == EPERM);
        if (!runs && !ended(entry.path())) logs.push_back(entry.path());
    }
    std::ranges::sort(logs, std::ranges::greater());
    return logs;
}

}  // namespace weft::editor
