// amb balance: from a recorded run-up to correction weights and what they will leave.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <complex>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/commands/command.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/rig_of_records.hpp"
#include "cli/study/controller_output.hpp"
#include "cli/study/free_run.hpp"
#include "cli/study/written_files.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/schema/unit.hpp"
#include "identification/balance/balance.hpp"
#include "report/balance/balance_files.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

using namespace balancing;

constexpr const char* kBalanceHelp =
    "Finds the unbalance of the rotor from positions and commanded currents of a recorded run-up,\n"
    "with any controller, and says which weights correct it, and what orbit they leave over "
    "speed.\n"
    "  amb run --scenario run_up_6000 --record before.lcm\n"
    "  amb balance before.lcm --plane disc=299.2,30,12 --plane drive_end=129.9,20\n"
    "  amb balance after.lcm --after before.lcm --planes planes.yaml --applied disc=0.41@152\n"
    "Angles are in degrees in the direction of rotation from the rotor's own x axis, which stands "
    "on\n"
    "the x axis of the bearings when the recorded angle is 0. Without planes: moments at the "
    "planes "
    "of\n"
    "the rig file's unbalance. docs/identification.md has the method and what it reaches.";

struct BalanceOptions : AnalysisOptions {
  std::string data_path;
  std::vector<std::string> after;
  std::vector<std::string> applied;
  std::vector<std::string> planes;
  std::string planes_path;
  bool drill{};
  double top_rpm{};
  std::string svg_path;
  std::string run_outs_path;
};

CorrectionPlanes PlanesOf(const BalanceOptions& options, const configuration::RigFile& rig) {
  CorrectionPlanes planes;
  if (!options.planes_path.empty()) planes = LoadPlanes(options.planes_path);
  for (const std::string& word : options.planes) planes.planes.push_back(PlaneOfWord(word));
  if (planes.planes.empty()) planes = PlanesOfRig(rig);
  planes.drill = planes.drill || options.drill;
  CheckPlanes(planes, rig);
  return planes;
}

/// "disc=0.41@152": grams at degrees; taken away where the planes are drilled.
AppliedWeight WeightOfWord(const std::string& word, const CorrectionPlanes& planes) {
  const auto refuse = [&word](const std::string& why) {
    return Problem(ExitStatus::kUsage,
                   fmt::format("--applied '{}': {}; allowed PLANE=MASS_G@DEG", word, why));
  };
  const std::size_t equal = word.find('=');
  const std::size_t at = word.find('@', equal == std::string::npos ? 0 : equal);
  if (equal == std::string::npos || at == std::string::npos) throw refuse("no '=' or no '@'");
  const std::string name = word.substr(0, equal);
  const auto mass =
      configuration::ToSi(word.substr(equal + 1, at - equal - 1), configuration::unit::kGram);
  const auto angle = configuration::ToSi(word.substr(at + 1), configuration::unit::kDegree);
  if (!mass || !angle) throw refuse("not two numbers");
  for (const CorrectionPlane& plane : planes.planes) {
    if (plane.name != name) continue;
    if (!(plane.radius_m > 0.0)) throw refuse("the plane has no radius: give it with --plane");
    const double sign = planes.drill ? -1.0 : 1.0;
    return {name, sign * std::polar(*mass * plane.radius_m, *angle)};
  }
  throw refuse(fmt::format("no plane is named {}", name));
}

/// The controller of --controller, else the session's, with the run-out that was found taken off
/// what its law reads, in place of what it had of order 1. Only what the records show beyond
/// chance: two deviations.
void WriteRunOuts(const BalanceOptions& options, const configuration::RigFile& rig,
                  const UnbalanceFit& fit) {
  if (options.run_outs_path.empty()) return;
  constexpr double kDeviations = 2.0;
  synchronous::RunOut found;
  std::size_t axes = 0;
  for (std::size_t i = 0; i < rig.numbers.axes(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!(std::abs(fit.runout_m[at]) > kDeviations * fit.runout_deviation_m[at])) continue;
    found.real_m[i] = fit.runout_m[at].real();
    found.imaginary_m[i] = fit.runout_m[at].imag();
    ++axes;
  }
  if (axes == 0) {
    throw Problem(ExitStatus::kOther,
                  "--write-run-outs: no probe's run-out is beyond two deviations of what the "
                  "records leave open; nothing was written. A slow run-up from near rest shows it");
  }
  auto known = ControllerIfKnown(options.data_path, options.controller_name, rig);
  if (!known) {
    throw BadInput("--write-run-outs: " + options.data_path +
                   " names no controller; give the one to be written with --controller");
  }
  configuration::ControllerFile& controller = known->file;
  auto& all = controller.synchronous.run_outs;
  std::erase_if(all, [](const synchronous::RunOut& one) { return one.order == 1.0; });
  all.push_back(found);
  WriteControllerFile(
      options.run_outs_path,
      fmt::format("# amb balance: run-out of {} probes from {}\n", axes, options.data_path),
      controller, rig.numbers);
  for (std::size_t i = 0; i < rig.numbers.axes(); ++i) {
    const std::complex<double> runout_m{found.real_m[i], found.imaginary_m[i]};
    if (runout_m == 0.0) continue;
    fmt::print("run-out of {}: {:.3g} um, give or take {:.2g} um, at {:.1f} deg\n",
               rig.numbers.channels[i], 1e6 * std::abs(runout_m),
               1e6 * fit.runout_deviation_m[static_cast<Eigen::Index>(i)],
               std::arg(runout_m) * 180.0 / std::numbers::pi);
  }
}

/// Where a session's controller says that its rig has no mark on the shaft.
void TellOfNoMark(const std::vector<std::string>& records, const configuration::RigFile& rig) {
  for (const std::string& path : records) {
    const auto known = ControllerIfKnown(path, {}, rig);
    if (!known || known->file.synchronous.angle.source == synchronous::AngleSource::kRig) continue;
    fmt::print(
        "WARNING: the controller of {} says that the shaft has no mark (angle_from). The recorded "
        "angle must be that of a mark all the same: from a counted or estimated one the weights "
        "have no place on the rotor\n",
        path);
  }
}

ExitStatus Run(const BalanceOptions& options) {
  for (const std::string& path : {options.svg_path, options.json_path, options.run_outs_path}) {
    session::CheckOutputPath(path, options.data_path);
  }
  if (options.after.empty() != options.applied.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "--after and --applied: both (the run before and what was put on the rotor "
                  "since), or neither");
  }
  std::vector<std::string> records = options.after;
  records.push_back(options.data_path);
  BalanceRequest request;
  request.rig = LoadRigOfRecords(options, records);
  request.planes = PlanesOf(options, request.rig);
  for (const std::string& path : records) {
    request.runs.push_back(LoadRun(path, request.rig));
  }
  for (const std::string& word : options.applied) {
    request.runs.back().applied.push_back(WeightOfWord(word, request.planes));
  }
  const auto law = LawIfKnown(options.data_path, options.controller_name, request.rig);
  if (law) request.law = law->law;
  request.top_rad_per_s = options.top_rpm > 0.0 ? RpmToRadPerS(options.top_rpm)
                                                : request.rig.numbers.max_speed_rad_per_s;
  const BalanceResult result = Balance(request);
  TellOfNoMark(records, request.rig);
  fmt::print("{}", report::BalanceText(request, result));
  WriteJsonFile(options.json_path, report::BalanceJson(request, result));
  report::WriteBalancePicture(options.svg_path, request, result);
  WriteRunOuts(options, request.rig, result.fit);
  TellWritten({options.json_path, options.svg_path, options.run_outs_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddBalanceCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<BalanceOptions>();
  CLI::App* command = AddStudyCommand(app, "balance");
  command->footer(kBalanceHelp);
  command
      ->add_option("RECORD", options->data_path,
                   "Run-up of the rotor as it is now: session, CSV or MAT")
      ->required();
  AddRigOfRecordsOption(*command, *options);
  command->add_option("--controller", options->controller_name,
                      "Law of the forecast; default: the session's, else as the record shows it");
  command
      ->add_option("--plane", options->planes,
                   "Where a weight can go: "
                   "NAME=Z_MM,RADIUS_MM[,HOLES[,FIRST_HOLE_DEG[,SMALLEST_G,LARGEST_G]]]; "
                   "once for each plane")
      ->allow_extra_args(false);
  command->add_option("--planes", options->planes_path, "File with the planes");
  command->add_flag("--drill", options->drill, "Mass is taken away, not added");
  command->add_option("--after", options->after, "Run-up before the weights of --applied went on")
      ->allow_extra_args(false);
  command
      ->add_option("--applied", options->applied,
                   "PLANE=MASS_G@DEG put on the rotor (or drilled) between the two runs; once for "
                   "each weight")
      ->allow_extra_args(false);
  command
      ->add_option("--top-rpm", options->top_rpm,
                   "Highest speed of correction and forecast; default: the rig's rated speed")
      ->check(CLI::Range(1.0, 1e6));
  command->add_option("--svg", options->svg_path, "Draw the orbits before and after over speed");
  command->add_option("--write-run-outs", options->run_outs_path,
                      "Controller file with the run-out of the probes that was found, which its "
                      "law then takes off: that of --controller, else the session's");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
