// Columns of text, aligned.
#pragma once

#include <string>
#include <vector>

namespace weft::cli {

class Table {
  public:
    explicit Table(std::vector<std::string> heads) : lines_{std::move(heads)} {}

    /// As many cells as there are heads.
    void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }
    /// The first column to the left, the others to the right; each line ends in a newline.
    std::string text() const;

  private:
    std::vector<std::vector<std::string>> lines_;
};

/// With so many digits after the point.
std::string fixed(double value, int digits);

}  // namespace weft::cli
