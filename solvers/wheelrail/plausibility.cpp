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
#include "treadmark/core/platform/ranges.hpp"
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
  const Discretisation& d = p.discretisation;
  if ((!d.choose_dx && s.grid.dx > 1.5 * d.dx) || (!d.choose_ds && s.grid.dy > 1.5 * d.ds))
    add(RemarkKind::elements_enlarged,
        fmt::format("elements were enlarged to keep the potential contact area below {} elements", d.max_elements));

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
                 p.regime == kalker::Regime::shift, kNotSmall * modulus, kYields * modulus, false, p.normal_model,
                 p.tangential_model, p.fastsim.flexibility},
                s.contact, number, solution.remarks);
  if (s.refinement) kalker::judge_refinement(*s.refinement, number, solution.remarks);
  const SixMotion& moving = p.state.velocity;
  if (rolling && moving.x != 0.0 && moving.pitch == 0.0 && !p.longitudinal_force && !p.roller)
    for (Remark& remark : solution.remarks)
      if (remark.kind == RemarkKind::large_creepage && remark.patch == number)
        remark.text += ": the wheel slides without turning, its pitch rate or rolling is not given";
  if (ratio > kMeaningless && solution.status != Status::failed) {
    solution.status = Status::failed;
    const Vec3 at = solution.placement.X_TS.inverse().apply(s.frame.X_TC.origin);
    solution.message = fmt::format(
        "the largest pressure of {:.4g} MPa in patch {}, at x = {:.6g}, y = {:.4g}, z = {:.4g} mm of the rail, has no "
        "meaning: look for spikes or edges in the surfaces, or a position that is not meant",
        kMega * s.contact.max_pressure, number, kMilli * at.x(), kMilli * at.y(), kMilli * at.z());
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

/// Where no wheel of a vehicle can be.
void judge_place(const Geometry& geometry, const Problem& p, PairSolution& solution) {
  constexpr double kOffHeight = 5e-3, kFlange = 15e-3, kOtherRadius = 45e-3, kLevel = 35.0 * kPi / 180.0;
  const auto add = [&](RemarkKind kind, std::string text) { solution.remarks.push_back({kind, 0, std::move(text)}); };
  if (p.track.gauge_based && !solution.placement.gauge_seen)
    add(RemarkKind::gauge_unseen,
        fmt::format(
            "the rail's section ends less than {:.3g} mm below its top, where the gauge is measured: the rail was "
            "placed by its end; measure deeper, or set track.rail_y_mm",
            kMilli * p.track.gauge_height));
  // a crossing lifts the wheel, and so does a flange that climbs; a roller has its own height
  constexpr double kSteep = 20.0 * kPi / 180.0;
  const bool climbs =
      ranges::any_of(solution.patches, [&](const PatchSolution& s) { return std::fabs(s.angle_wheel) > kSteep; });
  if (p.track.gauge_based && !p.roller && geometry.prismatic_rail) {
    // of the wheel, which stands aside of the middle of a wheelset that rolls
    const double aside =
        0.5 * p.wheelset.flange_back_distance - p.wheelset.flange_back_position + p.state.wheel_offset.y;
    const double off = solution.z + aside * std::sin(p.state.position.roll) + p.state.wheel_offset.z - p.track.dz;
    if (std::fabs(off) > kOffHeight && !(climbs && off < 0.0))
      add(RemarkKind::off_nominal_height,
          fmt::format(
              "the wheel stands {:.4g} mm {} its nominal height: is y = 0 of its profile the tape line, and z = 0 "
              "the nominal radius?",
              kMilli * std::fabs(off), off > 0.0 ? "below" : "above"));
  }
  bool back_alone = true;
  for (const PatchSolution& s : solution.patches) {
    const double z = s.reference_wheel.z(), angle = s.angle_wheel;
    if ((z > kFlange && std::fabs(angle) < kLevel) || std::fabs(z) > kOtherRadius)
      add(RemarkKind::on_flange_tip, fmt::format("the wheel touches at y = {:.4g} mm, z = {:.4g} mm of its profile: {}",
                                                 kMilli * s.reference_wheel.y(), kMilli * z,
                                                 std::fabs(z) > kOtherRadius ? "are z = 0 and the nominal radius right?"
                                                                             : "the tip of its flange"));
    back_alone = back_alone && z > 0.0 && angle > kLevel;
  }
  if (back_alone)
    add(RemarkKind::on_flange_back,
        "the back of the flange alone touches: without a check rail a wheel cannot be there");
}

}  // namespace

void judge(const Geometry& geometry, const Problem& p, double balanced, PairSolution& solution) {
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
  judge_place(geometry, p, solution);
  if (solution.status != Status::ok || !p.vertical_force) return;
  const double found = solution.load.track.force.z();
  kalker::judge_force("vertical force", *p.vertical_force, balanced, solution.remarks);
  if (p.damping)
    kalker::judge_force("vertical force", *p.vertical_force, found, solution.remarks, "damping comes on top of it");
}

}  // namespace treadmark::wheelrail
