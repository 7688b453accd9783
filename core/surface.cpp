// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/surface.hpp"

#include <cmath>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark {

namespace {

void require_sizes(const HeightsOut& out, std::size_t wanted, const char* caller) {
  for (const auto array : {out.z, out.dzdx, out.dzdy})
    if (!array.empty() && array.size() != wanted)
      throw Error(ErrorKind::configuration, std::string("an output array of ") + caller + " has " +
                                                std::to_string(array.size()) + " entries, wanted are " +
                                                std::to_string(wanted));
}

void require_positive(const Grid2& g) {
  if (g.nx <= 0 || g.ny <= 0 || !(g.dx > 0.0) || !(g.dy > 0.0))
    throw Error(ErrorKind::configuration, "a plane grid needs at least one point and positive steps");
}

std::span<double> one(std::span<double> array, std::size_t i) { return array.empty() ? array : array.subspan(i, 1); }

}  // namespace

void Surface::heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  require_positive(plane_grid.grid);
  require_sizes(out, plane_grid.grid.size(), "heights()");
  do_heights(plane_grid, out);
}

std::shared_ptr<const Surface> Surface::changed(std::size_t parameter, double amount) const {
  std::shared_ptr<const Surface> out = parameter < parameter_count() ? do_change(parameter, amount) : nullptr;
  if (!out)
    throw Error(ErrorKind::configuration,
                "a surface of " + std::string(backend()) + " has no parameter " + std::to_string(parameter) +
                    ", or none that can be changed by so much",
                {}, "ask for its parameters first");
  return out;
}

std::shared_ptr<const Surface> Surface::do_change(std::size_t, double) const { return nullptr; }

bool Surface::do_heights_by(std::size_t, const PlaneGrid&, std::span<double>) const { return false; }

HeightsBy Surface::heights_by(std::size_t parameter, const PlaneGrid& plane_grid, std::span<double> by) const {
  require_positive(plane_grid.grid);
  const std::vector<ShapeParameter> all = parameters();
  if (by.size() != plane_grid.grid.size())
    throw Error(ErrorKind::configuration, "heights_by() needs as many results as points");
  if (parameter < all.size() && do_heights_by(parameter, plane_grid, by)) return HeightsBy::exact;
  const double step = parameter < all.size() ? all[parameter].step : 0.0;
  std::vector<double> less(by.size());
  changed(parameter, step)->heights(plane_grid, {by, {}, {}});
  changed(parameter, -step)->heights(plane_grid, {less, {}, {}});
  for (std::size_t i = 0; i < by.size(); ++i) by[i] = (by[i] - less[i]) / (2.0 * step);
  return HeightsBy::differences;
}

std::optional<HeightsBy> Surface::do_pull_back(const Pose&, std::span<const Vec2>, std::span<const double>,
                                               std::span<double>) const {
  return std::nullopt;
}

HeightsBy Surface::pull_back(const Pose& X_SP, std::span<const Vec2> points_P, std::span<const double> weights,
                             std::span<double> by) const {
  if (weights.size() != points_P.size() || by.size() != parameter_count())
    throw Error(ErrorKind::configuration,
                "pull_back() needs as many weights as points, and as many results as the surface has parameters");
  std::vector<Vec2> points;
  std::vector<double> pulling;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] != 0.0) points.push_back(points_P[i]), pulling.push_back(weights[i]);
  std::vector<double> z(points.size());
  heights_at(X_SP, points, {z, {}, {}});
  std::size_t left = 0;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (!std::isnan(z[i])) points[left] = points[i], pulling[left++] = pulling[i];
  points.resize(left), pulling.resize(left);
  if (left == 0 || by.empty()) return HeightsBy::exact;
  if (const std::optional<HeightsBy> known = do_pull_back(X_SP, points, pulling, by)) return *known;

  const std::vector<ShapeParameter> all = parameters();
  parallel_for(all.size(), [&](std::size_t k) {
    std::vector<double> more(left), less(left);
    changed(k, all[k].step)->heights_at(X_SP, points, {more, {}, {}});
    changed(k, -all[k].step)->heights_at(X_SP, points, {less, {}, {}});
    double sum = 0.0;
    for (std::size_t i = 0; i < left; ++i)
      if (const double rise = more[i] - less[i]; !std::isnan(rise)) sum += pulling[i] * rise;
    by[k] += sum / (2.0 * all[k].step);
  });
  return HeightsBy::differences;
}

void Surface::heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  require_sizes(out, points_P.size(), "heights_at()");
  do_heights_at(X_SP, points_P, out);
}

void Surface::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P, const HeightsOut& out) const {
  for (std::size_t i = 0; i < points_P.size(); ++i)
    do_heights({X_SP, {points_P[i].x(), points_P[i].y(), 1.0, 1.0, 1, 1}},
               {one(out.z, i), one(out.dzdx, i), one(out.dzdy, i)});
}

void Surface::locate(const Pose& X_SP, std::span<const Vec2> points_P, std::span<SurfacePoint> out) const {
  if (points_P.size() != out.size()) throw Error(ErrorKind::configuration, "locate() needs as many results as points");
  do_locate(X_SP, points_P, out);
}

HeightBounds Surface::height_bounds(const Pose& X_SP, const Rectangle& r) const {
  if (!(r.x_max >= r.x_min) || !(r.y_max >= r.y_min))
    throw Error(ErrorKind::configuration, "height_bounds() needs a rectangle with min <= max");
  return do_height_bounds(X_SP, r);
}

void Surface::height_bounds(const Pose& X_SP, const RectangleGrid& r, std::span<HeightBounds> out) const {
  if (!(r.first.x_max >= r.first.x_min) || !(r.first.y_max >= r.first.y_min) || !(r.step_x > 0.0) ||
      !(r.step_y > 0.0) || r.nx < 1 || r.ny < 1)
    throw Error(ErrorKind::configuration, "height_bounds() needs rectangles with min <= max and positive steps");
  if (out.size() != r.size())
    throw Error(ErrorKind::configuration, "height_bounds() needs as many results as rectangles");
  do_grid_bounds(X_SP, r, out);
}

void Surface::do_grid_bounds(const Pose& X_SP, const RectangleGrid& r, std::span<HeightBounds> out) const {
  for (int iy = 0; iy < r.ny; ++iy)
    for (int ix = 0; ix < r.nx; ++ix) out[r.index(ix, iy)] = do_height_bounds(X_SP, r.at(ix, iy));
}

double height_at(const Surface& surface, const Pose& X_SP, const Vec2& point_P) {
  double z = 0.0;
  surface.heights({X_SP, {point_P.x(), point_P.y(), 1.0, 1.0, 1, 1}}, {{&z, 1}, {}, {}});
  return z;
}

}  // namespace treadmark
