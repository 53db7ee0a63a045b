#pragma once
// A table of a page. Cells are text and are escaped when the table is written, so that no caller
// has to think of it; a column of markup alone is taken as it is.
//
// Classes  k: not wrapped; n: numbers, to the right and not wrapped. The page's style has them.
// Thread   one; allocates.
// Failure  std::invalid_argument for a row that has not one cell per column.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace levitas::html {

enum class Kind : std::uint8_t {
  kText,
  kKey,     ///< text that is not wrapped
  kNumber,  ///< text of a number
  kMarkup,  ///< not escaped
};

struct Column {
  std::string title{};
  Kind kind{Kind::kText};
};

class Table {
 public:
  explicit Table(std::vector<Column> columns, std::string id = {})
      : columns_(std::move(columns)), id_(std::move(id)) {}

  /// `row_class`: of the style of the page; empty: none.
  void Add(const std::vector<std::string>& cells, const std::string& row_class = {});
  [[nodiscard]] bool empty() const noexcept { return rows_.empty(); }

  /// Head and rows; the head is left out where no column has a title.
  [[nodiscard]] std::string Html() const;
  /// The same in a box that scrolls where the page is too narrow for it.
  [[nodiscard]] std::string Scrolling() const;

 private:
  std::vector<Column> columns_;
  std::string id_;
  std::string rows_;
};

}  // namespace levitas::html
