#pragma once
// Reads a file of tests/data/reference: one header line, then numbers.

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>
#include "tests/support/paths.hpp"

namespace levitas::test {

[[nodiscard]] inline std::vector<std::vector<double>> ReadReference(const std::string& name) {
  std::ifstream file(levitas::test::DataFolder() + "/reference/" + name);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("no reference file " + name);
  std::vector<std::vector<double>> rows;
  while (std::getline(file, line)) {
    std::vector<double> row;
    std::stringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace levitas::test
