#pragma once
// A table of the data folder: columns of numbers by name.
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace pigment::test {

inline std::map<std::string, std::vector<double>> read_table(const std::string& name) {
  std::ifstream in(std::string(PIGMENT_SOURCE_DIR) + "/data/resistance/" + name);
  std::string line, cell;
  std::getline(in, line);
  std::vector<std::string> names;
  for (std::stringstream s(line); std::getline(s, cell, ',');) {
    while (!cell.empty() && cell.back() == '\r') cell.pop_back();
    names.push_back(cell);
  }
  std::map<std::string, std::vector<double>> table;
  while (std::getline(in, line)) {
    std::stringstream s(line);
    for (std::size_t k = 0; std::getline(s, cell, ','); ++k) table[names.at(k)].push_back(std::stod(cell));
  }
  return table;
}

}  // namespace pigment::test
