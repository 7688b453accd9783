// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/history/contact_history.hpp"

#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/contact/theories.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

namespace {

constexpr double kLinedUp = 1e-4;  ///< of grids, in elements

/// A field or, if there is none, the same value everywhere.
std::vector<double> filled(const std::vector<double>& field, std::size_t size, double value) {
  return field.empty() ? std::vector<double>(size, value) : field;
}

/// What an element of a new grid takes of those of the old one, in one direction.
struct Shares {
  long first = 0;
  std::vector<double> share;  ///< of first, first + 1, ...; 1 in all
};

/// offset: of the first new element's middle from that of the first old one; ratio: new over old step. In old steps.
std::vector<Shares> shares_of(double offset, double ratio, int count) {
  if (std::fabs(ratio - 1.0) < kLinedUp) ratio = 1.0;
  const bool whole = ratio == 1.0 && std::fabs(offset - std::round(offset)) < kLinedUp;
  std::vector<Shares> all(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    Shares& s = all[static_cast<std::size_t>(i)];
    if (whole) {
      s = {to_whole<long>(std::round(offset)) + i, {1.0}};
      continue;
    }
    const double low = offset + ratio * (i - 0.5) + 0.5, high = low + ratio;  // in old elements, from the first edge
    s.first = to_whole<long>(std::floor(low));
    for (long j = s.first; static_cast<double>(j) < high; ++j)
      s.share.push_back((std::fmin(high, static_cast<double>(j + 1)) - std::fmax(low, static_cast<double>(j))) / ratio);
  }
  return all;
}

}  // namespace

ContactHistory history_of(const ContactProblem& problem, const ContactSolution& solution) {
  const std::size_t n = problem.grid.size();
  ContactHistory out;
  out.grid = problem.grid;
  out.pressure = filled(solution.pressure, n, 0.0);
  out.traction_x = filled(solution.traction_x, n, 0.0);
  out.traction_y = filled(solution.traction_y, n, 0.0);
  out.friction = filled(solution.friction, n, problem.friction.static_friction());
  out.plastic_x = solution.plastic_x;
  out.plastic_y = solution.plastic_y;
  out.yield_stress = solution.yield_stress;
  if (theory(problem.tangential_model).limits.springs) {
    out.layer_x = solution.displacement_x;
    out.layer_y = solution.displacement_y;
  }
  return out;
}

ContactHistory on_grid(const ContactHistory& history, const Grid2& grid, double static_friction,
                       double first_yield_stress) {
  if (history.empty() || history.grid == grid) return history;
  const Grid2& from = history.grid;
  const double ox = (grid.x0 - from.x0) / grid.dx, oy = (grid.y0 - from.y0) / grid.dy;
  const auto differ = [](double a, double b) { return std::fabs(a - b) > kLinedUp * b; };
  if (differ(from.dx, grid.dx) || differ(from.dy, grid.dy))
    throw Error(ErrorKind::configuration, "a history cannot be carried to elements of another size", {},
                "keep the steps dx and dy, or start without history");
  if (std::fabs(ox - std::round(ox)) > kLinedUp || std::fabs(oy - std::round(oy)) > kLinedUp)
    throw Error(ErrorKind::configuration,
                "a history cannot be carried to a grid that is not displaced by whole elements", {},
                "move the grid by multiples of dx and dy, or start without history");
  return averaged_on(history, grid, static_friction, first_yield_stress);
}

ContactHistory averaged_on(const ContactHistory& history, const Grid2& grid, double static_friction,
                           double first_yield_stress) {
  if (history.empty() || history.grid == grid) return history;
  const Grid2& from = history.grid;
  constexpr double kCoarsest = 1e4, kFarthest = 1e15;  // times an old element
  const double ratio = std::fmax(grid.dx / from.dx, grid.dy / from.dy),
               way = std::fmax(std::fabs(grid.x0 - from.x0) / from.dx, std::fabs(grid.y0 - from.y0) / from.dy);
  if (!(ratio <= kCoarsest && way <= kFarthest))
    throw Error(ErrorKind::configuration, "a history cannot be carried to elements that are so much larger or so far",
                {}, "keep the steps dx and dy, or start without history");
  const std::vector<Shares> columns = shares_of((grid.x0 - from.x0) / from.dx, grid.dx / from.dx, grid.nx),
                            rows = shares_of((grid.y0 - from.y0) / from.dy, grid.dy / from.dy, grid.ny);
  const auto moved = [&](const std::vector<double>& field, double outside) {
    if (field.empty()) return field;
    const auto mean = [&](const Shares& in_x, const Shares& in_y) {
      double sum = 0.0;
      for (std::size_t ky = 0; ky < in_y.share.size(); ++ky)
        for (std::size_t kx = 0; kx < in_x.share.size(); ++kx) {
          const long jx = in_x.first + static_cast<long>(kx), jy = in_y.first + static_cast<long>(ky);
          const bool inside = jx >= 0 && jy >= 0 && jx < from.nx && jy < from.ny;
          sum += in_x.share[kx] * in_y.share[ky] *
                 (inside ? field[from.index(static_cast<int>(jx), static_cast<int>(jy))] : outside);
        }
      return sum;
    };
    std::vector<double> out(grid.size());
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix)
        out[grid.index(ix, iy)] = mean(columns[static_cast<std::size_t>(ix)], rows[static_cast<std::size_t>(iy)]);
    return out;
  };
  ContactHistory out;
  out.grid = grid;
  out.pressure = moved(history.pressure, 0.0);
  out.traction_x = moved(history.traction_x, 0.0);
  out.traction_y = moved(history.traction_y, 0.0);
  out.friction = moved(history.friction, static_friction);
  out.plastic_x = moved(history.plastic_x, 0.0);
  out.plastic_y = moved(history.plastic_y, 0.0);
  out.yield_stress = moved(history.yield_stress, first_yield_stress);
  out.layer_x = moved(history.layer_x, 0.0);
  out.layer_y = moved(history.layer_y, 0.0);
  return out;
}

std::vector<double> carried(const Grid2& grid, const std::vector<double>& field, double dx, double dy, double outside) {
  constexpr double kRound = 1e-9;  // of an element: a step of whole elements shall not blend neighbours
  const double ox = dx / grid.dx, oy = dy / grid.dy;
  const double fx = std::floor(ox + kRound), fy = std::floor(oy + kRound);
  const double tx = std::fmax(0.0, ox - fx) > kRound ? ox - fx : 0.0,
               ty = std::fmax(0.0, oy - fy) > kRound ? oy - fy : 0.0;
  const auto at = [&](long ix, long iy) {
    return ix < 0 || iy < 0 || ix >= grid.nx || iy >= grid.ny
               ? outside
               : field[grid.index(static_cast<int>(ix), static_cast<int>(iy))];
  };
  std::vector<double> out(grid.size());
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const long jx = ix + to_whole<long>(fx), jy = iy + to_whole<long>(fy);
      double value = (1.0 - ty) * at(jx, jy);
      if (tx > 0.0) value += (1.0 - ty) * tx * (at(jx + 1, jy) - at(jx, jy));
      if (ty > 0.0) value += ty * ((1.0 - tx) * at(jx, jy + 1) + (tx > 0.0 ? tx * at(jx + 1, jy + 1) : 0.0));
      out[grid.index(ix, iy)] = value;
    }
  return out;
}

}  // namespace treadmark::kalker
