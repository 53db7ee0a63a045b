// amb report: a recorded session as one HTML page with pictures.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/critical_speeds_text.hpp"
#include "cli/commands/report_command.hpp"
#include "cli/json_file.hpp"
#include "cli/png_pictures.hpp"
#include "cli/text_file.hpp"
#include "common/rotational_speed.hpp"
#include "report/session/page.hpp"
#include "report/session/run_model.hpp"
#include "session/log/output_path.hpp"
#include "verdict/commission.hpp"
#include "verdict/report.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::string session_path;
  std::string html_path;
  std::string picture_folder;
  std::string run_json_path;
  std::string json_path;
  std::vector<double> speeds_rpm;
};

/// Durations of the loop from the file that `amb run --json` wrote.
std::vector<verdict::DurationFigures> DurationsOf(const std::string& path) {
  std::vector<verdict::DurationFigures> durations;
  if (path.empty()) return durations;
  std::ifstream file(path);
  const auto json = nlohmann::ordered_json::parse(file, nullptr, false);
  const auto all = nlohmann::ordered_json::json_pointer("/timing/durations");
  if (json.is_discarded() || !json.is_object() || !json.contains(all) || !json[all].is_object()) {
    throw BadInput(path + ": not what amb run --json writes (no timing.durations)");
  }
  for (const auto& [name, figures] : json[all].items()) {
    verdict::DurationFigures one;
    one.name = name;
    one.count = figures.value("count", std::uint64_t{0});
    if (one.count == 0) continue;
    one.p50_ns = figures.value("p50_ns", 0.0);
    one.p99_ns = figures.value("p99_ns", 0.0);
    one.p999_ns = figures.value("p999_ns", 0.0);
    one.max_ns = figures.value("max_ns", 0.0);
    durations.push_back(std::move(one));
  }
  return durations;
}

/// SVG and, where the converter is, PNG; whether it is.
bool WritePictures(const std::string& folder, const std::vector<report::NamedPicture>& pictures) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  std::vector<std::string> names;
  names.reserve(pictures.size());
  for (const report::NamedPicture& picture : pictures) {
    svg::Write((fs::path(folder) / (picture.name + ".svg")).string(), picture.figure);
    names.push_back(picture.name);
  }
  const std::string converter = FindSvgConverter();
  if (!converter.empty()) WritePngs(converter, folder, names);
  fmt::print("{}: {} pictures as SVG{}\n", folder, names.size(),
             converter.empty()
                 ? "; for PNG as well: apt-get install librsvg2-bin (rsvg-convert is not here)"
                 : " and PNG");
  return !converter.empty();
}

/// The verdict of the session, and the pictures of the model it is judged by.
void AddVerdict(const report::Recording& recording, report::PageInput& input) {
  verdict::CommissionOptions judge;
  judge.session_path = input.session_path;
  judge.provenance.session_file = input.session_path;
  input.verdict = verdict::Commission(judge);
  const report::RunModel model = report::ModelOf(recording.header, *input.verdict);
  input.levitated = model.levitated;
  input.pictures = report::ModelPictures(model, *input.verdict);
}

nlohmann::ordered_json MadeJson(const ReportOptions& options, const report::PageInput& input,
                                bool png, std::uint64_t cycles) {
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (const auto& picture : input.pictures) names.push_back(picture.name);
  return {{"session", options.session_path},
          {"report", options.html_path},
          {"pictures", names},
          {"png", png},
          {"verdict", input.verdict ? nlohmann::ordered_json(verdict::Name(input.verdict->outcome))
                                    : nlohmann::ordered_json()},
          {"judgement", input.verdict ? verdict::Json(*input.verdict) : nlohmann::ordered_json()},
          {"critical_speeds", input.levitated ? CriticalSpeedsJson(*input.levitated)
                                              : nlohmann::ordered_json::array()},
          {"cycles", cycles}};
}

ExitStatus Report(const ReportOptions& options) {
  for (const std::string& path : {options.html_path, options.json_path}) {
    session::CheckOutputPath(path, options.session_path);
  }
  report::PageInput input;
  input.durations = DurationsOf(options.run_json_path);
  input.session_path = options.session_path;
  const report::Recording recording = report::Load(options.session_path);
  if (!recording.header.controller_yaml.empty()) AddVerdict(recording, input);
  report::PictureOptions pictures;
  for (const double speed_rpm : options.speeds_rpm) {
    pictures.speeds_rad_per_s.push_back(RpmToRadPerS(speed_rpm));
  }
  for (auto& picture : report::Pictures(recording, pictures)) {
    input.pictures.push_back(std::move(picture));
  }
  WriteTextFile(options.html_path, report::Page(recording, input));
  fmt::print("{}: {} pictures, {:.0f} kB\n", options.html_path, input.pictures.size(),
             static_cast<double>(fs::file_size(options.html_path)) * 1e-3);
  const bool png =
      !options.picture_folder.empty() && WritePictures(options.picture_folder, input.pictures);
  if (!recording.damage.empty()) {
    fmt::print("Not everything could be read: {}.\n", recording.damage);
  }
  if (input.verdict) {
    for (const std::string& warning : input.verdict->warnings) fmt::print("WARNING: {}\n", warning);
    fmt::print("{}\n", input.verdict->sentence);
  }
  WriteJsonFile(options.json_path, MadeJson(options, input, png, recording.records));
  return ExitStatus::kDone;
}

}  // namespace

void AddReportCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand(
      "report",
      "A recorded session as one HTML page: verdict, sensitivity, critical speeds, orbits, events");
  command->add_option("SESSION", options->session_path, "Session file")->required();
  command->add_option("--out", options->html_path, "The page; needs nothing beside it")->required();
  command->add_option(
      "--pictures", options->picture_folder,
      "Also write each picture into this folder, as SVG and (with rsvg-convert) PNG");
  command
      ->add_option("--speeds", options->speeds_rpm,
                   "Speeds of the orbits [rpm]; default: standing, largest synchronous vibration, "
                   "top speed")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--run-json", options->run_json_path,
                      "File of amb run --json: adds the loop's durations to the page");
  command->add_option("--json", options->json_path, "Write what was made to this file");
  command->callback([options, &action] { action = [options] { return Report(*options); }; });
  command->footer(
      "  amb run --scenario run_up_6000 --record run.lcm --json run.json\n"
      "  amb report run.lcm --run-json run.json --out run.html --speeds 0,3000,6000");
}

}  // namespace levitas::cli
