// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::testing {

/// A shape every backend is asked to represent, with a formula of its own that no backend uses.
struct Shape {
  std::string name;
  SurfaceSpec spec;
  /// Distance-like function: 0 on the surface, > 0 outside the material; NaN where the profile ends.
  std::function<double(const Vec3&)> outside;
  double y_min, y_max;                        ///< ends of the profile, surface frame [m]
  double r_low, r_high;                       ///< wheel: radii, rail: heights between which brute force looks [m]
  double u_min, u_max;                        ///< part that is sampled: x [m] or theta [rad]
  std::vector<Pose> planes;                   ///< planes near the surface, in its frame
  std::function<NaturalSurface()> natural{};  ///< what is represented; without it made from spec
  bool varies = false;                        ///< more than one cross-section, though there is no damage
};

/// How a backend joins the suite, and what it promises.
struct Tolerance {
  double height;     ///< greatest error normal to the surface [m]
  double slope;      ///< greatest error of the normal's direction against the formula [rad]
  double curvature;  ///< relative error of principal curvatures, for most points
};
struct Contestant {
  std::string backend;
  double resolution;                                      ///< of its samples [m], 0 = its own
  Tolerance constant;                                     ///< for shapes of one cross-section
  Tolerance damaged;                                      ///< for shapes with defects
  bool facets() const { return backend == "mesh-flat"; }  ///< slopes jump everywhere
  bool chords() const { return backend == "chords"; }     ///< they jump from chord to chord across
  bool creases() const { return facets() || chords() || backend == "offset-bilinear"; }
};

struct Subject {
  Shape shape;
  Contestant contestant;
  const Tolerance& tolerance() const {
    return shape.spec.defects.empty() && !shape.varies ? contestant.constant : contestant.damaged;
  }
  std::shared_ptr<const Surface> make() const;
};

std::vector<Shape> shapes();
std::vector<Contestant> contestants();
std::vector<Subject> subjects();
std::ostream& operator<<(std::ostream& out, const Subject& subject);

/// Formulas [mm], written from the standards once more.
double s1002_mm(double y);
double rail_60e1_mm(double y);

/// Height of the outermost sign change of shape.outside along the normal of a plane; NaN if there is none. slant is the
/// cosine between the normal of the surface and the line there.
struct BruteHit {
  double z, slant, y;
};
BruteHit brute_force(const Shape& shape, const Pose& X_SP, double x, double y);
/// Gradient of shape.outside by central differences.
Vec3 gradient(const Shape& shape, const Vec3& p);

}  // namespace treadmark::testing
