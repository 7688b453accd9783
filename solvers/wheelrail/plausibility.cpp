// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/solvers/kalker/plausibility.hpp"
#include "treadmark/solvers/wheelrail/usual_values.hpp"
#include "treadmark/solvers/wheelrail/validate_problem.hpp"

namespace treadmark::wheelrail {
namespace {

// Of a line contact p_max / E' = a / (2 R) (Johnson 1985, eq. 4.45): these are a / R of 0.06, 0.1 and 0.5.
constexpr double kYields = 0.03, kNotSmall = 0.05, kMeaningless = 0.25;

// Cosines of 0.97 and 0.87: what a force normal to the plane misses of one normal to the surface.
constexpr double kCurved = 15.0 * kPi / 180.0, kStronglyCurved = 30.0 * kPi / 180.0;

/// Elements in contact, in the axes of the grid [m].
struct Footprint {
  Rectangle box{kInfinity, -kInfinity, kInfinity, -kInfinity};
  int first_row = 0, last_row = -1, column = 0;  ///< column: of the largest pressure
};

Footprint footprint(const Grid2& g, const std::vector<double>& pressure) {
  Footprint f;
  double most = 0.0;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const double p = pressure[g.index(ix, iy)];
      if (!(p > 0.0)) continue;
      if (f.last_row < 0) f.first_row = iy;
      f.last_row = iy;
      if (p > most) most = p, f.column = ix;
      f.box.x_min = std::min(f.box.x_min, g.x(ix)), f.box.x_max = std::max(f.box.x_max, g.x(ix));
      f.box.y_min = std::min(f.box.y_min, g.y(iy)), f.box.y_max = std::max(f.box.y_max, g.y(iy));
    }
  return f;
}

/// Greatest inclination of the rail against the contact plane across the patch [rad], along the column of the largest
/// pressure. A missing surface does not count.
double greatest_inclination(const Geometry& geometry, const Placement& placement, const PatchSolution& s,
                            const Footprint& f) {
  const int rows = f.last_row - f.first_row + 1;
  const Pose X_SP =
      placement.X_TS.inverse() * s.frame.X_TC * Pose{{-s.reference_C.x(), -s.reference_C.y(), 0.0}, Mat3::Identity()};
  std::vector<double> slope(static_cast<std::size_t>(rows));
  geometry.rail->heights({X_SP, {s.grid.x(f.column), s.grid.y(f.first_row), s.grid.dx, s.grid.dy, 1, rows}},
                         {{}, {}, slope});
  double most = 0.0;
  for (const double one : slope)
    if (std::abs(one) > most) most = std::abs(one);
  return std::atan(most);
}

/// Distance of the contact reference from the elements in contact [m], 0 among them.
double distance_from(const Rectangle& box, const Vec2& point) {
  const double dx = std::max({box.x_min - point.x(), point.x() - box.x_max, 0.0}),
               dy = std::max({box.y_min - point.y(), point.y() - box.y_max, 0.0});
  return std::hypot(dx, dy);
}

void judge_patch(const Geometry& geometry, const Problem& p, int number, PairSolution& solution) {
  const PatchSolution& s = solution.patches[static_cast<std::size_t>(number - 1)];
  const auto add = [&](RemarkKind kind, std::string text) {
    solution.remarks.push_back({kind, number, std::move(text)});
  };
  if (s.grid.cell_area() > 1.5 * p.discretisation.dx * p.discretisation.ds)
    add(RemarkKind::elements_enlarged,
        fmt::format("elements were enlarged to keep the potential contact area below {} elements",
                    p.discretisation.max_elements));

  const MissingSurface missing = missing_beside_contact(s.grid, s.distance, s.contact.pressure);
  if (missing.hole > 0) {
    std::string text = fmt::format(
        "the wheel or the rail has a hole of {} elements ({:.4g} mm2) within contact: pressures round it are not to be "
        "trusted; fill the hole in the data",
        missing.hole, kMicro * missing.hole * s.grid.cell_area());
    solution.status = Status::failed;
    solution.message = text;
    add(RemarkKind::hole_in_contact, std::move(text));
  } else if (missing.edge > 0) {
    add(RemarkKind::surface_ends_in_contact,
        fmt::format("{} elements beside contact have no surface of wheel or rail: pressures there depend on where the "
                    "data end",
                    missing.edge));
  }

  const bool rolling = p.regime == kalker::Regime::steady || p.regime == kalker::Regime::transient;
  const double modulus = kalker::contact_modulus(p.material), ratio = s.contact.max_pressure / modulus;
  kalker::judge({s.grid, p.material, p.friction.static_friction(), rolling && s.kinematics.velocity > 0.0,
                 p.regime == kalker::Regime::shift, kNotSmall * modulus},
                s.contact, number, solution.remarks);
  const SixMotion& moving = p.state.velocity;
  if (rolling && moving.x != 0.0 && moving.pitch == 0.0 && !p.longitudinal_force && !p.roller)
    for (Remark& remark : solution.remarks)
      if (remark.kind == RemarkKind::large_creepage && remark.patch == number)
        remark.text += ": the wheel slides without turning, its pitch rate or rolling is not given";
  if (ratio > kYields && ratio <= kNotSmall)
    add(RemarkKind::beyond_yield,
        fmt::format("the largest pressure of {:.4g} MPa is {:.2g} E': steel yields before, and this is an upper bound",
                    kMega * s.contact.max_pressure, ratio));
  if (ratio > kMeaningless && solution.status != Status::failed) {
    solution.status = Status::failed;
    solution.message = fmt::format(
        "the largest pressure of {:.4g} MPa in patch {} has no meaning: look for spikes or edges in the "
        "surfaces, or a position that is not meant",
        kMega * s.contact.max_pressure, number);
  }

  const Footprint f = footprint(s.grid, s.contact.pressure);
  if (f.last_row < 0) return;
  const double outside = distance_from(f.box, s.reference_C),
               size = std::hypot(f.box.x_max - f.box.x_min + s.grid.dx, f.box.y_max - f.box.y_min + s.grid.dy);
  if (outside > size)
    add(RemarkKind::reference_far, fmt::format("the contact reference lies {:.3g} mm outside the patch of {:.3g} mm",
                                               kMilli * outside, kMilli * size));
  if (p.reference_surface == ReferenceSurface::curved) return;
  const double inclination = greatest_inclination(geometry, solution.placement, s, f);
  if (inclination > kCurved)
    add(inclination > kStronglyCurved ? RemarkKind::strongly_curved : RemarkKind::curved,
        fmt::format("the rail is inclined by up to {:.3g} degrees against the plane of the contact{}",
                    180.0 / kPi * inclination,
                    inclination > kStronglyCurved ? ": take a curved reference (conformal contact)" : ""));
}

}  // namespace

void judge(const Geometry& geometry, const Problem& p, PairSolution& solution) {
  judge_values(p, solution.remarks);
  for (std::size_t i = 0; i < solution.patches.size(); ++i) judge_patch(geometry, p, static_cast<int>(i) + 1, solution);
  if (solution.hidden_patches > 0) {
    solution.status = Status::failed;
    solution.message =
        "wheel and rail touch where, along the normal of the contact, another part of a section comes first, as at a "
        "guard rail: leave out the part of the section that is not meant to touch";
    solution.remarks.push_back({RemarkKind::contact_hidden, 0, solution.message});
  }
  if (solution.patches.empty()) {
    if (p.vertical_force && solution.status == Status::no_contact)
      solution.remarks.push_back({RemarkKind::no_contact_under_load, 0,
                                  "a vertical force is prescribed and the bodies do not touch: is the wheel over the "
                                  "rail, and does the force press it down?"});
    return;
  }
  if (solution.status != Status::ok) return;
  if (p.vertical_force)
    kalker::judge_force("vertical force", *p.vertical_force, solution.load.track.force.z(), solution.remarks);
}

}  // namespace treadmark::wheelrail
