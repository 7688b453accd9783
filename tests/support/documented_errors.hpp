// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace treadmark::testing {

/// Compares computed errors with the row "| name | n | e1 | e2 |" of docs/convergence.md, which shows two digits.
inline void expect_documented(const std::string& name, int n, const std::vector<double>& errors) {
  std::ifstream file(std::string(TREADMARK_SOURCE_DIR) + "/docs/convergence.md");
  std::ostringstream expected;
  expected.precision(1);
  expected << std::scientific << "| " << name << " | " << n << " |";
  for (const double e : errors) expected << ' ' << e << " |";
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string bar, found;
    int count = 0;
    if (!(words >> bar >> found >> bar >> count) || found != name || count != n) continue;
    for (const double e : errors) {
      double printed = 0.0;
      ASSERT_TRUE(words >> bar >> printed) << "docs/convergence.md should read\n" << expected.str();
      // Half a unit of the second digit, and a little for the last bits of the transforms.
      EXPECT_NEAR(printed, e, 0.052 * std::pow(10.0, std::floor(std::log10(std::abs(e)))))
          << "docs/convergence.md should read\n"
          << expected.str();
    }
    return;
  }
  ADD_FAILURE() << "docs/convergence.md lacks the row\n" << expected.str();
}

}  // namespace treadmark::testing
