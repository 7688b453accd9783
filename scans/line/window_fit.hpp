// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "treadmark/core/pose.hpp"
#include "treadmark/scans/placement/section.hpp"

namespace treadmark::scans {

/// Shift along y and z [m], roll, pitch and yaw about x, y and z [rad] of a frame in its own axes.
using FrameMotion = Eigen::Vector<double, 5>;

/// How a piece of rail lies in a frame.
struct WindowFit {
  FrameMotion motion = FrameMotion::Zero();  ///< of the frame, that lays the section on the points
  Eigen::Matrix<double, 5, 5> information = Eigen::Matrix<double, 5, 5>::Zero();  ///< inverse covariance of that
  double scale = 0.0;    ///< robust standard deviation of the points' distances from the section [m]
  double along = 0.0;    ///< middle of the points that count [m]
  std::size_t used = 0;  ///< points that count
};

/// Lays a section on points (x, y, z) of a frame in which it nearly lies: Gauss and Newton's steps with Tukey's
/// weights. reach: points farther from the section do not count [m]. turns: pitch and yaw too, about x = 0; else they
/// stay 0. Motions that the points say nothing of stay near 0. used is 0 where fewer than `fewest` points count.
WindowFit fit_window(std::span<const Vec3> points, const Section& section, double reach, bool turns,
                     std::size_t fewest = 50);

/// A frame after such a motion.
Pose moved(const Pose& frame, const FrameMotion& motion);

}  // namespace treadmark::scans
