#include "diagnosis/model/linear_change.hpp"

#include "diagnosis/model/term.hpp"

namespace levitas::diagnosis {

LinearChange ChangeOf(const std::vector<Term>& terms, const std::vector<double>& theta) {
  LinearChange change;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].change && theta[i] != 0.0) terms[i].change(theta[i], change);
  }
  return change;
}

}  // namespace levitas::diagnosis
