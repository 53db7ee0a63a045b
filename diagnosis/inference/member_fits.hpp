#pragma once
// What the refinement of a shape asks of the records: fits of one set of causes with other members
// of a family.
//
// Why     which step is tried, shortened, kept or given up are decisions about numbers: behind this
//         interface they need no rig and no record.
// Units   evidence in nats; a step is one of the logarithm of a shape parameter.
// Thread  blocks the caller, every processor inside. Failure: a Refined that is not `ok`.

#include <functional>
#include <vector>

#include "diagnosis/inference/refine.hpp"

namespace levitas::diagnosis {

class MemberFits {
 public:
  MemberFits() = default;
  MemberFits(const MemberFits&) = delete;
  MemberFits& operator=(const MemberFits&) = delete;
  virtual ~MemberFits() = default;

  /// Refiner::LinearisedAt of the causes.
  [[nodiscard]] virtual View LinearisedAt(const Point& at) const = 0;
  /// Refiner::StepAlong of the causes.
  [[nodiscard]] virtual Search::ShapeStep StepAlong(
      const Point& at, const View& about, double width,
      const std::function<Point(double)>& beside) const = 0;
  /// Refiner::Fit of the causes.
  [[nodiscard]] virtual Refined Fit(Point start, const View& about, double worth) const = 0;
};

/// Those of a refiner. Refers to its arguments: `causes`, and the `view` whose whitening they have.
class RefinerMemberFits final : public MemberFits {
 public:
  RefinerMemberFits(const Refiner& refiner, const std::vector<Hypothesis>& causes, const View& view,
                    int passes)
      : refiner_(refiner), causes_(causes), view_(view), passes_(passes) {}

  [[nodiscard]] View LinearisedAt(const Point& at) const override;
  [[nodiscard]] Search::ShapeStep StepAlong(
      const Point& at, const View& about, double width,
      const std::function<Point(double)>& beside) const override;
  [[nodiscard]] Refined Fit(Point start, const View& about, double worth) const override;

 private:
  const Refiner& refiner_;
  const std::vector<Hypothesis>& causes_;
  const View& view_;
  int passes_;
};

}  // namespace levitas::diagnosis
