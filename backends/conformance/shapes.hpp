// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::conformance {

/// A shape every backend is asked to represent, with a formula of its own that no backend uses.
struct Shape {
  std::string name;  ///< one word
  SurfaceSpec spec;  ///< the shape as users give it
  /// Distance-like function: 0 on the surface, > 0 outside the material; NaN where the profile ends.
  std::function<double(const Vec3&)> outside;
  double y_min, y_max;                        ///< ends of the profile, surface frame [m]
  double r_low, r_high;                       ///< wheel: radii, rail: heights between which brute force looks [m]
  double u_min, u_max;                        ///< part that is sampled: x [m] or theta [rad]
  std::vector<Pose> planes;                   ///< planes near the surface, in its frame
  std::function<NaturalSurface()> natural{};  ///< what is represented; without it made from spec
  bool varies = false;                        ///< more than one cross-section, though there is no damage
  double kinks = 0.0;                         ///< share of the points near a kink, which a smooth backend rounds off

  /// Whether it has one cross-section.
  bool constant() const { return spec.defects.empty() && !varies; }
};

/// The planes in which rails are looked at.
inline std::vector<Pose> rail_planes() {
  const auto pose = [](const Vec3& o, double roll, double yaw, double pitch) {
    return Pose{o, rotation({roll, yaw, pitch})};
  };
  return {pose({0.3, 0.001, -0.0004}, 0.0, 0.0, 0.0),    pose({0.0, 0.012, 0.0}, 0.07, 0.0, 0.0),
          pose({0.1, -0.02, 0.003}, -0.45, 0.03, -0.02), pose({0.0, 0.005, 0.001}, 0.02, -0.4, 0.1),
          pose({0.0, -0.03, 0.008}, -1.1, 0.01, 0.0),    pose({0.0, 0.03, 0.008}, 1.5, 1.3, 0.0)};
}

/// The same of wheels of a nominal radius [m]. The last two look from behind the flange, which hides its root; rows run
/// across the fold in the last one.
inline std::vector<Pose> wheel_planes(double radius) {
  const auto at = [radius](double theta, double y, double out, double roll, double yaw, double pitch) {
    const double r = radius + out;
    return Pose{{r * std::sin(theta), y, r * std::cos(theta)}, rotation({roll, yaw, pitch})};
  };
  return {at(0.0, 0.002, 0.0, 0.0, 0.0, 0.0),       at(0.02, 0.01, 0.001, 0.04, 0.0, 0.0),
          at(0.3, -0.005, 0.0, -0.05, 0.02, 0.3),   at(-0.01, -0.02, 0.002, -0.5, 0.01, 0.01),
          at(0.01, -0.03, 0.005, -1.05, 0.02, 0.0), at(0.0, -0.045, 0.02, 0.9, 0.0, 0.0),
          at(0.0, -0.045, 0.02, 0.9, 1.4, 0.0)};
}

/// Wheels, rails, rollers and rings, plain and damaged.
std::vector<Shape> shapes();

/// The shape as such a backend should have it: of Backend::one_place the section in the middle, everywhere.
Shape shape_for(const Backend& backend, Shape shape);

/// The shape by the backend of that name, from samples so far apart [m]; 0 = its own. Errors: those of represent.
std::shared_ptr<const Surface> represented(const Shape& shape, const std::string& backend, double resolution);

/// Formula of S1002 [mm], written from the standard once more.
double s1002_mm(double y);
/// The same of 60E1 [mm].
double rail_60e1_mm(double y);

/// The outermost place where a line along the normal of a plane meets a shape.
struct BruteHit {
  double z;      ///< its height over the plane [m]; NaN if there is none
  double slant;  ///< cosine between the normal of the surface and the line there [-]
  double y;      ///< of the place in the frame of the surface [m]
};
/// The outermost sign change of shape.outside over the point (x, y) of a plane, by steps of 0.1 mm and halving.
BruteHit brute_force(const Shape& shape, const Pose& X_SP, double x, double y);
/// Gradient of shape.outside by central differences.
Vec3 gradient(const Shape& shape, const Vec3& p);

}  // namespace treadmark::conformance
