#include "diagnosis/inference/hypothesis.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;
using Indices = std::vector<std::size_t>;

class Maker {
 public:
  Maker(const RigView& rig, const std::vector<Term>& terms) : rig_(rig), terms_(terms) {}

  std::vector<Hypothesis> Make() {
    std::map<Id, std::map<std::string, Indices>, effect::ByName> forms;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (terms_[i].effect) forms[*terms_[i].effect][terms_[i].form].push_back(i);
    }
    for (const auto& [effect, of_effect] : forms) {
      for (const auto& [form, indices] : of_effect) AddForm(effect, form, indices);
    }
    std::map<Id, double> places;
    for (const Hypothesis& h : out_) places[h.effect] += 1.0;
    for (Hypothesis& h : out_) h.log_prior = -std::log(places[h.effect]);
    return std::move(out_);
  }

 private:
  void AddForm(Id effect, const std::string& form, const Indices& indices) {
    const std::size_t first = out_.size();
    AddEffect(effect, indices);
    // Places name a hypothesis among those of its effect.
    for (std::size_t h = first; h < out_.size() && !form.empty(); ++h) {
      out_[h].place += ", " + form;
    }
  }

  void AddEffect(Id effect, const Indices& indices) {
    std::map<std::string, Indices> places;
    for (const std::size_t i : indices) places[terms_[i].location.name].push_back(i);
    for (const auto& [place, members] : places) Free(effect, place, members);
    const bool by_axis = std::all_of(indices.begin(), indices.end(), [this](std::size_t i) {
      return terms_[i].location.is_axis();
    });
    if (by_axis) {
      for (std::size_t b = 0; b < rig_.numbers.bearings.size(); ++b) {
        Common(effect, rig_.numbers.bearings[b], OfBearing(indices, b));
      }
      Common(effect, "all axes", indices);
      Free(effect, "every axis by itself", indices);
      return;
    }
    // Grids of a shape parameter are alternatives; these sum up.
    const bool adds_up = effect == Id::kMisalignment && !rig_.geared();
    if (effect == Id::kUnbalance || adds_up) Free(effect, "all places", indices);
    if (effect == Id::kSensorRunout) AddRunout(indices);
    if (effect == Id::kMainsPickup) AddMains(indices);
  }

  void AddRunout(const Indices& indices) {
    for (const int order : {1, 2, 3}) {
      const Indices of_order =
          Where(indices, [order](const Location& at) { return at.order == order; });
      const std::string name = AtOrder(order).name;
      for (std::size_t b = 0; b < rig_.numbers.bearings.size(); ++b) {
        Free(Id::kSensorRunout, name + ", " + rig_.numbers.bearings[b], OfBearing(of_order, b));
      }
      Free(Id::kSensorRunout, name + ", all axes", of_order);
    }
    Free(Id::kSensorRunout, "all orders, all axes", indices);
  }

  void AddMains(const Indices& indices) {
    for (const double line_hz : {50.0, 60.0, 100.0, 120.0, 150.0}) {
      const Indices of_line =
          Where(indices, [line_hz](const Location& at) { return at.frequency_hz == line_hz; });
      if (of_line.empty()) continue;
      Free(Id::kMainsPickup, fmt::format("{:.0f} Hz, all axes", line_hz), of_line);
    }
  }

  /// Those of the terms whose location is as asked.
  template <typename AsAsked>
  [[nodiscard]] Indices Where(const Indices& indices, const AsAsked& as_asked) const {
    Indices found;
    std::copy_if(indices.begin(), indices.end(), std::back_inserter(found),
                 [&](std::size_t i) { return as_asked(terms_[i].location); });
    return found;
  }

  /// Those on an axis of the bearing.
  [[nodiscard]] Indices OfBearing(const Indices& indices, std::size_t bearing) const {
    return Where(indices,
                 [bearing](const Location& at) { return at.axis && *at.axis / 2 == bearing; });
  }

  Hypothesis Empty(Id effect, const std::string& place, const Indices& members,
                   std::size_t columns) const {
    Hypothesis h;
    h.effect = effect;
    h.place = place;
    h.terms = members;
    h.positive = terms_[members.front()].positive;
    h.directions = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(terms_.size()),
                                         static_cast<Eigen::Index>(columns));
    return h;
  }

  /// Every term by its own amount.
  void Free(Id effect, const std::string& place, const Indices& members) {
    Hypothesis h = Empty(effect, place, members, members.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
      h.directions(static_cast<Eigen::Index>(members[k]), static_cast<Eigen::Index>(k)) = 1.0;
    }
    h.positive = h.positive && members.size() == 1;
    out_.push_back(std::move(h));
  }

  /// Terms with the same parameter by the same amount.
  void Common(Id effect, const std::string& place, const Indices& members) {
    std::vector<std::string> parameters;
    for (const std::size_t i : members) {
      if (std::find(parameters.begin(), parameters.end(), terms_[i].parameter) ==
          parameters.end()) {
        parameters.push_back(terms_[i].parameter);
      }
    }
    Hypothesis h = Empty(effect, place, members, parameters.size());
    for (const std::size_t i : members) {
      const auto column = std::find(parameters.begin(), parameters.end(), terms_[i].parameter);
      h.directions(static_cast<Eigen::Index>(i), column - parameters.begin()) = 1.0;
    }
    out_.push_back(std::move(h));
  }

  const RigView& rig_;
  const std::vector<Term>& terms_;
  std::vector<Hypothesis> out_;
};

}  // namespace

bool Moves(const Hypothesis& hypothesis, std::size_t term) noexcept {
  return std::find(hypothesis.terms.begin(), hypothesis.terms.end(), term) !=
         hypothesis.terms.end();
}

bool Moves(const std::vector<Hypothesis>& causes, std::size_t term) noexcept {
  return std::any_of(causes.begin(), causes.end(),
                     [term](const Hypothesis& h) { return Moves(h, term); });
}

bool AreSame(const Hypothesis& a, const Hypothesis& b) noexcept {
  return a.effect == b.effect && a.place == b.place && a.terms == b.terms;
}

bool IsAmong(const std::vector<Hypothesis>& causes, const Hypothesis& cause) noexcept {
  return IndexOf(causes, cause) < causes.size();
}

bool HasEffect(const std::vector<Hypothesis>& causes, effect::Id effect) noexcept {
  return std::any_of(causes.begin(), causes.end(),
                     [effect](const Hypothesis& h) { return h.effect == effect; });
}

std::size_t IndexOf(const std::vector<Hypothesis>& all, const Hypothesis& cause) noexcept {
  const auto same = std::find_if(
      all.begin(), all.end(), [&cause](const Hypothesis& other) { return AreSame(other, cause); });
  return static_cast<std::size_t>(same - all.begin());
}

std::vector<Hypothesis> MakeHypotheses(const RigView& rig, const std::vector<Term>& terms) {
  return Maker(rig, terms).Make();
}

}  // namespace levitas::diagnosis
