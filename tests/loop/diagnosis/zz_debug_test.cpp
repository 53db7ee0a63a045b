#include <gtest/gtest.h>
#include <fmt/format.h>
#include <cstdlib>
#include "config/rig_file.hpp"
#include "diagnosis/calibrate.hpp"
#include "diagnosis/flight.hpp"
#include "diagnosis/sensitivity.hpp"
#include "diagnosis/lanes.hpp"
#include "diagnosis/load.hpp"
#include "diagnosis/terms/terms.hpp"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wsign-conversion"
namespace levitas::diagnosis {
TEST(Debug, Strays) {
  const std::string dir = std::getenv("DBG");
  const config::RigFile rig = config::LoadRig(dir + "/rig.yaml");
  const RigView view(rig.numbers, rig.plant);
  std::vector<Record> records;
  for (const char* n : {"standing", "spinning", "runup"}) {
    records.push_back(LoadRecord(dir + "/" + n + ".csv", rig, "/tmp"));
    LeaveOutContact(view, records.back());
    records.back().number = records.size() - 1;
  }
  auto terms = AllTerms(view, rig.tolerances.value_or(config::Tolerances{}), LargestOrbit(records, view.axes));
  const Search search(view, terms);
  const auto show = [&](const char* what, const std::vector<double>& theta, const ObserverSpeed& speed) {
    const auto gains = search.DesignGains(records, speed);
    const auto runs = search.Run(records, gains, theta);
    for (std::size_t r = 0; r < runs.size(); ++r) {
      double sq[4] = {}, worst = 0, at = 0, meas[4] = {}, stray=0; std::size_t n = 0;
      for (const auto& m : runs[r].moments) {
        if (!m.counts) continue;
        ++n;
        for (int a = 0; a < 4; ++a) {
          sq[a] += double(m.innovation_m[a]) * m.innovation_m[a];
          meas[a] = std::max(meas[a], std::abs(double(m.measured_m[a])));
          stray = std::max(stray, std::abs(double(m.actuator_m[a])));
          if (std::abs(m.innovation_m[a]) > worst) { worst = std::abs(m.innovation_m[a]); at = m.time_s; }
        }
      }
      fmt::print("{} {} n {} rms um {:.2f} {:.2f} {:.2f} {:.2f} worst {:.1f} at {:.3f} measured max {:.0f} {:.0f} {:.0f} {:.0f} model's most {:.0f}\n", what,
                 records[r].name, n, 1e6 * std::sqrt(sq[0] / n), 1e6 * std::sqrt(sq[1] / n), 1e6 * std::sqrt(sq[2] / n), 1e6 * std::sqrt(sq[3] / n), 1e6 * worst, at,
                 1e6 * meas[0], 1e6 * meas[1], 1e6 * meas[2], 1e6 * meas[3], 1e6*stray);
    }
  };
  show("usual fast", search.Usual(), kFast);
  show("usual slow", search.Usual(), kSlow);
  for (const ObserverSpeed speed : {kFast, kSpeeds[1]}) {
    const auto gains = search.DesignGains(records, speed);
    const auto v = search.Linearise(records, gains, search.Usual(), kWhiteningOrder, search.Everything());

    const LanePair pair(view, gains[0], ChangeOf(terms, search.Usual()));
    std::size_t pick = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) if (terms[i].effect == "sensor_gain" && terms[i].place == "de_y") pick = i;
    SensitivityBlock block(pair, terms, search.Usual(), {pick});
    std::array<float, kMaxAxes * kLanes> d{};
    const auto runs = search.Run(records, gains, search.Usual());
    for (std::size_t n = 0; n < runs[0].moments.size(); ++n) {
      const auto& m = runs[0].moments[n];
      block.Step(m, d.data());
      if (n % 500 == 0 || (n > 1490 && n < 1510)) fmt::print("{} start {} d {:.3g} {:.3g} act {:.1f} {:.1f} coil {:.2f} per_m {:.3g} {:.3g} per_a {:.1f}\n", n, m.starting, d[0], d[kLanes], 1e6*m.actuator_m[0], 1e6 * m.actuator_m[1], m.coil_mean_a[1], m.force_per_m[0], m.force_per_m[1], m.force_per_a[1]);
    }
    break;

  }
  const auto few = Spans(records, kMostRows);
  const Refined fit = CalibrateNuisances(view, search, terms, records, few, search.DesignGains(few, kSlow), 8);
  fmt::print("fit ok {} cost {}\n", fit.ok, fit.cost);
  show("fit fast", fit.theta, kFast);
  show("fit slow", fit.theta, kSlow);
  for (std::size_t i = 0; i < terms.size(); ++i) if (terms[i].nuisance() && std::abs((fit.theta[i]-terms[i].usual)/terms[i].tolerance) > 2) fmt::print("{} {} {:.2f} tolerances\n", terms[i].effect, terms[i].place, (fit.theta[i]-terms[i].usual)/terms[i].tolerance);
}
}
namespace levitas::diagnosis {
TEST(Debug, Fd) {
  const std::string dir = std::getenv("DBG");
  const config::RigFile rig = config::LoadRig(dir + "/rig.yaml");
  const RigView view(rig.numbers, rig.plant);
  std::vector<Record> records;
  for (const char* n : {"standing"}) {
    records.push_back(LoadRecord(dir + "/" + n + ".csv", rig, "/tmp"));
    LeaveOutContact(view, records.back());
  }
  auto terms = AllTerms(view, rig.tolerances.value_or(config::Tolerances{}), LargestOrbit(records, view.axes));
  const Search search(view, terms);
  std::vector<double> theta = search.Usual();
  const std::string what = std::getenv("TERM");
  std::size_t at = 0;
  for (std::size_t i = 0; i < terms.size(); ++i) if (terms[i].effect + " " + terms[i].place == what) at = i;
  theta[at] = std::atof(std::getenv("SHARE"));
  const auto gains = search.DesignGains(records, kSlow);
  const auto base = search.Run(records, gains, theta);
  const LanePair pair(view, gains[0], ChangeOf(terms, theta));
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (!terms[i].nuisance() && i != at) continue;
    if (terms[i].rotating) continue;
    SensitivityBlock block(pair, terms, theta, {i});
    std::array<float, kMaxAxes * kLanes> d{};
    auto t2 = theta; const double h = 0.02 * terms[i].scale(); t2[i] += h;
    const auto run = search.Run(records, gains, t2);
    if (terms[i].effect == "extra_delay") for (std::size_t n = 4000; n < 4040; ++n) { const auto& p = base[0].moments[n]; const auto& q = run[0].moments[n]; fmt::print("FDX {} cmd {:.3f} start {:.4f} end {:.4f} mean {:.4f} force {:.3f} | d start {:.5f} end {:.5f} mean {:.5f} force {:.4f} innov {:.3g}\n", n, p.command_now_a[2], p.coil_start_a[2], p.coil_end_a[2], p.coil_mean_a[2], p.force_n[2], q.coil_start_a[2] - p.coil_start_a[2], q.coil_end_a[2] - p.coil_end_a[2], q.coil_mean_a[2] - p.coil_mean_a[2], q.force_n[2] - p.force_n[2], q.innovation_m[2] - p.innovation_m[2]); }
    double ff = 0, fs = 0, ss = 0;
    for (std::size_t n = 0; n < run[0].moments.size(); ++n) {
      block.Step(base[0].moments[n], d.data());
      if (!base[0].moments[n].settled) continue;
      for (std::size_t a = 0; a < view.axes; ++a) {
        const double f = (double(run[0].moments[n].innovation_m[a]) - base[0].moments[n].innovation_m[a]) * terms[i].scale() / h;
        const double s = d[a * kLanes];
        ff += f * f; fs += f * s; ss += s * s;
      }
    }
    fmt::print("FD {} {} {}: norm fd {:.3g} slope {:.3g} ratio {:.3f} corr {:.4f}\n", terms[i].effect, terms[i].place, terms[i].parameter, std::sqrt(ff), std::sqrt(ss), std::sqrt(ss / ff), fs / std::sqrt(ff * ss));
  }
}
}
