#include "io/files/child_process.h"

#include "io/files/buffered_file.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <utility>

extern char** environ;

namespace weft {
namespace {

using namespace std::chrono_literals;

// Enough for an error message; output beyond it, such as a warning per frame, is dropped.
constexpr std::size_t kept_messages = 2000;
// Time for a program that has stopped reading to print the reason and end.
constexpr auto time_to_explain = 5s;

void close_one(int& descriptor) {
    if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

// Moves a descriptor above those that the child will use, so that none is overwritten before it is passed on.
int above_standard(int descriptor) {
    const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 10);
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    return moved;
}

/// Pairs of descriptors, the parent's first.
struct Ends {
    int input[2] = {-1, -1}, messages[2] = {-1, -1};

    // A write to a broken pipe raises SIGPIPE; for a socket this can be disabled.
    bool open() {
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input) != 0) return false;
        if (::pipe2(messages, O_CLOEXEC) != 0) return false;
        for (int* end : {&input[0], &input[1], &messages[0], &messages[1]})
            if ((*end = above_standard(*end)) < 0) return false;
        return ::fcntl(messages[0], F_SETFL, O_NONBLOCK) == 0;
    }
    ~Ends() {
        for (int* end : {&input[0], &input[1], &messages[0], &messages[1]}) close_one(*end);
    }
};

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
    all.push_back(nullptr);
    return all;
}

/// This process' environment with other values for some variables.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& changed) {
    std::vector<std::string> all;
    for (char** one = environ; *one; ++one) {
        const std::string text = *one;
        if (!changed.contains(text.substr(0, text.find('=')))) all.push_back(text);
    }
    for (const auto& [name, value] : changed) all.push_back(name + "=" + value);
    return all;
}

int spawn(const std::vector<std::string>& arguments, const Ends& ends, const ChildOptions& options, pid_t& process) {
    const std::vector<char*> words = pointers_to(arguments);
    const std::vector<std::string> environment = environment_with(options.environment);

    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
    if (options.output >= 0) ::posix_spawn_file_actions_adddup2(&files, options.output, 3);
    ::posix_spawn_file_actions_adddup2(&files, ends.input[1], STDIN_FILENO);
    if (options.prints)
        ::posix_spawn_file_actions_adddup2(&files, ends.messages[1], STDOUT_FILENO);
    else
        ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, ends.messages[1], STDERR_FILENO);
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &usual);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    const int problem =
        ::posix_spawnp(&process, words[0], &files, &attributes, words.data(), pointers_to(environment).data());
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&files);
    return problem;
}

std::string ending(int status) {
    if (WIFSIGNALED(status)) return "was ended by signal " + std::to_string(WTERMSIG(status));
    return "ended with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const std::vector<std::string>& arguments, const ChildOptions& options) {
    ChildProcess child;
    child.program_ = arguments.front();
    child.where_ = options.where;
    Ends ends;
    int problem = ends.open() ? 0 : errno;
    pid_t process = -1;
    if (problem == 0) problem = spawn(arguments, ends, options, process);
    if (problem == ENOENT && !options.package.empty())
        return Error::of_machine(options.where, "needs the program " + child.program_ +
                                                    ", which was not found: install " + child.program_ +
                                                    " (Debian: " + options.package + ")");
    if (problem != 0) return child.failure("cannot be started: " + system_reason(problem));
    child.process_ = process;
    child.input_ = std::exchange(ends.input[0], -1);
    child.messages_ = std::exchange(ends.messages[0], -1);
    return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept {
    *this = std::move(other);
}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    std::swap(program_, other.program_);
    std::swap(where_, other.where_);
    std::swap(process_, other.process_);
    std::swap(input_, other.input_);
    std::swap(messages_, other.messages_);
    std::swap(status_, other.status_);
    std::swap(said_, other.said_);
    return *this;
}

ChildProcess::~ChildProcess() {
    kill();
    close_all();
}

void ChildProcess::close_all() {
    close_one(input_);
    close_one(messages_);
}

// Reads the messages so far, without waiting.
void ChildProcess::listen() {
    char block[4096];
    while (messages_ >= 0) {
        const ssize_t count = ::read(messages_, block, sizeof block);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0 && errno == EAGAIN) return;
        if (count <= 0) return close_one(messages_);
        said_.append(block, static_cast<std::size_t>(count));
        if (said_.size() > kept_messages) said_.erase(0, said_.size() - kept_messages);
    }
}

// Waits for the end of the process; false if `limit` passes first.
bool ChildProcess::wait(std::optional<std::chrono::milliseconds> limit) {
    const auto begin = std::chrono::steady_clock::now();
    while (process_ >= 0) {
        const pid_t ended = ::waitpid(process_, &status_, WNOHANG);
        // ECHILD: the host ignores SIGCHLD, so the exit status is unknown.
        if (ended == process_ || (ended < 0 && errno != EINTR)) process_ = -1;
        listen();
        if (process_ < 0) break;
        if (limit && std::chrono::steady_clock::now() - begin >= *limit) return false;
        pollfd wake{messages_, POLLIN, 0};
        ::poll(&wake, 1, 10);  // ms: if the program has closed its messages, its end is noticed up to 10 ms late
    }
    return true;
}

bool ChildProcess::running() {
    return process_ >= 0 && !wait(std::chrono::milliseconds(0));
}

void ChildProcess::end(std::chrono::milliseconds patience) {
    if (process_ < 0) return;
    if (::kill(-process_, SIGTERM) != 0) ::kill(process_, SIGTERM);
    if (!wait(patience)) kill();
}

void ChildProcess::kill() {
    if (process_ < 0) return;
    if (::kill(-process_, SIGKILL) != 0) ::kill(process_, SIGKILL);
    while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
}

Error ChildProcess::failure(const std::string& what) const {
    std::string text = program_ + ' ' + what;
    std::string said = said_;
    while (!said.empty() && std::isspace(static_cast<unsigned char>(said.back()))) said.pop_back();
    // Joins the last lines into one.
    constexpr int lines = 4;
    std::size_t begin = said.size();
    for (int i = 0; i < lines && begin != std::string::npos && begin > 0; ++i) begin = said.rfind('\n', begin - 1);
    if (begin != std::string::npos && begin < said.size()) said.erase(0, begin + 1);
    std::ranges::replace_if(
        said, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    if (!said.empty()) text += ": " + said;
    return Error::of_machine(where_, text);
}

Result<void> ChildProcess::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        pollfd ends[] = {{input_, POLLOUT, 0}, {messages_, POLLIN, 0}};
        if (::poll(ends, 2, -1) < 0 && errno != EINTR)
            return failure("cannot be given its input: " + system_reason(errno));
        listen();  // a program blocked on writing messages does not read
        const ssize_t count = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        } else if (errno == EPIPE || errno == ECONNRESET) {
            close_one(input_);
            if (wait(time_to_explain)) return failure(ending(status_) + " before it had read all of its input");
            kill();
            return failure("stopped reading its input");
        } else if (errno != EINTR && errno != EAGAIN) {
            return failure("cannot be given its input: " + system_reason(errno));
        }
    }
    return {};
}

Result<void> ChildProcess::finish() {
    close_one(input_);
    wait({});
    if (status_ != 0) return failure(ending(status_));
    return {};
}

}  // namespace weft
