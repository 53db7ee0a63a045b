// What amb identify live writes: the record of convergence and the JSON, from rows fed by hand.

#include "cli/study/identify/live_report.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;
using identification::ConvergencePoint;

constexpr std::uint64_t kLiveWindow = 200;  ///< rows: 0.02 s of the rig's 10 kHz

/// One axis that follows its current; what is fed is told to the report, point by point.
class LiveReportTest : public testing::Test {
 protected:
  LiveReportTest() {
    const configuration::RigFile rig =
        configuration::LoadRig(configuration::FindConfig("one_axis", "rigs"));
    session::SessionHeader header;
    header.rig_yaml = configuration::WriteRig(rig);
    header.channels = rig.numbers.channels;
    header.period_ns = rig.numbers.period_ns;
    live_.Take(header);
    testing::internal::CaptureStdout();
  }
  ~LiveReportTest() override { (void)testing::internal::GetCapturedStdout(); }

  static identification::LiveOptions TwoSections() {
    identification::LiveOptions options;
    options.model.order = 2;
    options.model.noise_order = 0;
    options.model.degree = 3;
    options.window_s = 0.02;
    return options;
  }

  /// Rows up to `last`, but for one that never came.
  void Feed(LiveReport& report, std::uint64_t last, std::uint64_t missing = 0) {
    report_ = &report;
    for (; cycle_ < last; ++cycle_) {
      const double current_a = normal_(random_);
      position_ = 0.9 * position_ + 1e-6 * before_a_;
      before_a_ = current_a;
      if (cycle_ == missing) continue;
      live_.recursion()->Take(cycle_, Eigen::VectorXd::Constant(1, current_a),
                              Eigen::VectorXd::Constant(1, position_));
    }
  }

  std::vector<fs::path> Written() const {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(fs::path(folder_ / ".")))
      paths.push_back(entry.path());
    return paths;
  }

  static std::vector<std::vector<std::string>> Cells(const fs::path& path) {
    std::vector<std::vector<std::string>> lines;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      lines.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) lines.back().push_back(cell);
    }
    return lines;
  }

  test::ScratchFolder folder_;
  std::vector<ConvergencePoint> points_;
  LiveReport* report_{};
  identification::LiveIdentification live_{TwoSections(), [this](const ConvergencePoint& point) {
                                             points_.push_back(point);
                                             report_->Add(live_, point);
                                           }};
  std::mt19937_64 random_{81};
  std::normal_distribution<double> normal_;
  std::uint64_t cycle_{1};
  double position_{}, before_a_{};
};

TEST_F(LiveReportTest, RecordHasItsColumnsAndALinePerPoint) {
  const std::string path = folder_ / "convergence.csv";
  LiveReport report(path);
  Feed(report, 1500, 700);
  report.Finish(live_, 0.5);
  const std::vector<std::string> columns{"time_s",
                                         "cycle",
                                         "rows",
                                         "largest_change",
                                         "error_mass_x_m",
                                         "fit_mass_x_percent",
                                         "curve2_mass_x_1_per_a",
                                         "curve3_mass_x_1_per_a2",
                                         "gaps",
                                         "missing_rows",
                                         "pauses",
                                         "begun_anew",
                                         "converged"};
  const auto lines = Cells(path);
  ASSERT_GE(points_.size(), 5U);
  ASSERT_EQ(lines.size(), points_.size() + 1);
  EXPECT_EQ(lines[0], columns);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto& cells = lines[i + 1];
    ASSERT_EQ(cells.size(), columns.size());
    EXPECT_NEAR(std::stod(cells[0]), 1e-4 * static_cast<double>(points_[i].cycle), 1e-6);
    EXPECT_EQ(std::stoull(cells[1]), points_[i].cycle);
    EXPECT_EQ(std::stoull(cells[2]), points_[i].rows);
    EXPECT_EQ(std::stod(cells[3]), points_[i].change);  // read back to the last bit
    EXPECT_EQ(std::stod(cells[4]), points_[i].error_rms[0]);
    EXPECT_EQ(std::stod(cells[5]), points_[i].fit_percent[0]);
    EXPECT_EQ(cells[8], points_[i].cycle > 700 ? "1" : "0");
    EXPECT_EQ(cells[9], cells[8]);  // one row in the only gap
    EXPECT_EQ(cells[12], points_[i].converged ? "1" : "0");
  }
}

TEST_F(LiveReportTest, RecordGetsItsNameAtFinishAndIsReadBesideItUntilThen) {
  const fs::path path = folder_ / "convergence.csv";
  LiveReport report(path);
  Feed(report, 1000);
  ASSERT_FALSE(points_.empty());
  EXPECT_FALSE(fs::exists(path));
  ASSERT_EQ(Written().size(), 1U);
  EXPECT_EQ(Cells(Written().front()).size(), points_.size() + 1);  // every line at once
  report.Finish(live_, 0.5);
  EXPECT_EQ(Written(), std::vector<fs::path>{Written().front().parent_path() / path.filename()});
}

TEST_F(LiveReportTest, WithoutFinishLeavesNothing) {
  {
    LiveReport report(folder_ / "convergence.csv");
    Feed(report, 1000);
  }
  EXPECT_TRUE(Written().empty());
}

TEST_F(LiveReportTest, WithoutAPathWritesNothing) {
  const fs::path before = fs::current_path();
  fs::current_path(fs::path(folder_ / "."));
  LiveReport report("");
  Feed(report, 1000);
  report.Finish(live_, 0.5);
  fs::current_path(before);
  EXPECT_TRUE(Written().empty());
  EXPECT_EQ(report.Json(live_, 0.5)["points"].size(), points_.size());
}

TEST_F(LiveReportTest, JsonHasThePointsAndTheNewestIsTheLastOfThem) {
  LiveReport report("");
  Feed(report, 1500, 700);
  const auto json = report.Json(live_, 0.5);
  ASSERT_EQ(json["points"].size(), points_.size());
  const auto& last = json["points"].back();
  std::vector<std::string> keys;
  for (const auto& item : last.items()) keys.push_back(item.key());
  EXPECT_EQ(keys, (std::vector<std::string>{"time_s", "rows", "largest_change_percent",
                                            "error_rms_m", "fit_percent", "converged"}));
  const ConvergencePoint& newest = points_.back();
  EXPECT_NEAR(last["time_s"].get<double>(), 1e-4 * static_cast<double>(newest.cycle), 1e-9);
  EXPECT_EQ(last["rows"], newest.rows);
  EXPECT_DOUBLE_EQ(last["largest_change_percent"].get<double>(), 100.0 * newest.change);
  EXPECT_EQ(last["error_rms_m"], (std::vector<double>{newest.error_rms[0]}));
  EXPECT_EQ(last["converged"], newest.converged);
  EXPECT_EQ(json["converged"], newest.converged);
  EXPECT_EQ(json["first_cycle"], 1);
  EXPECT_EQ(json["last_cycle"], 1499);
  EXPECT_EQ(json["gaps"], 1);
  EXPECT_EQ(json["missing_rows"], 1);
  // Of 1499 cycles one never came; the others were learnt or filled the past.
  EXPECT_EQ(json["rows"].get<int>() + json["filling_rows"].get<int>(), 1498);
  EXPECT_DOUBLE_EQ(json["rows_per_computing_s"].get<double>(), 2.0 * json["rows"].get<double>());
  EXPECT_GT(points_.front().rows, kLiveWindow - 1);
}

}  // namespace
}  // namespace levitas::cli
