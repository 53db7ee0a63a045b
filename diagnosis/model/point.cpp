#include "diagnosis/model/point.hpp"

#include <utility>

namespace levitas::diagnosis {
namespace {

bool HasOtherShape(const Term& term, const Point& point, std::size_t index) {
  return term.family.member && point.shapes[index] != term.family.shape;
}

}  // namespace

Point PointAt(const std::vector<Term>& table, std::vector<double> theta) {
  Point point{std::move(theta), {}};
  point.shapes.reserve(table.size());
  for (const Term& term : table) point.shapes.push_back(term.family.shape);
  return point;
}

Term TermAt(const std::vector<Term>& table, const Point& point, std::size_t index) {
  const Term& term = table[index];
  return HasOtherShape(term, point, index) ? term.family.member(point.shapes[index]) : term;
}

TermsAt::TermsAt(const std::vector<Term>& table, const Point& point) : table_(table) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (!HasOtherShape(table[i], point, i)) continue;
    if (moved_.empty()) moved_ = table;
    moved_[i] = table[i].family.member(point.shapes[i]);
  }
}

}  // namespace levitas::diagnosis
