#pragma once
/// The tables of validation/reference, by column name.

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "validation/support/installation.hpp"

namespace treejet {

struct Reference {
  /// Of input-1.csv, input-2.csv, input-3.csv: one row a print time, row 0 the start.
  explicit Reference(const std::string& file) {
    std::ifstream in(source_tree() + "/validation/reference/" + file);
    if (!in) throw std::runtime_error("cannot read " + file);
    std::string line, word;
    std::getline(in, line);  // where it comes from
    std::getline(in, line);
    std::vector<std::string> names;
    for (std::istringstream words(line); std::getline(words, word, ',');) names.push_back(word);
    while (std::getline(in, line)) {
      std::size_t k = 0;
      for (std::istringstream words(line); std::getline(words, word, ',');)
        columns[names.at(k++)].push_back(std::stod(word));
    }
  }

  const std::vector<double>& operator[](const std::string& name) const { return columns.at(name); }
  double operator()(const std::string& name, std::size_t row) const { return columns.at(name).at(row); }

  std::map<std::string, std::vector<double>> columns;
};

/// Half a unit in the last of the `digits` significant digits that a value was printed with.
inline double half_a_digit(double value, int digits) {
  return 0.5 * std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits + 1);
}

}  // namespace treejet
