// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

namespace treadmark::io::profiles {

/// Points of one profile while it is being read: file units at first, mm at the end of the clean-up. There is at most
/// one point in a line, so the limit on lines limits them too.
struct RawPoints {
  std::string file;
  std::vector<double> y, z;
  std::vector<int> line;  ///< where each point stands in the file

  std::size_t size() const { return y.size(); }

  void add(double y_value, double z_value, int line_number) {
    y.push_back(y_value);
    z.push_back(z_value);
    line.push_back(line_number);
  }

  void truncate(std::size_t count) {
    y.resize(count);
    z.resize(count);
    line.resize(count);
  }
};

}  // namespace treadmark::io::profiles
