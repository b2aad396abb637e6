// Handles Ctrl-C between two frames, so that no output is left incomplete.
#pragma once

#include <array>

namespace weft::cli {

/// While an object exists, SIGINT and SIGTERM request an end after the current frame. A second signal ends at once,
/// unless it follows within half a second of the first.
class EndOnSignal {
  public:
    EndOnSignal();
    ~EndOnSignal();
    EndOnSignal(const EndOnSignal&) = delete;
    EndOnSignal& operator=(const EndOnSignal&) = delete;

    bool asked() const;

  private:
    std::array<void (*)(int), 2> before_{};
};

}  // namespace weft::cli
