// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"
#include "treadmark/backends/spline/thb/thb_spline.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/spline_surface.hpp"

namespace treadmark::spline {

/// A surface given by its splines, as they stand in a file: s and t are its own parameters, in its own order.
/// Immutable.
class GivenSpline {
 public:
  /// data must outlive it. Errors: Error(input_data) that names the surface: those of check(SplineSurface), and of
  /// hierarchical ones numbers of coefficients that do not fit the basis, levels that do not hold each other or have
  /// cells but no function, boxes outside of their level or that cut its cells, far more cells than coefficients.
  explicit GivenSpline(const SplineSurface& data);
  explicit GivenSpline(SplineSurface&&) = delete;

  const std::string& name() const { return data_->name; }
  bool hierarchical() const { return thb_.has_value(); }
  std::array<int, 2> degrees() const { return {data_->levels.front()[0].degree, data_->levels.front()[1].degree}; }
  /// The coarsest intervals, from the least to the greatest parameter; direction 0: s, 1: t.
  const std::vector<double>& breaks(int direction) const { return breaks_[static_cast<std::size_t>(direction)]; }
  /// Clamped to the ends [m].
  Vec3 point(double s, double t) const { return hierarchical() ? thb_->point(s, t) : evaluate(*data_, s, t).p; }

  /// The same surface as bicubic patches with u along a rail or with the angle of a wheel, v the mean length across
  /// [m], and both such that the surface faces the other body: exactly for degrees up to 3, rational or not; of a
  /// higher one polynomials within kCubicsWithin. off, if not null: how far these lie off at the middles of patches and
  /// at three places of two of their sides, 0 where they are exact [m]. Errors: Error(input_data) for a surface that
  /// runs neither along nor across, is seen edge-on, folds back or crosses itself, has no normal, goes round more than
  /// once, is larger than 20 m2, or needs more than kMostPatches.
  NurbsNet net(Body body, double* off = nullptr) const;

 private:
  using QuadPiece = std::array<std::array<Quad, kMostDegree + 1>, kMostDegree + 1>;  // [along s][along t]
  using Breaks = std::array<std::vector<double>, 2>;
  /// How the parameters lie on a rail or wheel.
  struct Layout {
    bool swapped = false, back_u = false, back_v = false;  ///< u is t; runs against it
    double u_from = 0.0, u_to = 0.0, v_to = 0.0;
  };

  Layout layout(Body body) const;
  ThbSpline hierarchy() const;
  QuadPiece exact_piece(const KnotLine& s, const KnotLine& t, int is, int it) const;
  QuadPiece near_piece(const Breaks& at, std::size_t is, std::size_t it) const;
  Breaks cubic_breaks(double& off) const;
  NurbsNet tensor_net(const Layout& layout, double& off) const;
  NurbsNet hierarchical_net(const Layout& layout) const;
  void require_area(double area) const;
  void require_sound(const NurbsNet& net) const;
  [[noreturn]] void refuse(const std::string& what, const std::string& advice = {}) const;

  const SplineSurface* data_;
  Breaks breaks_;
  std::optional<ThbSpline> thb_;
};
inline constexpr double kCubicsWithin = 1e-8;  ///< [m]
inline constexpr std::size_t kMostPatches = 4'000'000;

}  // namespace treadmark::spline
