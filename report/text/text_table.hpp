#pragma once
// A table for people, as wide as what stands in it: first column flush left, the others flush
// right, two blanks at least between them.
//
// Thread  plain data.

#include <string>
#include <vector>

namespace levitas::report {

class TextTable {
 public:
  void Add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// Every row ends in a newline; rows may be of different lengths.
  [[nodiscard]] std::string Text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace levitas::report
