// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/full_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/wheelrail/pair_state.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::vehicle {
namespace {

using wheelrail::Side;

/// Kalker's coefficients of a circle and nu = 0.25 and 0.3; tangents need no more.
constexpr double kLongitudinal = 4.2, kLateral = 3.7;
/// Mindlin: a contact is less stiff in shear than along its normal.
constexpr double kShearStiffness = 0.85;
constexpr double kLeastShare = 0.02;

PatchTangent tangent_of(const wheelrail::PatchSolution& patch, const wheelrail::Problem& p, double travelled) {
  PatchTangent t;
  t.X_TC = patch.frame.X_TC;
  const Vec3 pressure = patch.surface_loads->pressure.force;  // across a curved patch not along the plane's normal
  t.X_TC.rotation *= rotation_x(std::atan2(-pressure.y(), pressure.z()));
  const kalker::ContactSolution& c = patch.contact;
  t.stiffness_n = 1.5 * c.force_n / std::max(patch.approach, 1e-9);
  t.normal_force = c.force_n;
  const double velocity = patch.kinematics.velocity;
  if (!(velocity > 0.0) || c.force_n <= 0.0) return t;
  const double area = c.elements_contact * patch.grid.cell_area();
  const double bound = std::max(1e-12, p.friction.static_friction() * c.force_n);
  const double used = std::hypot(c.force_x, c.force_y) / bound;
  const double share = std::max(kLeastShare, 1.0 - used * used);
  const double kalker = combine(p.material).shear_modulus * area / std::numbers::pi * share;
  const auto damping = [&](double coefficient) {
    const double steady = velocity / (kalker * coefficient);
    // A short step of transient rolling only shears the contact further.
    if (p.regime != kalker::Regime::transient || !(travelled > 0.0)) return 1.0 / steady;
    const double shear = kShearStiffness * t.stiffness_n * (travelled / velocity);
    return 1.0 / (steady + 1.0 / shear);
  };
  t.damping_x = damping(kLongitudinal);
  t.damping_s = damping(kLateral);
  return t;
}

/// Traction of a row at a place between element centres, 0 outside.
double traction_at(const std::vector<double>& field, const Grid2& grid, double ix, int iy) {
  const int low = to_whole<int>(std::floor(ix));
  const double share = ix - low;
  const auto at = [&](int i) { return i >= 0 && i < grid.nx ? field[grid.index(i, iy)] : 0.0; };
  return (1.0 - share) * at(low) + share * at(low + 1);
}

/// Power that friction dissipates in transient rolling: slip times the mean of the tractions where material is and
/// where it was a rolling step before. With those at the end of the step alone it would be of first order in the step
/// only.
double dissipated(const wheelrail::PatchSolution& patch) {
  const kalker::ContactSolution& c = patch.contact;
  if (c.traction_x.empty() || c.slip_x.empty()) return 0.0;
  const Grid2& g = patch.grid;
  const double upstream = (std::cos(patch.kinematics.chi) > 0.0 ? 1.0 : -1.0) * c.rolling_step / g.dx;
  double sum = 0.0;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const auto i = g.index(ix, iy);
      if (c.slip_x[i] == 0.0 && c.slip_y[i] == 0.0) continue;
      const double before = ix + upstream;
      sum += c.slip_x[i] * (c.traction_x[i] + traction_at(c.traction_x, g, before, iy)) +
             c.slip_y[i] * (c.traction_y[i] + traction_at(c.traction_y, g, before, iy));
    }
  return std::max(0.0, -0.5 * sum * g.cell_area() * patch.kinematics.velocity);
}

}  // namespace

Vec3 rail_marker_at_rest(const wheelrail::Geometry& geometry, const wheelrail::Problem& problem) {
  wheelrail::Problem p = problem;
  p.side = Side::right;
  p.track.dy = p.track.dz = p.track.roll = 0.0;
  Vec3 marker = wheelrail::place(geometry, p).X_TR.origin;
  if (problem.side == Side::left && problem.track.gauge_based) marker.y() = -marker.y();
  return marker;
}

FullContact::FullContact(const wheelrail::Geometry& geometry, wheelrail::Problem problem, double rail_x,
                         double usual_travel, FrictionAlong friction)
    : problem_(std::move(problem)), rail_x_(rail_x), friction_(std::move(friction)), pair_(geometry) {
  const Vec3 marker = rail_marker_at_rest(geometry, problem_);
  problem_.track.gauge_based = false;
  problem_.track.rail_y0 = marker.y();
  problem_.track.rail_z0 = marker.z();
  problem_.vertical_force.reset();
  problem_.longitudinal_force.reset();
  problem_.rail_springs.reset();
  problem_.surface_loads = true;
  problem_.discretisation.usual_dq_relative = usual_travel / problem_.discretisation.dx;
  past_.state = accepted_.before.state = pair_.save();
}

/// Whether tractions of the past are carried on.
bool FullContact::goes_on(const Past& past, const PairMotion& motion) const {
  return past.started && problem_.regime == kalker::Regime::transient && motion.wheelset.x != past.x;
}

wheelrail::PairSolution FullContact::solve(const Past& past, const PairMotion& motion) {
  friction_.put(problem_.friction, motion.wheelset.x);
  wheelrail::Problem p = problem_;
  p.state.position = motion.wheelset;
  p.state.position.x += rail_x_;
  p.state.velocity = motion.wheelset_velocity;
  const RailMotion& r = motion.rail;
  p.track.dy = r.y, p.track.dz = r.z, p.track.roll = r.roll;
  p.track.vy = r.vy, p.track.vz = r.vz, p.track.vroll = r.vroll;

  if (goes_on(past, motion)) {
    p.history = kalker::HistoryUse::keep_going;
    p.discretisation.dq_relative = std::abs(motion.wheelset.x - past.x) / p.discretisation.dx;
  } else {
    if (p.regime == kalker::Regime::transient) p.regime = kalker::Regime::steady;
    p.history = kalker::HistoryUse::start;
  }
  return pair_.solve(p);
}

ContactReaction FullContact::evaluate(const PairMotion& motion) {
  if (!at_past_) pair_.restore(past_.state);
  at_past_ = false;
  const bool in_time = goes_on(past_, motion);
  const wheelrail::PairSolution solution = solve(past_, motion);
  tried_ = motion;
  times_ += solution.times;

  ContactReaction out;
  out.status = solution.status;
  out.message = solution.message;
  out.doubts = static_cast<int>(ranges::count_if(solution.remarks, &Remark::grave));
  out.least_gap = solution.least_gap;
  out.on_rail = solution.load.track;
  double most_loaded = 0.0;
  for (const wheelrail::PatchSolution& patch : solution.patches) {
    const kalker::ContactSolution& c = patch.contact;
    out.lateral_creep_force += c.force_y;
    out.longitudinal_creep_force += c.force_x;
    out.normal_force += c.force_n;
    out.max_pressure = std::max(out.max_pressure, c.max_pressure);
    out.area += c.elements_contact * patch.grid.cell_area();
    out.elastic_energy += c.elastic_energy;
    // Steady: elastic slip does no work in all, by reciprocity, so friction takes what rigid slip puts in. Sums of slip
    // times traction over elements lack the step in which material leaves the contact.
    out.frictional_power += in_time ? dissipated(patch) : patch.surface_loads->slip_power;
    out.tangents.push_back(tangent_of(patch, problem_, motion.wheelset.x - past_.x));
    const Pose& X_TC = patch.frame.X_TC;
    const auto about_axle = [&](const wheelrail::Wrench& load_C) {
      const Vec3 force = X_TC.rotation * load_C.force, arm = X_TC.origin - solution.placement.X_TWs.origin;
      return wheelrail::Wrench{force, X_TC.rotation * load_C.moment + arm.cross(force)};
    };
    const wheelrail::Wrench taken = about_axle(patch.surface_loads->wheel);
    out.on_wheelset += {-taken.force, -taken.moment};
    // Ahead of the axle a rail that bends has another direction, and pressures push the wheel back or forth.
    const double along = -motion.curvature * about_axle(patch.surface_loads->pressure_on_wheel).moment.z();
    out.on_rail.force.x() += along;
    out.on_wheelset.force.x() -= along;
    ++out.patches;
    if (c.force_n <= most_loaded) continue;
    most_loaded = c.force_n;
    out.contact_x = patch.frame.X_TC.origin.x();
    out.contact_y = patch.frame.X_TC.origin.y();
  }
  return out;
}

void FullContact::accept() {
  accepted_ = {past_, tried_};
  past_ = {pair_.save(), true, tried_.wheelset.x};
  at_past_ = true;
}

void FullContact::forget() {
  pair_.reset();
  past_ = {pair_.save(), false, 0.0};
  at_past_ = true;
}

wheelrail::PairSolution FullContact::repeat(const Instant& instant) {
  const auto now = pair_.save();
  pair_.restore(instant.before.state);
  wheelrail::PairSolution solution = solve(instant.before, instant.motion);
  pair_.restore(now);
  return solution;
}

namespace {

using Past = FullContact::Past;

void put(const Past& past, ByteWriter& out) {
  wheelrail::write(past.state, out);
  out.put(past.started);
  out.put(past.x);
}

void get(Past& past, ByteReader& in) {
  past.state = wheelrail::read_state(in);
  in.get(past.started);
  in.get(past.x);
}

/// Every number of a motion, in order.
template <class Motion, class Visit>
void each(Motion& m, Visit&& visit) {
  visit(m.time);
  for (auto* q : {&m.wheelset, &m.wheelset_velocity})
    visit(q->x), visit(q->y), visit(q->z), visit(q->roll), visit(q->yaw), visit(q->pitch);
  auto& r = m.rail;
  visit(r.y), visit(r.z), visit(r.roll), visit(r.vy), visit(r.vz), visit(r.vroll);
}

}  // namespace

void FullContact::write(const Instant& instant, ByteWriter& out) {
  put(instant.before, out);
  each(instant.motion, [&](double value) { out.put(value); });
}

FullContact::Instant FullContact::read(ByteReader& in) {
  Instant instant;
  get(instant.before, in);
  each(instant.motion, [&](double& value) { in.get(value); });
  return instant;
}

void FullContact::save(ByteWriter& out) const {
  put(past_, out);
  write(accepted_, out);
}

void FullContact::restore(ByteReader& in) {
  get(past_, in);
  at_past_ = false;
  accepted_ = read(in);
}

}  // namespace treadmark::vehicle
