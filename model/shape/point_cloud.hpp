// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark {

/// Points of a scanner in the frame and unit of their file, in the order of the file.
struct PointCloud {
  std::string name;          ///< where it comes from, for messages
  std::vector<Vec3> points;  ///< finite
  std::vector<Eigen::Vector3f>
      normals;                        ///< unit vectors as the file has them, or empty; no promise which way they point
  std::vector<std::uint16_t> passes;  ///< which pass of the scanner took the point, or empty (one pass)
};

}  // namespace treadmark
