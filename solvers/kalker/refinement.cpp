// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "treadmark/solvers/kalker/contact_span.hpp"

namespace treadmark::kalker {
namespace {

constexpr int kRatio = 3;
constexpr double kLeft = 1.0 / (kRatio - 1);  ///< of a difference, first order

/// Every third of count elements, the given one among them; a single one is left alone.
struct Thirds {
  int first = 0, step = 1, count = 1;

  Thirds(int elements, int kept) {
    if (elements == 1) return;
    step = kRatio;
    first = kept % kRatio;
    count = (elements - 1 - first) / kRatio + 1;
  }
};

/// The elements of a grid that are the middles of those of a coarse one.
struct Coarse {
  const Grid2& fine;
  Thirds x, y;
  Grid2 grid;

  Coarse(const Grid2& g, std::size_t kept)
      : fine(g),
        x(g.nx, static_cast<int>(kept % static_cast<std::size_t>(g.nx))),
        y(g.ny, static_cast<int>(kept / static_cast<std::size_t>(g.nx))),
        grid{g.x(x.first), g.y(y.first), x.step * g.dx, y.step * g.dy, x.count, y.count} {}

  template <class Field>
  auto of(const Field& field) const {
    std::vector<std::remove_cvref_t<decltype(field[0])>> out;
    if (field.empty()) return out;
    for (int iy = 0; iy < y.count; ++iy)
      for (int ix = 0; ix < x.count; ++ix)
        out.push_back(field[fine.index(x.first + ix * x.step, y.first + iy * y.step)]);
    return out;
  }
};

double relative(double coarse, double fine) { return fine > 0.0 ? std::abs(coarse - fine) / fine : 0.0; }

/// What the number of elements across says by itself. Bounds of what ellipses anywhere on their elements show
/// (tests/solvers/kalker/refinement_test.cpp).
constexpr int kTold = 2 * kRatio;        ///< from this number on thirds of them tell more
constexpr int kTellsPeaks = 3 * kRatio;  ///< from this number on they tell how a peak grows
constexpr double kOfPeak = 0.4;  ///< of what the highest element stands out by: peaks at edges are narrower than two
double normal_by_number(double n) { return n < 3.0 ? 3.0 / n : 1.0 / (n * n); }
double area_by_number(double n) { return (n < kTold ? 1.7 : 1.0) / n; }
double tangential_by_number(double n) { return (n < kTold ? 1.0 : 0.5) / n; }

}  // namespace

Refinement estimate_refinement(const ContactProblem& problem, const ContactSolution& s, bool load_given,
                               ContactSolver& solver) {
  const Grid2& g = problem.grid;
  const ContactSpan n = contact_span(g, s.pressure);
  const double across = g.nx == 1 && g.ny > 1 ? n.ny : g.ny == 1 && g.nx > 1 ? n.nx : std::min(n.nx, n.ny);
  const bool force_sought = !problem.force_prescribed && !load_given,
             tractions = problem.regime != Regime::frictionless && problem.friction.static_friction() > 0.0;
  Refinement out{normal_by_number(across), area_by_number(across)};
  if (force_sought) out.force = normal_by_number(across);
  if (tractions) out.force = std::max(out.force, tangential_by_number(across));
  if (across >= kTold) {
    const PeakSharpness peak = peak_sharpness(g, s.pressure);
    out.pressure = std::max(out.pressure, kOfPeak * std::max(peak.x, peak.y));
  }
  if (across < kTold || problem.influence.kind == InfluenceSettings::Kind::table) return out;

  const Coarse coarse(g, largest_pressure(s.pressure));
  const std::vector<double> gap = coarse.of(problem.gap), slip_x = coarse.of(problem.extra_slip_x),
                            slip_y = coarse.of(problem.extra_slip_y);
  ContactProblem p = problem;
  p.grid = coarse.grid;
  p.gap = gap;
  p.extra_slip_x = slip_x;
  p.extra_slip_y = slip_y;
  p.sub_patches.part = coarse.of(problem.sub_patches.part);
  if (!problem.friction_of_row.empty()) {
    p.friction_of_row.clear();
    for (int iy = 0; iy < coarse.y.count; ++iy)
      p.friction_of_row.push_back(
          problem.friction_of_row[static_cast<std::size_t>(coarse.y.first + iy * coarse.y.step)]);
  }
  p.creepage = s.creepage;
  p.fx_relative.reset();
  p.fy_relative.reset();
  p.history = HistoryUse::start;
  p.thermal.reset();
  p.sensitivities = false;
  constexpr double kAccuracy = 1e-4;
  p.settings.eps = std::max(p.settings.eps, kAccuracy);
  const bool tangential = problem.regime == Regime::steady && tractions;
  if (!tangential) p.regime = Regime::frictionless;

  solver.reset();
  ContactSolution c = solver.solve_normal(p);
  if (c.status != Status::ok || !(c.force_n > 0.0)) return out;
  // At one load: Hertz' pressures grow with its third root, and so does the size of contact.
  const double load = s.force_n / c.force_n, size = std::cbrt(load);
  const double fine_area = s.elements_contact * g.cell_area(), area = c.elements_contact * p.grid.cell_area();
  out.pressure = std::max(out.pressure, kLeft * relative(c.max_pressure * size, s.max_pressure));
  if (across >= kTellsPeaks) {
    out.peak_exponent = std::log(s.max_pressure / (c.max_pressure * size)) / std::log(kRatio);
    const std::size_t at = largest_pressure(s.pressure), nx = static_cast<std::size_t>(g.nx);
    out.peak = {g.x(static_cast<int>(at % nx)), g.y(static_cast<int>(at / nx))};
  }
  out.area = std::max(out.area, kLeft * relative(area * size * size, fine_area));
  if (force_sought) out.force = std::max(out.force, kLeft * relative(c.force_n, s.force_n));
  if (!tangential) return out;
  solver.solve_tangential(p, c);
  const double bound = problem.friction.static_friction() * s.force_n;
  if (c.tangential.status != Status::ok) return out;
  out.force =
      std::max(out.force, kLeft * std::hypot(c.force_x * load - s.force_x, c.force_y * load - s.force_y) / bound);
  return out;
}

}  // namespace treadmark::kalker
