// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/normal/hertz.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/contact/hertz_ellipse.hpp"

namespace treadmark::kalker {

namespace {

using std::numbers::pi;

void require_positive(double value, const char* name) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw Error(ErrorKind::configuration, std::string("Hertzian contact: ") + name + " is " + std::to_string(value), {},
                "it must be positive and finite");
}

/// Plane strain modulus of the pair, e* = G/(1 - nu).
double modulus(const CombinedMaterial& material) {
  require_positive(material.shear_modulus, "the shear modulus");
  return material.shear_modulus / (1.0 - material.poisson);
}

HertzShape line(double curvature_x, double a, double half_length, double force) {
  HertzShape shape;
  shape.curvature_x = curvature_x;
  shape.semi_axis_x = a;
  shape.semi_axis_y = half_length;
  shape.force = force;
  return shape;
}

double line_force(const HertzLoad& load) {
  if (!load.force_prescribed)
    throw Error(ErrorKind::configuration, "the approach of a Hertzian line contact cannot be prescribed", {},
                "prescribe the force");
  require_positive(load.value, "the force");
  return load.value;
}

}  // namespace

HertzShape hertz_from_curvatures(double curvature_x, double curvature_y, const HertzLoad& load,
                                 const CombinedMaterial& material) {
  require_positive(curvature_x, "curvature A");
  require_positive(curvature_y, "curvature B");
  require_positive(load.value, load.force_prescribed ? "the force" : "the approach");
  const HertzEllipse e = (load.force_prescribed ? hertz_by_force : hertz_by_approach)(curvature_x, curvature_y,
                                                                                      load.value, modulus(material));
  HertzShape shape;
  shape.curvature_x = curvature_x;
  shape.curvature_y = curvature_y;
  shape.semi_axis_x = e.semi_axis_x;
  shape.semi_axis_y = e.semi_axis_y;
  shape.force = e.force;
  shape.approach = e.approach;
  return shape;
}

HertzShape hertz_from_curvature_and_ratio(double curvature_x, double ratio, const HertzLoad& load,
                                          const CombinedMaterial& material) {
  require_positive(curvature_x, "curvature A");
  require_positive(ratio, "the aspect ratio a/b");
  const double curvature_ratio = hertz_curvature_ratio(std::min(ratio, 1.0 / ratio));
  const double curvature_y = ratio <= 1.0 ? curvature_x * curvature_ratio : curvature_x / curvature_ratio;
  return hertz_from_curvatures(curvature_x, curvature_y, load, material);
}

HertzShape hertz_from_semi_axes(double a, double b, const HertzLoad& load, const CombinedMaterial& material) {
  require_positive(a, "semi-axis a");
  require_positive(b, "semi-axis b");
  require_positive(load.value, load.force_prescribed ? "the force" : "the approach");
  const double g = std::min(a, b) / std::max(a, b), c = std::sqrt(a * b), e_star = modulus(material);
  const auto [first, second, combined] = ellipse_integrals(g);

  HertzShape shape;
  shape.semi_axis_x = a;
  shape.semi_axis_y = b;
  double rho = 0.0;
  if (load.force_prescribed) {
    shape.force = load.value;
    rho = 4.0 * pi * e_star * std::sqrt(g) * c * c * c / (3.0 * shape.force * second);
    shape.approach = 2.0 * c * c * g * first / (rho * second);
  } else {
    shape.approach = load.value;
    rho = 2.0 * c * c * g * first / (shape.approach * second);
    shape.force = 4.0 * pi * c * c * c * e_star * std::sqrt(g) / (3.0 * rho * second);
  }
  const double ratio = (second - combined) / combined;
  const double large = 2.0 / (rho * (1.0 + ratio)), small = large * ratio;
  shape.curvature_x = a <= b ? large : small;
  shape.curvature_y = a <= b ? small : large;
  return shape;
}

HertzShape hertz_line_from_curvature(double curvature_x, double half_length, const HertzLoad& load,
                                     const CombinedMaterial& material) {
  require_positive(curvature_x, "curvature A");
  require_positive(half_length, "the half length");
  const double force = line_force(load), per_length = force / (2.0 * half_length);
  return line(curvature_x, std::sqrt(2.0 * per_length / (curvature_x * pi * modulus(material))), half_length, force);
}

HertzShape hertz_line_from_semi_axis(double a, double half_length, const HertzLoad& load,
                                     const CombinedMaterial& material) {
  require_positive(a, "semi-axis a");
  require_positive(half_length, "the half length");
  const double force = line_force(load), per_length = force / (2.0 * half_length);
  return line(2.0 * per_length / (a * a * pi * modulus(material)), a, half_length, force);
}

bool is_line_contact(const HertzShape& shape) { return shape.curvature_y == 0.0; }

double hertz_max_pressure(const HertzShape& shape) { return hertz_pressure(shape, 0.0, 0.0); }

double hertz_pressure(const HertzShape& shape, double x, double y) {
  const double a = shape.semi_axis_x, b = shape.semi_axis_y, s = x / a, t = y / b;
  if (is_line_contact(shape)) {
    if (std::abs(t) > 1.0 || s * s >= 1.0) return 0.0;
    return shape.force / (pi * a * b) * std::sqrt(1.0 - s * s);
  }
  const double depth = 1.0 - s * s - t * t;
  return depth > 0.0 ? 1.5 * shape.force / (pi * a * b) * std::sqrt(depth) : 0.0;
}

double parabolic_pressure(const HertzShape& shape, double x, double y) {
  const double a = shape.semi_axis_x, b = shape.semi_axis_y, s = x / a, t = y / b;
  if (is_line_contact(shape))
    return std::abs(t) > 1.0 ? 0.0 : 0.375 * shape.force / (a * b) * std::max(0.0, 1.0 - s * s);
  return 2.0 * shape.force / (pi * a * b) * std::max(0.0, 1.0 - s * s - t * t);
}

Grid2 hertz_grid(const HertzShape& shape, int nx, int ny, double scale) {
  require_positive(scale, "the scale of the grid");
  if (nx < 1 || ny < 1) throw Error(ErrorKind::configuration, "a Hertzian grid needs at least one element each way");
  Grid2 grid;
  grid.nx = nx;
  grid.ny = ny;
  grid.dx = 2.0 * scale * shape.semi_axis_x / nx;
  grid.dy = 2.0 * scale * shape.semi_axis_y / ny;
  if (is_line_contact(shape)) {
    int rows_inside = ny;
    if (scale > 1.0) {
      rows_inside = std::max(1, to_whole<int>(std::round(ny / scale)));
      if ((ny - rows_inside) % 2 != 0) ++rows_inside;
    }
    grid.dy = 2.0 * shape.semi_axis_y / rows_inside;
  }
  grid.x0 = -0.5 * (nx - 1) * grid.dx;
  grid.y0 = -0.5 * (ny - 1) * grid.dy;
  return grid;
}

std::vector<double> hertz_gap(const HertzShape& shape, const Grid2& grid) {
  std::vector<double> gap;
  gap.reserve(grid.size());
  const bool line_contact = is_line_contact(shape);
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x = grid.x(ix), y = grid.y(iy);
      const bool beyond_end = line_contact && std::abs(y) > shape.semi_axis_y;
      gap.push_back(beyond_end ? std::nan("") : shape.curvature_x * x * x + shape.curvature_y * y * y);
    }
  return gap;
}

HertzShape hertz_semi_double_elliptic(double a, double b_minus, double b_plus, const HertzLoad& load,
                                      const CombinedMaterial& material) {
  for (const double b : {b_minus, b_plus})
    if (!(b > 0.0) || !std::isfinite(b))
      throw Error(ErrorKind::configuration,
                  "semi-double-elliptic contact: a semi-axis along y is " + std::to_string(b) + " m", {},
                  "it must be positive and finite");
  HertzShape shape = hertz_from_semi_axes(a, 0.5 * (b_minus + b_plus), load, material);
  shape.semi_axis_y_minus = b_minus;
  shape.semi_axis_y_plus = b_plus;
  return shape;
}

bool is_semi_double_elliptic(const HertzShape& shape) {
  return shape.semi_axis_y_minus > 0.0 && shape.semi_axis_y_plus > 0.0;
}

double semi_double_elliptic_pressure(const HertzShape& shape, double x, double y) {
  const double from_joint = y - 0.5 * (shape.semi_axis_y_minus - shape.semi_axis_y_plus);
  const double s = x / shape.semi_axis_x;
  const double t = from_joint / (from_joint < 0.0 ? shape.semi_axis_y_minus : shape.semi_axis_y_plus);
  const double depth = 1.0 - s * s - t * t;
  if (!(depth > 0.0)) return 0.0;
  return 1.5 * shape.force / (std::numbers::pi * shape.semi_axis_x * shape.semi_axis_y) * std::sqrt(depth);
}

}  // namespace treadmark::kalker
