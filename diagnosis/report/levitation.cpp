#include "diagnosis/report/levitation.hpp"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <sstream>

#include "analysis/poles.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::diagnosis {
namespace {

ReportLoop JudgeLoop(const plant::PlantConfig& plant, const LawOfRecords& at) {
  constexpr double kSameSpeed = 0.01;
  const double range = at.fastest_rad_per_s - at.slowest_rad_per_s;
  const bool varies = range > kSameSpeed * at.fastest_rad_per_s;
  const std::size_t speeds = varies ? kLevitationSpeeds : 1;
  ReportLoop loop{.levitates = true};
  double largest = 0.0;
  for (std::size_t i = 0; i < speeds; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kLevitationSpeeds - 1);
    const double speed = at.fastest_rad_per_s - share * range;
    const analysis::LoopPoles poles = analysis::ClosedLoopPoles(plant, at.law, speed);
    if (poles.stable || poles.largest_pole_modulus <= largest) continue;
    largest = poles.largest_pole_modulus;
    loop = {.levitates = false, .rpm = RadPerSToRpm(speed), .why = analysis::WhyUnstable(poles)};
  }
  return loop;
}

/// What `judge` says, or why it cannot.
template <class Judge>
ReportLoop Judged(const Judge& judge) {
  try {
    return judge();
  } catch (const std::exception& reason) {
    return {.levitates = std::nullopt, .why = reason.what()};
  }
}

/// Of a rig file's text as a program will read it.
ReportLoop JudgeText(const std::string& text, const char* name, const LawOfRecords& at) {
  return Judged([&] { return JudgeLoop(configuration::ParseRig(text, name).plant, at); });
}

std::string SpeedText(double from_rpm, double to_rpm) {
  if (to_rpm <= 0.0) return "at rest";
  return from_rpm < to_rpm ? fmt::format("from {:.0f} to {:.0f} rpm", from_rpm, to_rpm)
                           : fmt::format("at {:.0f} rpm", to_rpm);
}

/// Nothing for a file that levitates.
std::string SentenceOf(const char* file, const ReportLoop& loop, const ReportLevitation& of) {
  const std::string speeds = SpeedText(of.from_rpm, of.to_rpm);
  if (!loop.levitates) {
    return fmt::format("Whether {} levitates under the law {} {} was not judged: {}.", file, of.law,
                       speeds, loop.why);
  }
  if (*loop.levitates) return {};
  const char* file_too =
      of.rig_file.levitates.value_or(true)
          ? "The rig file as given does levitate: a calibrated number or a cause is wrong"
          : "Nor does the rig file as given: it, or the law named, is not that of the records";
  return fmt::format("{} DOES NOT LEVITATE under the law {} (closed-loop poles {}): {} {}. {}.",
                     file, of.law, speeds, SpeedText(loop.rpm, loop.rpm), loop.why, file_too);
}

std::string SentenceOfUnknown(const KnownLaws& known) {
  if (known.without.empty()) return {};
  std::string names = "the records";
  if (!known.laws.empty()) {
    names.clear();
    for (const std::string& path : known.without) {
      names += (names.empty() ? "" : ", ") + std::filesystem::path(path).filename().string();
    }
  }
  return fmt::format(
      "Whether extended_rig.yaml and calibrated_rig.yaml levitate under the law of {} was not "
      "judged: neither record nor rig file names one (key run, controller).",
      names);
}

/// At the head of a rig file: the sentence, broken into lines.
std::string Comment(const std::string& sentence) {
  constexpr std::size_t kWidth = 96;
  std::istringstream words(sentence);
  std::string comment;
  std::string line = "#";
  for (std::string word; words >> word;) {
    if (line.size() + word.size() > kWidth) {
      comment += line + '\n';
      line = "#";
    }
    line += ' ' + word;
  }
  return comment + line + '\n';
}

void Say(const std::string& sentence, const std::vector<std::string*>& files,
         DiagnosisReport& report) {
  if (sentence.empty()) return;
  report.levitation.sentences.push_back(sentence);
  for (std::string* file : files) *file = Comment(sentence) + *file;
}

void Judge(const configuration::RigFile& rig, const LawOfRecords& at, DiagnosisReport& report) {
  ReportLevitation of{.law = at.name,
                      .from_rpm = RadPerSToRpm(at.slowest_rad_per_s),
                      .to_rpm = RadPerSToRpm(at.fastest_rad_per_s)};
  of.rig_file = Judged([&] { return JudgeLoop(rig.plant, at); });
  of.extended_rig = JudgeText(report.extended_rig, "extended_rig.yaml", at);
  of.calibrated_rig = JudgeText(report.calibrated_rig, "calibrated_rig.yaml", at);
  report.levitation.by_law.push_back(of);
  Say(SentenceOf("calibrated_rig.yaml", of.calibrated_rig, of), {&report.calibrated_rig}, report);
  Say(SentenceOf("extended_rig.yaml", of.extended_rig, of), {&report.extended_rig}, report);
}

}  // namespace

void JudgeLevitation(const configuration::RigFile& rig, const KnownLaws& known,
                     DiagnosisReport& report) {
  if (report.extended_rig.empty() || report.calibrated_rig.empty()) return;
  report.levitation.records_without_law = known.without;
  for (LawOfRecords at : known.laws) {
    at.slowest_rad_per_s = std::min(at.slowest_rad_per_s, at.fastest_rad_per_s);
    Judge(rig, at, report);
  }
  Say(SentenceOfUnknown(known), {&report.extended_rig, &report.calibrated_rig}, report);
}

}  // namespace levitas::diagnosis
