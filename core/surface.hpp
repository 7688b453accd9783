// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/grid.hpp"

namespace treadmark {

/// Which way a surface faces; it decides which of several hits of a fold is the outermost one.
enum class Facing {
  up,    ///< rail-like: material on the +z side, seen from -z; the outermost hit has the least height
  down,  ///< wheel-like: material on the -z side, seen from +z; the outermost hit has the greatest height
};

/// Results wanted of Surface::heights, each of size grid.size() or empty (not wanted).
/// A grid point over which there is no surface gets quiet NaN in every array.
struct HeightsOut {
  std::span<double> z;     ///< height along the plane normal [m]
  std::span<double> dzdx;  ///< slope along x in the plane frame [-]
  std::span<double> dzdy;  ///< slope along y [-]
};

/// Whether inverse evaluation found a point.
enum class LocateStatus : std::uint8_t {
  converged,
  outside,    ///< no surface over this point
  ambiguous,  ///< several hits; the outermost one is returned
};

/// What inverse evaluation finds at one point.
struct SurfacePoint {
  LocateStatus status = LocateStatus::outside;
  double u = 0.0;  ///< longitudinal parameter: x [m] of a rail, theta [rad] of a wheel
  double v = 0.0;  ///< lateral parameter, the backend's own
  /// Along the profile of a rail [m], growing with y, zero where the profile's data have it; NaN if it does not tell.
  double arc_length = std::numeric_limits<double>::quiet_NaN();
  Vec3 position_S = Vec3::Zero();  ///< [m], surface frame
  Vec3 normal_S = Vec3::Zero();    ///< unit, out of the material
  double curvature_1 = 0.0;        ///< greater principal curvature [1/m], positive for a convex body
  double curvature_2 = 0.0;        ///< the lesser one
};

/// A box along the axes of a frame.
struct Box3 {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  ///< [m], may be infinite
};

/// A rectangle along the axes of a plane, borders included.
struct Rectangle {
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;  ///< [m]
};

/// Rectangles of one size in rows and columns; index = ix + nx * iy. They may overlap or leave gaps.
struct RectangleGrid {
  Rectangle first;
  double step_x = 0.0, step_y = 0.0;  ///< from one to the next [m], > 0
  int nx = 0, ny = 0;                 ///< columns and rows

  /// The rectangle in column ix and row iy.
  Rectangle at(int ix, int iy) const {
    return {first.x_min + ix * step_x, first.x_max + ix * step_x, first.y_min + iy * step_y, first.y_max + iy * step_y};
  }
  /// Number of rectangles.
  std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  /// Where results of a rectangle stand.
  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(ix) + static_cast<std::size_t>(nx) * static_cast<std::size_t>(iy);
  }
};

/// Conservative: every height over the rectangle lies in [z_min, z_max]. empty: the surface is nowhere over it.
struct HeightBounds {
  double z_min = 0.0, z_max = 0.0;  ///< [m]
  bool empty = false;
};

/// A number that the shape of a surface follows from.
struct ShapeParameter {
  std::string name;   ///< small letters, digits, '_': of no other parameter of the surface
  std::string unit;   ///< in SI: "m", "rad"; "1": none
  double step = 0.0;  ///< in that unit, > 0: moves the surface by some hundredths of a micrometre at most
  /// Where it acts [m], surface frame, about; of what is the same all along at x = 0 or theta = 0. NaN: nowhere most.
  Vec3 place_S = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// How derivatives of heights were found.
enum class HeightsBy {
  exact,        ///< in closed form
  differences,  ///< from the surfaces with the parameter a step more and a step less
};

/// An arbitrary 3D wheel or rail surface in its own frame S.
/// Rail: x along the track, y to the right, z down. Wheel: origin on the axle, y along the axle, x = r sin(theta), z =
/// r cos(theta). All queries are const, safe to call from any number of threads, and independent of the number of
/// threads.
/// A surface made of another one answers every question for itself: what it keeps of the other (data_v(), v,
/// SurfacePoint::arc_length) it passes on, what it changes it leaves unanswered.
class Surface {
 public:
  virtual ~Surface() = default;

  /// Name of the representation, as in the registry of backends.
  virtual std::string_view backend() const = 0;
  /// Rail-like or wheel-like.
  virtual Facing facing() const = 0;
  /// Box that holds the whole surface [m]; entries may be infinite.
  virtual Box3 bounds() const = 0;
  /// About what it takes, the surfaces it is made of included.
  virtual std::size_t memory_bytes() const = 0;
  /// Whether the shape is one profile: a rail the same at every x, a wheel the same at every theta. False for a roller.
  virtual bool constant_profile() const { return false; }
  /// Whether the shape is that one profile between u_min and u_max (see SurfacePoint::u; of a wheel any branch, at most
  /// a turn), the same wherever this holds. Of surfaces that do not tell: only where all is.
  virtual bool constant_between(double u_min, double u_max) const {
    static_cast<void>(u_min), static_cast<void>(u_max);
    return constant_profile();
  }
  /// Lateral parameters v (see SurfacePoint) of the lines along u at which the data lie that the surface was fitted to,
  /// increasing. Empty: it was not, or does not tell.
  virtual std::vector<double> data_v() const { return {}; }

  /// Numbers that the shape follows from, by which there are derivatives. Empty: there are none, or it does not tell.
  virtual std::vector<ShapeParameter> parameters() const { return {}; }
  /// How many they are, without making their names.
  virtual std::size_t parameter_count() const { return parameters().size(); }
  /// The surface with a parameter changed by an amount of its unit; it need not tell parameters of its own. Errors:
  /// Error(configuration) if there is no such parameter, or no surface with that amount.
  std::shared_ptr<const Surface> changed(std::size_t parameter, double amount) const;
  /// Derivatives of the heights over a grid by a parameter, of points (x, y) of a plane that stay [m per unit]; NaN
  /// where there is no surface. Exact, or by differences where a surface does not know better, and says which. Errors:
  /// as changed() and heights().
  HeightsBy heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const;
  /// The way back, of all parameters at once: to by[k] is added the sum of weights[i] times the derivative of height i
  /// by parameter k, of heights at points (x, y) of a plane that stay [m per unit]; what has no surface does not count.
  /// Exact, or where a surface does not know better by differences between two surfaces for each parameter, and says
  /// which. Errors: Error(configuration) for other numbers of weights and results, and as changed().
  HeightsBy pull_back(const Pose& X_SP, std::span<const Vec2> points_P, std::span<const double> weights,
                      std::span<double> by) const;

  /// Heights (and slopes) over a regular grid in a rigidly placed plane; see HeightsOut.
  /// Errors: Error(configuration) if an output array has another size than the grid, or the grid is not positive.
  void heights(const PlaneGrid& plane_grid, const HeightsOut& out) const;

  /// The same at points (x, y) that need not form a grid; neighbours in the list should be neighbours in the plane.
  /// out's arrays have points_P.size() entries or none.
  void heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const;

  /// Inverse evaluation for points (x, y) of the plane frame P with pose X_SP. out.size() == points_P.size().
  void locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const;

  /// Conservative bounds of the heights over a rectangle of the plane frame P.
  HeightBounds height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const;
  /// The same for many rectangles at once. out.size() == rectangles_P.size(). May be less close than one at a time.
  void height_bounds(const Pose& X_SP, const RectangleGrid& rectangles_P, std::span<HeightBounds> out) const;

 private:
  /// Of a parameter that parameters() names; null: there is no such surface.
  virtual std::shared_ptr<const Surface> do_change(std::size_t parameter, double amount) const;
  /// Exact derivatives; false: not known, and what was written does not count.
  virtual bool do_heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const;
  /// Of points that have a surface. Nothing: not known, and nothing was added.
  virtual std::optional<HeightsBy> do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                                std::span<const double> weights, std::span<double> by) const;
  virtual void do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const = 0;
  /// Falls back to one-point grids; a backend that can do better overrides it.
  virtual void do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const;
  virtual void do_locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const = 0;
  virtual HeightBounds do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const = 0;
  /// Falls back to one rectangle after the other; a backend that can do better overrides it.
  virtual void do_grid_bounds(const Pose& X_SP, const RectangleGrid& rectangles_P, std::span<HeightBounds> out) const;
};

/// Height over one point of a plane; NaN if there is none.
double height_at(const Surface& surface, const Pose& X_SP, const Vec2& point_P);

}  // namespace treadmark
