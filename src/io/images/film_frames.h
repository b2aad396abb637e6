// Which frames of a run become images of a video.
#pragma once

#include <cstdint>

namespace weft {

/// Selects the frames of a run that become images of a video: for each image the frame nearest in time.
class FilmFrames {
  public:
    /// `frames`: without the start. frame_rate ≥ film_rate > 0
    FilmFrames(std::uint64_t frames, double frame_rate, double film_rate);
    std::uint64_t count() const { return count_; }
    std::uint64_t frame(std::uint64_t picture) const;

  private:
    double step_;
    std::uint64_t count_;
};

}  // namespace weft
