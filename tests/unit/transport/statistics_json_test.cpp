#include "transport/statistics_json.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::transport {
namespace {

TEST(HistogramJson, CarriesCountPercentilesAndMaximum) {
  Histogram histogram;
  for (int value = 1; value <= 10; ++value) histogram.Add(value);  // below 16 ns bins are exact
  const auto json = HistogramJson(histogram);
  EXPECT_EQ(json.at("count"), 10);
  EXPECT_EQ(json.at("p50_ns"), 5.0);
  EXPECT_EQ(json.at("p99_ns"), 10.0);
  EXPECT_EQ(json.at("max_ns"), 10);
}

TEST(WriteJson, BeginsWithItsKindAndTheVersion) {
  const test::ScratchFolder folder;
  WriteJson("plant", {{"a", 1}}, folder / "p.json");
  std::ifstream file(folder / "p.json");
  const auto json = nlohmann::ordered_json::parse(file);
  EXPECT_EQ(json.begin().key(), "schema");
  EXPECT_EQ(json.at("schema"), "levitas_plant_1");
  EXPECT_FALSE(json.at("version").get<std::string>().empty());
  EXPECT_EQ(json.at("a"), 1);
}

TEST(WriteJson, NamesTheFileItCannotWrite) {
  try {
    WriteJson("plant", {{"a", 1}}, "/no/such/folder/statistics.json");
    FAIL() << "nothing was thrown";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kOther);
    EXPECT_NE(std::string(problem.what()).find("/no/such/folder/statistics.json"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace levitas::transport
