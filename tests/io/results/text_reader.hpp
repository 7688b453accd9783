// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace treadmark::testing {

/// A text of numbers as numerical tools load it: rows without the lines that begin with a percent sign, and the names
/// on those.
struct NumberText {
  std::vector<std::vector<std::string>> names;
  std::vector<std::vector<double>> rows;
};

inline NumberText read_numbers(const std::string& text) {
  NumberText out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool head = line.starts_with("%");
    std::istringstream words(head ? line.substr(1) : line);
    (head ? static_cast<void>(out.names.emplace_back()) : static_cast<void>(out.rows.emplace_back()));
    for (std::string word; words >> word;) {
      if (head) {
        out.names.back().push_back(word);
        continue;
      }
      char* end = nullptr;
      out.rows.back().push_back(std::strtod(word.c_str(), &end));
      if (*end != '\0') throw std::runtime_error("not a number: " + word);
    }
  }
  return out;
}

}  // namespace treadmark::testing
