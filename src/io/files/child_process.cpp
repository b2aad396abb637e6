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

// Enough for the lines that say why; a program that complains of every frame is not kept in full.
constexpr std::size_t kept_messages = 2000;
// What a program that reads no more may take to say why and end.
constexpr auto time_to_explain = 5s;

void close_one(int& descriptor) {
    if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
}

// Above those that the child is going to have, so that none is overwritten before it is passed on.
int above_standard(int descriptor) {
    const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 10);
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    return moved;
}

/// Pairs of ends, ours first.
struct Ends {
    int input[2] = {-1, -1}, messages[2] = {-1, -1};

    // A pipe would raise SIGPIPE, a socket can be asked not to.
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

int spawn(const std::vector<std::string>& arguments, const Ends& ends, int output, pid_t& process) {
    std::vector<char*> words;
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);

    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
    if (output >= 0) ::posix_spawn_file_actions_adddup2(&files, output, 3);
    ::posix_spawn_file_actions_adddup2(&files, ends.input[1], STDIN_FILENO);
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
    const int problem = ::posix_spawnp(&process, words[0], &files, &attributes, words.data(), environ);
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
    if (problem == 0) problem = spawn(arguments, ends, options.output, process);
    if (problem == ENOENT)
        return Error::of_machine(options.where, "needs the program " + child.program_ +
                                                    ", which is not there: install " + child.program_ +
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

// What it has said so far; never waits.
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

// Until it has ended; false if it has not by then.
bool ChildProcess::wait(std::optional<std::chrono::milliseconds> limit) {
    const auto begin = std::chrono::steady_clock::now();
    while (process_ >= 0) {
        const pid_t ended = ::waitpid(process_, &status_, WNOHANG);
        // No child: the host has said that it wants to hear of none, and how it ended nobody knows.
        if (ended == process_ || (ended < 0 && errno != EINTR)) process_ = -1;
        listen();
        if (process_ < 0) break;
        if (limit && std::chrono::steady_clock::now() - begin > *limit) return false;
        pollfd wake{messages_, POLLIN, 0};
        ::poll(&wake, 1, 10);  // ms: the end of a program that has closed its messages is seen that late
    }
    return true;
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
    // The last lines, in one.
    constexpr int lines = 4;
    std::size_t begin = said.size();
    for (int i = 0; i < lines && begin != std::string::npos && begin > 0; ++i) begin = said.rfind('\n', begin - 1);
    if (begin != std::string::npos && begin < said.size()) said.erase(0, begin + 1);
    std::ranges::replace_if(
        said, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    if (!said.empty()) text += ": " + said;
    return Error::of_machine(where_, text);
}

Result<Done> ChildProcess::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        pollfd ends[] = {{input_, POLLOUT, 0}, {messages_, POLLIN, 0}};
        if (::poll(ends, 2, -1) < 0 && errno != EINTR) return failure("cannot be fed: " + system_reason(errno));
        listen();  // a program that waits for somebody to hear it does not read
        const ssize_t count = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        } else if (errno == EPIPE || errno == ECONNRESET) {
            close_one(input_);
            if (wait(time_to_explain)) return failure(ending(status_) + " before it had everything");
            kill();
            return failure("reads no more");
        } else if (errno != EINTR && errno != EAGAIN) {
            return failure("cannot be fed: " + system_reason(errno));
        }
    }
    return Done{};
}

Result<Done> ChildProcess::finish() {
    close_one(input_);
    wait({});
    if (status_ != 0) return failure(ending(status_));
    return Done{};
}

}  // namespace weft
