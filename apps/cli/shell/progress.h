// How far a run is: a bar on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace weft::cli {

class Progress {
  public:
    enum Unit { frames, work };  ///< work is shown in per cent
    /// On stderr. `quiet` says nothing at all.
    Progress(std::string what, std::uint64_t total, bool quiet, Unit unit = frames);
    ~Progress();
    void update(std::uint64_t done);
    void set_what(std::string what) { what_ = std::move(what); }
    /// Less to do than it seemed.
    void set_total(std::uint64_t total) { total_ = total; }

  private:
    std::string what_;
    std::uint64_t total_;
    bool quiet_, terminal_, drawn_ = false;
    Unit unit_;
    std::uint64_t next_line_ = 0;
    std::chrono::steady_clock::time_point begin_, last_draw_;
};

}  // namespace weft::cli
