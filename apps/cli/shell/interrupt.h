// Ctrl-C between two frames, so that nothing is left half done.
#pragma once

#include <array>

namespace weft::cli {

/// While one lives, SIGINT and SIGTERM ask for an end after this frame; who asks twice gets it at once.
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
