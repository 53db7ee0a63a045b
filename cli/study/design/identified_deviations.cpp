#include "cli/study/design/identified_deviations.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/problem.hpp"

namespace levitas::cli {

uncertainty::IdentifiedDeviations ReadIdentifiedDeviations(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw BadInput(path + ": cannot be opened; give the file of amb identify modal --json");
  uncertainty::IdentifiedDeviations out;
  try {
    const auto json = nlohmann::json::parse(file);
    for (const auto& mode : json.at("modes")) {
      if (!mode.at("shown_by_the_data").get<bool>()) break;
      out.frequency_hz.push_back(mode.at("frequency_sigma_hz").get<double>());
      out.damping_share.push_back(mode.at("damping_sigma").get<double>() /
                                  mode.at("damping_ratio").get<double>());
    }
    for (const auto& axis : json.at("axes")) {
      out.current_gain.push_back(axis.at("ki_sigma_n_per_a").get<double>() /
                                 axis.at("ki_n_per_a").get<double>());
      out.stiffness.push_back(axis.at("ks_sigma_n_per_m").get<double>() /
                              axis.at("ks_n_per_m").get<double>());
    }
  } catch (const nlohmann::json::exception& problem) {
    throw BadInput(path + ": not what amb identify modal --json writes (" + problem.what() + ")");
  }
  return out;
}

}  // namespace levitas::cli
