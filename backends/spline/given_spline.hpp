// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"
#include "treadmark/backends/spline/thb/knot_line.hpp"
#include "treadmark/backends/spline/thb/thb_spline.hpp"
#include "treadmark/model/spline_surface.hpp"
#include "treadmark/model/surface_spec.hpp"

namespace treadmark::spline {

/// A surface given by its splines, as they stand in a file: s and t are its own parameters, in its own order.
/// Immutable.
class GivenSpline {
 public:
  /// Errors: Error(input_data) that names the surface: numbers of coefficients that do not fit the basis, degrees other
  /// than 1 to 3, knots that fall, levels that do not hold each other or have cells but no function, boxes outside of
  /// their level or that cut its cells, far more cells than coefficients, weights that are not positive.
  explicit GivenSpline(const SplineSurface& data);

  const std::string& name() const { return name_; }
  bool hierarchical() const { return std::holds_alternative<ThbSpline>(spline_); }
  std::array<int, 2> degrees() const { return {line(0).degree(), line(1).degree()}; }
  /// The coarsest intervals, from the least to the greatest parameter; direction 0: s, 1: t.
  const std::vector<double>& breaks(int direction) const { return line(direction).breaks(); }
  /// Clamped to the ends [m].
  Vec3 point(double s, double t) const;

  /// The same surface as bicubic patches with u along a rail or with the angle of a wheel, v the mean length across
  /// [m], and both such that the surface faces the other body. Errors: Error(input_data) for a surface that runs
  /// neither along nor across, is seen edge-on, folds back or crosses itself, has no normal, goes round more than once,
  /// or is larger than 20 m2.
  NurbsNet net(Body body) const;

 private:
  struct Tensor {
    KnotLine s, t;
    std::vector<Quad> points;  ///< homogeneous, index = i + functions of s * j
    bool rational;
  };
  using QuadPiece = std::array<std::array<Quad, kMostDegree + 1>, kMostDegree + 1>;  // [along s][along t]
  /// How the parameters lie on a rail or wheel.
  struct Layout {
    bool swapped = false, back_u = false, back_v = false;  ///< u is t; runs against it
    double u_from = 0.0, u_to = 0.0, v_to = 0.0;
  };

  const KnotLine& line(int direction) const;
  Layout layout(Body body) const;
  ThbSpline hierarchy(const SplineSurface& data) const;
  QuadPiece piece(const Tensor& spline, int is, int it) const;
  NurbsNet tensor_net(const Tensor& spline, const Layout& layout) const;
  NurbsNet hierarchical_net(const ThbSpline& spline, const Layout& layout) const;
  void require_sound(const NurbsNet& net) const;
  [[noreturn]] void refuse(const std::string& what, const std::string& advice = {}) const;

  std::string name_;
  SourcePosition where_;
  std::variant<std::monostate, Tensor, ThbSpline> spline_;
};

}  // namespace treadmark::spline
