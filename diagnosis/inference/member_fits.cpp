#include "diagnosis/inference/member_fits.hpp"

#include <utility>

namespace levitas::diagnosis {

View RefinerMemberFits::LinearisedAt(const Point& at) const {
  return refiner_.LinearisedAt(causes_, at, view_);
}

Search::ShapeStep RefinerMemberFits::StepAlong(const Point& at, const View& about, double width,
                                               const std::function<Point(double)>& beside) const {
  return refiner_.StepAlong(causes_, at, about, width, beside);
}

Refined RefinerMemberFits::Fit(Point start, const View& about, double worth) const {
  return refiner_.Fit(causes_, std::move(start), about, passes_, worth);
}

}  // namespace levitas::diagnosis
