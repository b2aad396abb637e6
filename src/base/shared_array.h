// Immutable arrays that many owners share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

namespace weft {

/// Reads like a constant vector. A copy shares the elements, so its cost does not depend on their number. To change an
/// array, fill a vector and assign it.
template <class T>
class SharedArray {
  public:
    using value_type = T;
    using const_iterator = const T*;
    using iterator = const_iterator;

    SharedArray() = default;
    /// Takes the elements of a vector with any allocator, without copying them.
    template <class Vector>
    requires(std::is_rvalue_reference_v<Vector&&>&& std::is_same_v<typename Vector::value_type, T> &&
             !std::is_same_v<Vector, SharedArray>) SharedArray(Vector&& elements) {
        auto owner = std::make_shared<const Vector>(std::move(elements));
        data_ = owner->data();
        size_ = owner->size();
        owner_ = std::move(owner);
    }

    SharedArray(const SharedArray&) = default;
    SharedArray& operator=(const SharedArray&) = default;
    SharedArray(SharedArray&& other) noexcept
        : owner_(std::move(other.owner_)),
          data_(std::exchange(other.data_, nullptr)),
          size_(std::exchange(other.size_, 0)) {}
    SharedArray& operator=(SharedArray&& other) noexcept {
        owner_ = std::move(other.owner_);
        data_ = std::exchange(other.data_, nullptr);
        size_ = std::exchange(other.size_, 0);
        return *this;
    }

    const T* data() const { return data_; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const T* begin() const { return data_; }
    const T* end() const { return data_ + size_; }
    const T& operator[](std::size_t i) const { return data_[i]; }
    const T& front() const { return data_[0]; }
    const T& back() const { return data_[size_ - 1]; }

    /// Whether both are the same array, not only equal ones.
    bool shares(const SharedArray& other) const { return data_ == other.data_ && size_ == other.size_; }

    friend bool operator==(const SharedArray& a, const SharedArray& b) {
        return a.shares(b) || std::equal(a.begin(), a.end(), b.begin(), b.end());
    }

  private:
    std::shared_ptr<const void> owner_;
    const T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace weft
