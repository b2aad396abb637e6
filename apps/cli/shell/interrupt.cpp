#include "cli/shell/interrupt.h"

#include <time.h>

#include <csignal>
#include <cstddef>

namespace weft::cli {
namespace {

constexpr std::array signals = {SIGINT, SIGTERM};
constexpr double same_request = 0.5;  // s
volatile std::sig_atomic_t asked_to_end = 0;
timespec first_asked;  // of use once asked_to_end is set

// The program `timeout` sends its signal to the process and to the group of the process: two signals, one request.
extern "C" void ask_to_end(int number) {
    timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (asked_to_end == 0) {
        first_asked = now;
        asked_to_end = 1;
        return;
    }
    const double since = static_cast<double>(now.tv_sec - first_asked.tv_sec) +
                         1e-9 * static_cast<double>(now.tv_nsec - first_asked.tv_nsec);
    if (since < same_request) return;
    std::signal(number, SIG_DFL);
    std::raise(number);
}

}  // namespace

EndOnSignal::EndOnSignal() {
    asked_to_end = 0;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        before_[i] = std::signal(signals[i], ask_to_end);
        if (before_[i] == SIG_IGN) std::signal(signals[i], SIG_IGN);  // ignored in background jobs
    }
}

EndOnSignal::~EndOnSignal() {
    for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], before_[i]);
}

bool EndOnSignal::asked() const {
    return asked_to_end != 0;
}

}  // namespace weft::cli
