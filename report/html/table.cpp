#include "report/html/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "report/html/escaped_text.hpp"

namespace levitas::html {
namespace {

const char* ClassOf(Kind kind) {
  return kind == Kind::kKey ? " class=k" : kind == Kind::kNumber ? " class=n" : "";
}

}  // namespace

void Table::Add(const std::vector<std::string>& cells, const std::string& row_class) {
  if (cells.size() != columns_.size()) {
    throw std::invalid_argument(
        fmt::format("a row of {} cells in a table of {} columns", cells.size(), columns_.size()));
  }
  rows_ += row_class.empty() ? "<tr>" : fmt::format("<tr class=\"{}\">", Escaped(row_class));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Kind kind = columns_[i].kind;
    rows_ += fmt::format("<td{}>{}</td>", ClassOf(kind),
                         kind == Kind::kMarkup ? cells[i] : Escaped(cells[i]));
  }
  rows_ += "</tr>\n";
}

std::string Table::Html() const {
  std::string html = id_.empty() ? "<table>\n" : fmt::format("<table id=\"{}\">\n", Escaped(id_));
  if (std::ranges::any_of(columns_, [](const Column& column) { return !column.title.empty(); })) {
    html += "<tr>";
    for (const Column& column : columns_) {
      html += fmt::format("<th{}>{}</th>", ClassOf(column.kind), Escaped(column.title));
    }
    html += "</tr>\n";
  }
  return html + rows_ + "</table>\n";
}

std::string Table::Scrolling() const { return "<div class=scroll>" + Html() + "</div>\n"; }

}  // namespace levitas::html
