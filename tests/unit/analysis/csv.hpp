#pragma once
// Reference tables: a header line, then rows of numbers.

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace levitas::test {

/// Rows of tests/data/reference/<name>; throws when the file is not there.
inline std::vector<std::vector<double>> ReferenceTable(const std::string& name) {
  std::ifstream file(std::string(LEVITAS_TEST_DATA) + "/reference/" + name);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("cannot read reference " + name);
  std::vector<std::vector<double>> rows;
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::string cell;
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace levitas::test
