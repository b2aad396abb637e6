// How large and how good the next image of a moving view is.
#pragma once

#include <array>
#include <cstddef>

namespace weft::editor {

struct Quality {
    unsigned percent = 100;  ///< of width and height
    bool draft = false;      ///< render::RendererOptions::draft
    friend bool operator==(const Quality&, const Quality&) = default;
};

/// From the best to the cheapest.
inline constexpr std::array<Quality, 6> qualities{
    {{100, false}, {100, true}, {70, true}, {50, true}, {35, true}, {25, true}}};

/// Lowers the quality until an image takes at most a target time, and raises it where images are fast enough for more.
/// Pure: the caller tells what images took.
class ViewQuality {
  public:
    /// `begin`: index of the first image's quality.
    explicit ViewQuality(double target_ms, std::size_t begin = 0) : target_ms_(target_ms), at_(begin) {}

    Quality moving() const { return qualities[at_]; }
    /// A moving image of this quality took that long.
    void took(double ms);
    /// An image of the best quality, drawn while nothing moved.
    void best_took(double ms);

  private:
    /// Time of an image of another quality, from one of the present quality. Images at most get as much cheaper as they
    /// have fewer pixels.
    double expected(double ms, std::size_t quality) const;

    double target_ms_;
    std::size_t at_;
    int fast_ = 0;         ///< images in a row after which the next better quality would have been in time
    double best_ms_ = -1;  ///< of the last image of the best quality; below 0: none yet
};

}  // namespace weft::editor
