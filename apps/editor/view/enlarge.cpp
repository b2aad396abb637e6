#include "editor/view/enlarge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weft::editor {
namespace {

/// Where the edge through a pixel crosses it, from the steps at both ends of the edge.
class EdgeSmoother {
  public:
    explicit EdgeSmoother(const Image8& image)
        : image_(image), luma_(std::size_t{image.width} * image.height), wide_(image.width) {
        for (std::size_t i = 0; i < luma_.size(); ++i) {
            const std::uint8_t* const p = &image.rgba[4 * i];
            luma_[i] = 2 * p[0] + 5 * p[1] + p[2];  // in eighths
        }
    }

    /// Without the rows and columns at the border.
    void smooth(Image8& out) const {
        for (std::uint32_t y = 1; y + 1 < image_.height; ++y)
            for (std::uint32_t x = 1; x + 1 < image_.width; ++x) smooth(std::size_t{y} * wide_ + x, x, y, out);
    }

  private:
    static constexpr int least_contrast = 8 * 12, steps = 12;

    void smooth(std::size_t i, std::uint32_t x, std::uint32_t y, Image8& out) const {
        const int* const l = &luma_[i];
        const auto w = static_cast<std::ptrdiff_t>(wide_);
        const int c = l[0], n = l[-w], s = l[w], west = l[-1], e = l[1];
        const auto [low, high] = std::minmax({c, n, s, west, e});
        if (high - low < std::max(least_contrast, high / 8)) return;
        const int nw = l[-w - 1], ne = l[-w + 1], sw = l[w - 1], se = l[w + 1];
        const int across_rows = std::abs(nw + sw - 2 * west) + 2 * std::abs(n + s - 2 * c) + std::abs(ne + se - 2 * e);
        const int across_columns =
            std::abs(nw + ne - 2 * n) + 2 * std::abs(west + e - 2 * c) + std::abs(sw + se - 2 * s);
        const bool flat = across_rows >= across_columns;  // the edge runs along the row
        const int before = flat ? n : west, after = flat ? s : e;
        const bool to_before = std::abs(before - c) >= std::abs(after - c);
        const std::ptrdiff_t across = (flat ? w : 1) * (to_before ? -1 : 1), along = flat ? 1 : w;
        const int other = to_before ? before : after, mean2 = other + c, limit = std::abs(other - c) / 4;
        // How far the edge goes on to either side, within the image.
        const std::uint32_t here = flat ? x : y, count = flat ? image_.width : image_.height;
        std::array<int, 2> length{}, end{};
        for (int side = 0; side < 2; ++side) {
            const std::ptrdiff_t step = side == 0 ? -along : along;
            const int most = std::min(steps, static_cast<int>(side == 0 ? here : count - 1 - here));
            int k = 1;
            for (; k <= most; ++k) {
                const std::ptrdiff_t at = step * k;
                end[static_cast<std::size_t>(side)] = l[at] + l[at + across] - mean2;
                if (std::abs(end[static_cast<std::size_t>(side)]) >= 2 * limit) break;
            }
            length[static_cast<std::size_t>(side)] = k;
        }
        const std::size_t nearer = length[0] <= length[1] ? 0 : 1;
        if (std::abs(end[nearer]) < 2 * limit || (2 * c - mean2 < 0) == (end[nearer] < 0)) return;
        const float part = 0.5f - static_cast<float>(length[nearer]) / static_cast<float>(length[0] + length[1]);
        const auto neighbor = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + across);
        for (std::size_t k = 0; k < 4; ++k) {
            const float a = image_.rgba[4 * i + k], b = image_.rgba[4 * neighbor + k];
            out.rgba[4 * i + k] = static_cast<std::uint8_t>(a + (b - a) * part + 0.5f);
        }
    }

    const Image8& image_;
    std::vector<int> luma_;
    std::size_t wide_;
};

/// Between which pixels of a row or column a pixel of the result lies, and how near to the second, in 256ths.
struct Between {
    std::uint32_t first = 0, second = 0, part = 0;
};
std::vector<Between> places(std::uint32_t from, std::uint32_t to) {
    std::vector<Between> all(to);
    for (std::uint32_t i = 0; i < to; ++i) {
        const float at =
            std::clamp((static_cast<float>(i) + 0.5f) * static_cast<float>(from) / static_cast<float>(to) - 0.5f, 0.0f,
                       static_cast<float>(from - 1));
        const auto first = static_cast<std::uint32_t>(at);
        all[i] = {first, std::min(first + 1, from - 1),
                  static_cast<std::uint32_t>((at - static_cast<float>(first)) * 256)};
    }
    return all;
}

}  // namespace

Image8 without_steps(const Image8& image) {
    Image8 out = image;
    if (image.width > 2 && image.height > 2) EdgeSmoother(image).smooth(out);
    return out;
}

Image8 enlarged(const Image8& image, std::uint32_t width, std::uint32_t height) {
    Image8 out{width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4)};
    if (image.rgba.empty() || out.rgba.empty()) return out;
    const std::vector<Between> columns = places(image.width, width), rows = places(image.height, height);
    std::vector<std::uint32_t> row(std::size_t{image.width} * 4);  // between two rows, in 256ths
    for (std::uint32_t y = 0; y < height; ++y) {
        const std::uint8_t *const a = image.at(0, rows[y].first), *const b = image.at(0, rows[y].second);
        const std::uint32_t down = rows[y].part;
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = a[i] * (256 - down) + b[i] * down;
        std::uint8_t* to = out.at(0, y);
        for (const Between& x : columns) {
            const std::uint32_t *const p = &row[std::size_t{4} * x.first], *const q = &row[std::size_t{4} * x.second];
            for (std::size_t k = 0; k < 4; ++k)
                to[k] = static_cast<std::uint8_t>((p[k] * (256 - x.part) + q[k] * x.part + 32768) >> 16);
            to += 4;
        }
    }
    return out;
}

}  // namespace weft::editor
