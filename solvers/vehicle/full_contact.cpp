// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/full_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  const kalker::ContactSolution& c = patch.contact;
  t.stiffness_n = 1.5 * c.force_n / std::max(patch.approach, 1e-9);
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

}  // namespace

Vec3 rail_marker_at_rest(const wheelrail::Geometry& geometry, const wheelrail::Problem& problem) {
  wheelrail::Problem p = problem;
  p.side = Side::right;
  p.track.dy = p.track.dz = p.track.roll = 0.0;
  Vec3 marker = wheelrail::place(geometry, p).X_TR.origin;
  if (problem.side == Side::left && problem.track.gauge_based) marker.y() = -marker.y();
  return marker;
}

FullContact::FullContact(wheelrail::Geometry geometry, wheelrail::Problem problem)
    : problem_(std::move(problem)), pair_(geometry), accepted_(pair_.save()) {
  const Vec3 marker = rail_marker_at_rest(geometry, problem_);
  problem_.track.gauge_based = false;
  problem_.track.rail_y0 = marker.y();
  problem_.track.rail_z0 = marker.z();
  problem_.vertical_force.reset();
  problem_.longitudinal_force.reset();
  problem_.rail_springs.reset();
}

ContactReaction FullContact::evaluate(const PairMotion& motion) {
  wheelrail::Problem p = problem_;
  p.state.position = motion.wheelset;
  p.state.velocity = motion.wheelset_velocity;
  const RailMotion& r = motion.rail;
  p.track.dy = r.y, p.track.dz = r.z, p.track.roll = r.roll;
  p.track.vy = r.vy, p.track.vz = r.vz, p.track.vroll = r.vroll;

  const double travelled = motion.wheelset.x - accepted_x_;
  const bool goes_on = started_ && p.regime == kalker::Regime::transient && travelled != 0.0;
  if (goes_on) {
    p.history = kalker::HistoryUse::keep_going;
    p.discretisation.dq_relative = std::abs(travelled) / p.discretisation.dx;
  } else {
    p.regime = kalker::Regime::steady;
    p.history = kalker::HistoryUse::start;
  }
  pair_.restore(accepted_);
  solution_ = pair_.solve(p);
  tried_x_ = motion.wheelset.x;

  const wheelrail::PhaseTimes& t = solution_.times;
  times_.search_s += t.search_s, times_.distance_s += t.distance_s, times_.normal_s += t.normal_s, times_.tangential_s += t.tangential_s;
  times_.searches += t.searches, times_.distances += t.distances;
  times_.normal_solves += t.normal_solves, times_.tangential_solves += t.tangential_solves;

  ContactReaction out;
  out.status = solution_.status;
  out.message = solution_.message;
  out.least_gap = solution_.least_gap;
  out.on_rail = solution_.load.track;
  const Vec3 arm = solution_.placement.X_TR.origin - solution_.placement.X_TWs.origin;
  out.on_wheelset = {-out.on_rail.force, -(out.on_rail.moment + arm.cross(out.on_rail.force))};
  double most_loaded = 0.0;
  for (const wheelrail::PatchSolution& patch : solution_.patches) {
    const kalker::ContactSolution& c = patch.contact;
    out.lateral_creep_force += c.force_y;
    out.longitudinal_creep_force += c.force_x;
    out.normal_force += c.force_n;
    out.max_pressure = std::max(out.max_pressure, c.max_pressure);
    out.area += c.elements_contact * patch.grid.cell_area();
    out.elastic_energy += c.elastic_energy;
    out.frictional_power -= c.frictional_power;
    out.tangents.push_back(tangent_of(patch, p, travelled));
    ++out.patches;
    if (c.force_n <= most_loaded) continue;
    most_loaded = c.force_n;
    out.contact_x = patch.frame.X_TC.origin.x();
    out.contact_y = patch.frame.X_TC.origin.y();
  }
  return out;
}

void FullContact::accept() {
  accepted_ = pair_.save();
  accepted_x_ = tried_x_;
  started_ = true;
}

}  // namespace treadmark::vehicle
