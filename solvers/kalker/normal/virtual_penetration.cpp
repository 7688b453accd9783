// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/normal/virtual_penetration.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/normal/analyn.hpp"
#include "treadmark/solvers/kalker/normal/contact_program/kpec_by_elements.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"

namespace treadmark::kalker {

namespace {

void check_penetration_problem(const ContactProblem& problem) {
  const auto refuse = [&](const std::string& message, const std::string& advice) {
    const char* name = problem.normal_model == NormalModel::kpec ? "KPEC: " : "ANALYN: ";
    throw Error(ErrorKind::configuration, name + message, {}, advice);
  };
  const Grid2& grid = problem.grid;
  if (problem.force_prescribed)
    refuse("the force cannot be prescribed", "prescribe the approach, or use the full model");
  if (grid.nx < 3 || grid.ny < 3)
    refuse("the grid has " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " elements",
           "curvatures need three or more in both directions");
  if (problem.gap.size() != grid.size())
    refuse("the gap has " + std::to_string(problem.gap.size()) + " values for " + std::to_string(grid.size()) +
               " elements",
           "give one per element");
  for (const double h : problem.gap)
    if (std::isinf(h) && h < 0.0) refuse("the gap is not finite", "mark elements without contact by NaN");
}

/// Shape and depth of the contact are judged from where the bodies overlap by more than this share of the depth.
constexpr double kShapeLevel = 0.5;

/// Factor on displacements [m] that makes them the overlap: in the mean, the more the deeper, so that none of several
/// places of about the same depth decides alone.
double scale_to_depth(const Interpenetration& overlap, std::span<const double> displacement) {
  const Grid2& grid = overlap.grid();
  double wanted = 0.0, found = 0.0;
  for (int iy = overlap.box().y0; iy < overlap.box().y1; ++iy)
    for (int ix = overlap.box().x0; ix < overlap.box().x1; ++ix) {
      const double depth = -overlap.distance(ix, iy), weight = depth - kShapeLevel * overlap.depth();
      if (!(weight > 0.0)) continue;
      wanted += weight * depth;
      found += weight * displacement[grid.index(ix, iy)];
    }
  return wanted / found;
}

}  // namespace

void solve_virtual_penetration(const ContactProblem& problem, NormalOperatorCache& operators,
                               ContactSolution& solution) {
  check_penetration_problem(problem);
  const Grid2& grid = problem.grid;
  const Interpenetration overlap(grid, problem.gap, problem.approach);
  solution.approach = problem.approach;
  const CombinedMaterial material = combine(problem.material);
  const bool kpec = problem.normal_model == NormalModel::kpec;
  const Conventions conventions = problem.settings.conventions;
  if (!overlap.box().empty())
    solution.pressure =
        kpec ? kpec_distribution(overlap, material, conventions) : analyn_pressure(overlap, material, conventions);
  const bool any = std::any_of(solution.pressure.begin(), solution.pressure.end(), [](double p) { return p > 0.0; });
  if (!any) {
    solution.status = solution.normal.status = Status::no_contact;
    return;
  }
  half_space_displacement(operators, problem, overlap.box(), solution.pressure, solution.displacement_n);
  if (!kpec) return;
  const double scale = conventions == Conventions::contact ? scale_at_deepest(overlap, solution.displacement_n)
                                                           : scale_to_depth(overlap, solution.displacement_n);
  for (double& p : solution.pressure) p *= scale;
  for (double& u : solution.displacement_n) u *= scale;
}

namespace {

/// A by least squares, every row of elements with a height and a slope of its own. An element weighs as the deepest of
/// itself and its neighbours along the row lies beyond the level: a row that does has three.
double fitted_curvature(const Interpenetration& overlap, double level) {
  const Grid2& grid = overlap.grid();
  const ElementBox& box = overlap.box();
  double product = 0.0, square = 0.0;
  for (int iy = box.y0; iy < box.y1; ++iy) {
    const int middle = overlap.deepest_column(iy);
    int count = 0;
    double w[5] = {}, g[3] = {};  // sums of the weight times powers of k, and times the distance
    for (int ix = std::max(0, box.x0 - 1); ix < std::min(grid.nx, box.x1 + 1); ++ix) {
      const double here = overlap.distance(ix, iy);
      const double weight = level - std::min({overlap.distance(ix - 1, iy), here, overlap.distance(ix + 1, iy)});
      if (!(weight > 0.0) || !std::isfinite(here)) continue;
      const double k = ix - middle;
      double power = weight;
      ++count;
      for (int i = 0; i < 5; ++i, power *= k) {
        w[i] += power;
        if (i < 3) g[i] += power * (here - level);
      }
    }
    if (count < 3) continue;
    const double det = w[0] * w[2] - w[1] * w[1];
    // k^2 less what a constant and a slope have of it
    const double constant = (w[2] * w[2] - w[1] * w[3]) / det, slope = (w[0] * w[3] - w[1] * w[2]) / det;
    product += g[2] - constant * g[0] - slope * g[1];
    square += w[4] - constant * w[2] - slope * w[3];
  }
  const double a = product / (square * grid.dx * grid.dx);
  return a > kLeastCurvature ? a : kLeastCurvature;
}

Outline outline(const Interpenetration& overlap, double level) {
  const Grid2& grid = overlap.grid();
  const auto least = [&](int iy) { return iy < 0 || iy >= grid.ny ? HUGE_VAL : overlap.least_distance(iy); };
  Outline out;
  out.curvature_x = fitted_curvature(overlap, level);
  double width = 0.0, moment = 0.0;
  for (int iy = overlap.box().y0; iy < overlap.box().y1; ++iy) {
    if (!(least(iy) < level)) continue;
    for (const int side : {-1, 1}) {
      const double beside = least(iy + side),
                   length = grid.dy * (beside < level ? 0.5 : share_to_level(least(iy), beside, level));
      width += length;
      moment += length * (grid.y(iy) + 0.5 * side * length);
    }
  }
  out.middle = moment / width;
  out.half_width = 0.5 * width;
  constexpr double kNear = 0.1;  // of the depth
  for (int iy = overlap.box().y0; iy < overlap.box().y1; ++iy) {
    const double share = 1.0 - (overlap.depth() + least(iy)) / (kNear * overlap.depth());
    if (share > 0.0) out.deepest = std::max(out.deepest, share * std::abs(grid.y(iy) - out.middle));
  }
  return out;
}

/// Share of the depth at which a row is cut, linear in y^2 between what Hertz' ellipse has at its ends along x and y.
struct CutLevel {
  double along = 0.0, across = 0.0;  ///< A a^2, B b^2 over the depth
  double middle = 0.0, b = 0.0;      ///< [m]

  double at(double y) const {
    const double t = (y - middle) / b;
    return along - (along - across) * t * t;
  }
};

CutLevel cut_level(const Interpenetration& overlap, const CombinedMaterial& material, Conventions conventions) {
  const double depth = overlap.depth(), level = -kShapeLevel * depth;
  const Outline o = conventions == Conventions::contact ? outline_of_elements(overlap, level) : outline(overlap, level);
  const double curvature_y = std::max(kLeastCurvature, (level + depth) / (o.half_width * o.half_width));
  const HertzShape hertz = hertz_from_curvatures(o.curvature_x, curvature_y, {false, depth}, material);
  CutLevel cut;
  cut.middle = o.middle;
  // In a very narrow contact the ellipse must still reach the deepest row.
  cut.b = std::max(hertz.semi_axis_y, 1.1 * o.deepest);
  cut.along = o.curvature_x * hertz.semi_axis_x * hertz.semi_axis_x / depth;
  cut.across = curvature_y * cut.b * cut.b / depth;
  return cut;
}

/// Half ellipse over the elements first .. last of a row, which ends where the distance passes the level.
void fill_run(const Interpenetration& overlap, int iy, int first, int last, double level,
              std::vector<double>& distribution) {
  const Grid2& grid = overlap.grid();
  const double start =
      grid.x(first) - grid.dx * share_to_level(overlap.distance(first, iy), overlap.distance(first - 1, iy), level);
  const double end =
      grid.x(last) + grid.dx * share_to_level(overlap.distance(last, iy), overlap.distance(last + 1, iy), level);
  for (int ix = first; ix <= last; ++ix)
    distribution[grid.index(ix, iy)] = std::sqrt(std::max(0.0, (grid.x(ix) - start) * (end - grid.x(ix))));
}

}  // namespace

std::vector<double> kpec_distribution(const Interpenetration& overlap, const CombinedMaterial& material,
                                      Conventions conventions) {
  const Grid2& grid = overlap.grid();
  const CutLevel cut = cut_level(overlap, material, conventions);
  std::vector<double> distribution(grid.size(), 0.0);
  for (int iy = overlap.box().y0; iy < overlap.box().y1; ++iy) {
    const double share = cut.at(grid.y(iy)), level = -(1.0 - std::clamp(share, 0.0, 1.0)) * overlap.depth();
    const double end_level = conventions == Conventions::contact ? -(1.0 - share) * overlap.depth() : level;
    for (int ix = overlap.box().x0; ix < overlap.box().x1; ++ix) {
      if (overlap.distance(ix, iy) > level) continue;
      const int first = ix;
      while (ix + 1 < grid.nx && overlap.distance(ix + 1, iy) <= level) ++ix;
      fill_run(overlap, iy, first, ix, end_level, distribution);
    }
  }
  return distribution;
}

}  // namespace treadmark::kalker
