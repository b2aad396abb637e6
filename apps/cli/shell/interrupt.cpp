#include "cli/shell/interrupt.h"

#include <csignal>
#include <cstddef>

namespace weft::cli {
namespace {

constexpr std::array signals = {SIGINT, SIGTERM};
volatile std::sig_atomic_t asked_to_end = 0;

extern "C" void ask_to_end(int number) {
    asked_to_end = 1;
    std::signal(number, SIG_DFL);
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
