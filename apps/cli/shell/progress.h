// Shows the progress of a run: a bar on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace weft::cli {

class Progress {
  public:
    enum Unit { frames, work };  ///< work is shown as a percentage
    /// Prints on stderr; with `quiet`, prints nothing.
    Progress(std::string what, std::uint64_t total, bool quiet, Unit unit = frames);
    ~Progress();
    void update(std::uint64_t done);
    void set_what(std::string what) { what_ = std::move(what); }
    /// For a total that turns out smaller.
    void set_total(std::uint64_t total) { total_ = total; }

  private:
    std::string what_;
    std::uint64_t total_;
    bool quiet_, terminal_, drawn_ = false;
    Unit unit_;
    bool often_;  ///< a program reads the lines: a new one after each frame, at most 20 per second
    std::uint64_t next_line_ = 0;
    std::chrono::steady_clock::time_point begin_, last_draw_;
};

}  // namespace weft::cli
