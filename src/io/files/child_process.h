// Another program at work, fed through its standard input.
#pragma once

#include <weft/result.h>

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft {

struct ChildOptions {
    std::string where;    ///< of errors: what the program is to make
    std::string package;  ///< Debian's that has the program
    int output = -1;      ///< becomes the program's descriptor 3; -1: none
};

/// Never raises SIGPIPE, never waits for a program that waits itself, and leaves no process behind: destroyed before
/// finish(), it ends the program. The program is in a process group of its own, so that what a terminal sends to this
/// one (Ctrl-C) does not reach it.
class ChildProcess {
  public:
    /// `arguments` begin with the program's name, which is looked for on PATH. Fails where it is not there.
    static Result<ChildProcess> start(const std::vector<std::string>& arguments, const ChildOptions& options);

    ChildProcess(ChildProcess&& other) noexcept;
    ChildProcess& operator=(ChildProcess&& other) noexcept;
    ~ChildProcess();

    /// Fails with what the program said if it reads no more.
    Result<Done> write(std::span<const std::byte> bytes);
    /// No more input: waits for its end. Fails unless it says that all went well.
    Result<Done> finish();
    /// What is wrong with it, and the last that it said.
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
    std::string said_;  // the last of it
};

}  // namespace weft
