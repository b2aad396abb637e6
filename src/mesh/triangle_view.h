// Reads triangles that are stored as one array per corner.
#pragma once

#include "mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <iterator>

namespace weft {

/// The first topology version. The version changes whenever triangles change.
inline constexpr std::uint64_t first_topology_version = 1;

/// Does not own the arrays. Corner k of triangle t is corners[k · stride + t].
class TriangleView {
  public:
    class Iterator {
      public:
        using value_type = Triangle;
        using difference_type = std::ptrdiff_t;

        Iterator() = default;
        Iterator(const TriangleView* view, std::uint32_t at) : view_(view), at_(at) {}
        Triangle operator*() const { return (*view_)[at_]; }
        Iterator& operator++() {
            ++at_;
            return *this;
        }
        Iterator operator++(int) { return {view_, at_++}; }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

      private:
        const TriangleView* view_ = nullptr;
        std::uint32_t at_ = 0;
    };

    TriangleView() = default;
    TriangleView(const std::uint32_t* corners, std::uint32_t stride, std::uint32_t count)
        : corners_(corners), stride_(stride), count_(count) {}

    std::uint32_t size() const { return count_; }
    bool empty() const { return count_ == 0; }
    Triangle operator[](std::uint32_t t) const {
        return {corners_[t], corners_[std::size_t{stride_} + t], corners_[2 * std::size_t{stride_} + t]};
    }
    Iterator begin() const { return {this, 0}; }
    Iterator end() const { return {this, count_}; }

  private:
    const std::uint32_t* corners_ = nullptr;
    std::uint32_t stride_ = 0, count_ = 0;
};
static_assert(std::input_iterator<TriangleView::Iterator>);

}  // namespace weft
