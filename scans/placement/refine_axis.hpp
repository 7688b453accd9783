// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "treadmark/model/shape/profile.hpp"
#include "treadmark/scans/placement/section_fit.hpp"

namespace treadmark::scans {

struct RefinedAxis {
  Pose X_CS;  ///< the surface frame in the cloud's; the origin along y (rail: the whole origin but its direction) as
              ///< before
  SectionFit fit;          ///< section about the refined axis
  double undamaged = 0.0;  ///< part of the points that followed the section and fixed the axis
  /// Of a wheel's axis: shifts along x and z of X_CS [m], turns about them [rad]. Of a rail's: turns about y and z.
  /// From the points' scatter about a section of which nothing is known; with how far it may still be on its way.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  /// Wheel: how the section that follows the points moves with those motions: its shift in v at y = 0, and its turn
  /// (dv/dy).
  Eigen::Matrix<double, 2, 4> section_moves = Eigen::Matrix<double, 2, 4>::Zero();
  double position_error = 0.0;   ///< standard errors by the covariance: wheel only [m]
  double direction_error = 0.0;  ///< [rad]
  int iterations = 0;
};

/// (y, v) of points in a frame.
std::vector<Vec2> across(std::span<const Vec3> points, Body body, const Pose& X_CS);

/// Turns and shifts the axis of a wheel, or turns the direction of a rail, until most of the points lie on one section:
/// robust Gauss-Newton steps in which the section follows (a spline along it is eliminated from the normal equations).
/// Damage and outliers lose their weight (Tukey's biweight). points: [m] in the cloud's frame; a few 10^5 are enough.
/// Errors: Error(input_data) if no section is found.
RefinedAxis refine_axis(std::span<const Vec3> points, Body body, const Pose& X_CS);

/// What is known of a wheel besides the points: what lacks of the section's place (shift in v at y [m], turn dv/dy
/// [rad]), each to a standard error; infinite: nothing is known of it.
struct KnownOfSection {
  double y = 0.0;
  Eigen::Vector2d lacking = Eigen::Vector2d::Zero(), error = Eigen::Vector2d::Zero();
};

/// Moves a refined axis to where it is most likely with that (least squares with the covariance of the axis) and fits
/// the section again. points: those that it was refined with.
void use_known(RefinedAxis& refined, const KnownOfSection& known, std::span<const Vec3> points);

}  // namespace treadmark::scans
