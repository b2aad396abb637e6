// A table of text with aligned columns.
#pragma once

#include <string>
#include <vector>

namespace weft::cli {

class Table {
  public:
    explicit Table(std::vector<std::string> heads) : lines_{std::move(heads)} {}

    /// As many cells as there are column headings.
    void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }
    /// The first column is left-aligned, the others right-aligned; each line ends in a newline.
    std::string text() const;

  private:
    std::vector<std::vector<std::string>> lines_;
};

/// With `digits` digits after the decimal point.
std::string fixed(double value, int digits);

}  // namespace weft::cli
