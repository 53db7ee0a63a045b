#pragma once
// Where the model of a rig stands: the parameter of every term, and the shape of every family.
//
// Why       laws of families (slew limit, knee, clearance) depend on shapes that a search moves, as
//           it moves parameters. The table of terms stays as it was made; what a run or a
//           linearisation belongs to is said by its point alone.
// Order     that of the table of terms; a term of no family has an empty shape.
// Units     those of the terms; SI for shapes. Thread: any; pure.

#include <cstddef>
#include <vector>

#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {

struct Point {
  std::vector<double> theta;
  std::vector<Family::Shape> shapes;

  friend bool operator==(const Point&, const Point&) = default;
};

/// theta with the shapes that the table has.
[[nodiscard]] Point PointAt(const std::vector<Term>& table, std::vector<double> theta);

/// The term as it acts at the point: that of the table, or another member of its family.
[[nodiscard]] Term TermAt(const std::vector<Term>& table, const Point& point, std::size_t index);

/// All of them. Refers to the table, which is copied only where a shape differs from its own.
class TermsAt {
 public:
  TermsAt(const std::vector<Term>& table, const Point& point);
  [[nodiscard]] const std::vector<Term>& terms() const noexcept {
    return moved_.empty() ? table_ : moved_;
  }

 private:
  const std::vector<Term>& table_;
  std::vector<Term> moved_;
};

}  // namespace levitas::diagnosis
