// Runs another program: feeds it through its standard input, or follows what it prints while it works.
#pragma once

#include <weft/result.h>

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft {

struct ChildOptions {
    std::string where;         ///< for errors: what the program makes
    std::string package = {};  ///< the Debian package of the program; empty: it is not in one
    int output = -1;           ///< passed as the program's descriptor 3; -1: none
    /// Variables that are added to those of this process, or replace them.
    std::map<std::string, std::string> environment = {};
    bool prints = false;  ///< its standard output counts among its messages; else it is dropped
};

/// Never raises SIGPIPE, never deadlocks with a program that waits for its messages to be read, and leaves no process
/// behind: destroyed before finish(), it ends the program. The program has its own process group, so that signals of
/// the terminal (Ctrl-C) do not reach it.
class ChildProcess {
  public:
    /// `arguments` begin with the program's name, which is searched on PATH. Fails if it is not found.
    static Result<ChildProcess> start(const std::vector<std::string>& arguments, const ChildOptions& options);

    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    ~ChildProcess();

    /// If the program does not read any more, fails with its messages.
    Result<void> write(std::span<const std::byte> bytes);
    /// Closes the input and waits for the end. Fails unless the program exits with success.
    Result<void> finish();
    /// Reads what it has printed so far. Returns whether it still runs. Never waits.
    bool running();
    /// The last 2000 bytes or so of what it has printed.
    const std::string& messages() const { return said_; }
    /// Asks it to end (SIGTERM), and forces it to if it still runs after `patience`.
    void end(std::chrono::milliseconds patience);
    /// After its end: whether it has exited with success.
    bool succeeded() const { return process_ < 0 && status_ == 0; }
    /// An error with `what` and the last messages of the program.
    Error failure(const std::string& what) const;

  private:
    ChildProcess() = default;
    void listen();
    bool wait(std::optional<std::chrono::milliseconds> limit);
    void kill();
    void close_all();

    std::string program_, where_;
    pid_t process_ = -1;  // -1: ended
    int input_ = -1, messages_ = -1;
    int status_ = 0;
    std::string said_;  // the end of its messages
};

}  // namespace weft
