#include "cli/shell/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace weft::cli {
namespace {

using namespace std::chrono_literals;

std::string minutes(double seconds) {
    const auto s = static_cast<long>(std::min(seconds, 359999.0) + 0.5);
    char text[32];
    if (s >= 3600) {
        std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    } else {
        std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
    }
    return text;
}

}  // namespace

Progress::Progress(std::string what, std::uint64_t total, bool quiet, Unit unit)
    : what_(std::move(what)),
      total_(total),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO)),
      unit_(unit),
      often_(std::getenv("WEFT_PROGRESS") != nullptr),
      begin_(std::chrono::steady_clock::now()),
      last_draw_(begin_ - 1h) {}

Progress::~Progress() {
    if (drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::update(std::uint64_t done) {
    if (quiet_ || total_ == 0) return;
    done = std::min(done, total_);
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double>(now - begin_).count();
    const double rate = elapsed > 0 ? static_cast<double>(done) / elapsed : 0;
    const std::string left = rate > 0 ? minutes(static_cast<double>(total_ - done) / rate) : "?";
    char how_far[96];
    if (unit_ == frames) {
        std::snprintf(how_far, sizeof how_far, "%llu/%llu  %.1f frames/s", static_cast<unsigned long long>(done),
                      static_cast<unsigned long long>(total_), rate);
    } else {
        std::snprintf(how_far, sizeof how_far, "%.0f %%",
                      100 * static_cast<double>(done) / static_cast<double>(total_));
    }
    if (terminal_) {
        if (now - last_draw_ < 50ms && done != total_) return;
        constexpr int width = 30;
        std::string bar(width, '.');
        std::fill_n(bar.begin(), width * done / total_, '#');
        std::fprintf(stderr, "\r%s [%s] %s  %s left \033[K", what_.c_str(), bar.c_str(), how_far, left.c_str());
        std::fflush(stderr);
        drawn_ = true;
        last_draw_ = now;
    } else if (often_ ? now - last_draw_ >= 50ms || done == total_ : done >= next_line_) {
        last_draw_ = now;
        std::fprintf(stderr, "%s %s  %s left\n", what_.c_str(), how_far, left.c_str());
        const std::uint64_t lines = unit_ == frames ? 4 : 20;
        next_line_ = std::min(total_, done + std::max<std::uint64_t>(1, total_ / lines));
    }
}

}  // namespace weft::cli
