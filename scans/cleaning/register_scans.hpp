// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// How a scan was laid on those before it.
struct ScanMotion {
  std::uint16_t pass = 0;
  std::size_t points = 0;
  Pose motion;                                     ///< p' = motion p, both in the cloud's frame
  Vec3 shift = Vec3::Zero(), turn = Vec3::Zero();  ///< the same, about the scan's middle [m], [rad]
  double overlap = 0.0;                            ///< part of its surface that others have seen, too
  double apart = 0.0;                              ///< from these, where they overlap: standard deviation [m]
  double shift_error = 0.0, turn_error = 0.0;      ///< standard errors, of directions that are determined [m], [rad]
  std::size_t open = 0;  ///< directions of six in which the overlap tells nothing: there the scan stays where it is
};

/// Lays scans on each other by what they overlap with, the one with the largest overlap first on the largest scan:
/// nearest pieces of the surface, distances along both their normals (Chen and Medioni 1992; Rusinkiewicz 2019), robust
/// (Tukey's biweight), from far to near. What is left is some tenths of a millimetre at most, which find_pass_steps
/// evens out. farthest: that scans lie off each other [m]. passes: one number a point. Deterministic. Errors:
/// Error(input_data), with its number, for a scan whose overlap is too small, which does not settle, moves farther than
/// `farthest`, or does not fit.
std::vector<ScanMotion> register_scans(std::span<const Vec3> points, std::span<const std::uint16_t> passes,
                                       double farthest);

}  // namespace treadmark::scans
