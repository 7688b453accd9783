// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/pair.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"
#include "treadmark/solvers/wheelrail/damping.hpp"
#include "treadmark/solvers/wheelrail/force_iteration.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/pair_state.hpp"
#include "treadmark/solvers/wheelrail/pair_step.hpp"
#include "treadmark/solvers/wheelrail/plausibility.hpp"
#include "treadmark/solvers/wheelrail/present_part.hpp"
#include "treadmark/solvers/wheelrail/rail_memory.hpp"
#include "treadmark/solvers/wheelrail/validate_problem.hpp"

namespace treadmark::wheelrail {
namespace {

// Hertz, sphere on a plane, stiffer than any contact of wheel and rail.
double stiffest(const Material& material) {
  const CombinedMaterial m = combine(material);
  constexpr double kRadius = 2.4;
  return 4.0 / 3.0 * m.shear_modulus / (1.0 - m.poisson) * std::sqrt(kRadius);
}

void require_facing(const std::shared_ptr<const Surface>& surface, Facing facing, const char* body) {
  if (!surface) throw Error(ErrorKind::configuration, std::string("a ") + body + " surface is missing");
  if (surface->facing() != facing)
    throw Error(ErrorKind::configuration, std::string("the ") + body + " surface faces the wrong way");
}

/// Material must not pass more than two elements between two instants (Vollebregt's rule dt <= 2 dx / V).
std::string violated_step_rule(const Problem& p, const Instant& previous) {
  if (p.regime != kalker::Regime::transient) return {};
  constexpr double kMostElements = 2.0, kRounding = 1e-9;
  const double dx = p.discretisation.dx;
  const bool goes_on = p.history != kalker::HistoryUse::start && !p.roller;
  const double moved = goes_on ? std::abs(p.state.position.x - previous.s) : 0.0,
               rolled = p.discretisation.dq_relative * dx;
  const double step = std::max(moved, rolled);
  if (step <= kMostElements * dx * (1.0 + kRounding)) return {};
  return fmt::format(
      "the step rule dt <= 2 dx / V of transient rolling is violated: a step of {:.6g} mm with elements of {:.6g} mm",
      1e3 * step, 1e3 * dx);
}

void move_down(PairSolution& s, double dz) {
  Placement& x = s.placement;
  for (Pose* pose : {&x.X_TR, &x.X_TS, &x.X_TWs, &x.X_TW, &x.X_TA}) pose->origin.z() += dz;
  for (PatchSolution& patch : s.patches) {
    patch.frame.X_TC.origin.z() += dz;
    patch.region.deepest_T.z() += dz;
    const auto lower = [dz](detection::PatchExtent& e) { e.z_at_y_min += dz, e.z_at_y_max += dz; };
    lower(patch.region.extent);
    ranges::for_each(patch.region.parts, lower);
  }
}

double roll_angle(const Mat3& rotation) { return roll_yaw_pitch(rotation).roll; }

void locate(const Placement& placed, PatchSolution& patch) {
  const Pose& X_TC = patch.frame.X_TC;
  patch.reference_rail = placed.X_TR.apply_inverse(X_TC.origin);
  patch.reference_wheel = placed.X_TW.apply_inverse(X_TC.origin);
  patch.reference_wheelset = placed.X_TWs.apply_inverse(X_TC.origin);
  patch.angle_rail = roll_angle(placed.X_TR.rotation.transpose() * X_TC.rotation);
  patch.angle_wheelset = roll_angle(placed.X_TWs.rotation.transpose() * X_TC.rotation);
  patch.angle_wheel = roll_angle(placed.X_TW.rotation.transpose() * X_TC.rotation);
}

Remark locus_remark(const detection::WrongLocus& wrong, const Pose& X_TS) {
  const Vec3 low = X_TS.apply_inverse(wrong.low), high = X_TS.apply_inverse(wrong.high);
  return {wrong.grid_decides ? RemarkKind::locus_incomplete : RemarkKind::contact_overlooked, 0,
          fmt::format("at y = {:.5g} to {:.5g} mm, u = {:.5g} mm of the rail a grid shows other contact than the locus "
                      "search: {}",
                      kMilli * low.y(), kMilli * high.y(), kMilli * low.x(),
                      wrong.grid_decides
                          ? "the grid search decides"
                          : "no wheel could roll over it, an artefact between sections is likely; the locus decides")};
}

/// Of a region that is deeper than rounding leaves.
std::optional<Remark> between_remark(const std::optional<detection::ContactPatch>& region, const Pose& X_TS) {
  constexpr double kFelt = 1e-6;  // [m]
  if (!region || -region->least_gap < kFelt) return std::nullopt;
  const Vec3 place = X_TS.apply_inverse(region->deepest_T);
  return Remark{RemarkKind::coarse_elements, 0,
                fmt::format("a contact {:.2g} mm deep at y = {:.5g} mm of the rail lies between elements and carries "
                            "nothing: take smaller ones",
                            -kMilli * region->least_gap, kMilli * place.y())};
}

void note(PairSolution& solution, Status status, const std::string& message) {
  if (solution.status == Status::ok) solution.status = status;
  if (solution.message.empty()) solution.message = message;
}

/// Loads, places and status of a solution whose patches are solved.
void complete(const Geometry& bodies, PairSolution& solution) {
  const Pose X_ST = solution.placement.X_TS.inverse(), X_AT = solution.placement.X_TA.inverse();
  for (PatchSolution& patch : solution.patches) {
    patch.rail_shape = contact_shape(*bodies.rail, X_ST * patch.frame.X_TC);
    patch.wheel_shape = contact_shape(*bodies.wheel, X_AT * patch.frame.X_TC);
    const kalker::ContactSolution& c = patch.contact;
    for (const Report* report : {&c.normal, &c.tangential})
      if (report->status != Status::ok)
        note(solution, report->status,
             report->message.empty() ? "a contact problem did not converge" : report->message);
  }
  resolve_loads(solution);
}

}  // namespace

void resolve_loads(PairSolution& solution) {
  solution.load = {};
  for (PatchSolution& patch : solution.patches) {
    const Wrench plane{patch.force_C, patch.moment_C};
    const auto& at_surfaces = patch.surface_loads;
    patch.load = loads(solution.placement, patch.frame.X_TC, at_surfaces ? at_surfaces->rail : plane,
                       at_surfaces ? at_surfaces->wheel : plane);
    solution.load += patch.load;
    locate(solution.placement, patch);
  }
}

PhaseTimes& PhaseTimes::operator+=(const PhaseTimes& other) {
  search_s += other.search_s, distance_s += other.distance_s, normal_s += other.normal_s,
      tangential_s += other.tangential_s;
  searches += other.searches, distances += other.distances, looks += other.looks;
  normal_solves += other.normal_solves, tangential_solves += other.tangential_solves;
  return *this;
}

Pair::Pair(Geometry geometry) : geometry_(std::move(geometry)), state_(std::make_shared<State>()) {
  require_facing(geometry_.rail, Facing::up, "rail");
  require_facing(geometry_.wheel, Facing::down, "wheel");
  rail_memory_ = std::make_unique<RailMemory>(*geometry_.rail);
  bodies_.rail = geometry_.rail.get(), bodies_.wheel = geometry_.wheel.get();
  bodies_.wheel_profile = detection::whole_profile(*geometry_.wheel);
}

Pair::~Pair() = default;
Pair::Pair(Pair&&) noexcept = default;
Pair& Pair::operator=(Pair&&) noexcept = default;

void Pair::reset() { state_ = std::make_shared<State>(); }

std::shared_ptr<const Pair::State> Pair::save() const { return state_; }

void Pair::restore(const std::shared_ptr<const State>& state) { state_ = state ? state : std::make_shared<State>(); }

PairSolution Pair::solve(const Problem& problem) {
  validate(problem);
  if (problem.history != kalker::HistoryUse::start && !state_->last.patches.empty() && state_->side != problem.side)
    throw Error(ErrorKind::configuration, "the history belongs to the other side of the wheelset", {},
                "use one pair for each side");
  if (problem.side == Side::right) return solve_right_hand(problem, Side::right);
  return mirrored(solve_right_hand(mirrored(problem), Side::left));
}

Instant Pair::choose_previous(const Problem& p) const {
  Instant previous;
  switch (p.history) {
    case kalker::HistoryUse::start:
      break;
    case kalker::HistoryUse::keep_going:
    case kalker::HistoryUse::normal_only:
      previous = state_->last;
      break;
    case kalker::HistoryUse::same_instant:
      previous = state_->previous;
      break;
  }
  return previous;
}

PairSolution Pair::solve_right_hand(const Problem& p, Side side) {
  // Of a copy of the state: an error leaves it as it was.
  auto next = std::make_shared<State>();
  next->previous = choose_previous(p);
  next->side = side;
  PairSolution solution;
  if (const std::string violated = violated_step_rule(p, next->previous); !violated.empty()) {
    if (p.enforce_step_rule) {
      note(solution, Status::failed, violated + ": take smaller steps or larger elements");
      return solution;
    }
    solution.remarks.push_back({RemarkKind::step_rule, 0, violated});
  }

  if (geometry_.wheel->constant_profile() && !bodies_.wheel_lines &&
      p.discretisation.search == Discretisation::SearchGrid::reference_locus)
    bodies_.wheel_lines = std::make_shared<detection::ProfileLines>(detection::profile_lines(*geometry_.wheel, 0.0));
  PairStep step(geometry_, p, next->previous, solvers_, few_solvers_, solution.times, bodies_, *rail_memory_);
  const double known = next->previous.stiffness;
  Balance balance =
      find_balance(step, p, known > 0.0 ? known : stiffest(p.material), next->previous.end_slope, known > 0.0);
  solution.z = balance.z + balance.rail_dz;
  solution.pitch_rate = balance.pitch_rate;
  solution.least_gap = step.closest();
  solution.hidden_patches = step.hidden_patches();
  if (const auto wrong = step.wrong_locus()) solution.remarks.push_back(locus_remark(*wrong, step.placement().X_TS));
  if (auto between = between_remark(step.between_elements(), step.placement().X_TS))
    solution.remarks.push_back(*std::move(between));
  solution.rail_deflection_y = balance.rail_dy;
  solution.rail_deflection_z = balance.rail_dz;
  solution.force_iterations = std::move(balance.iterations);
  if (balance.status != Status::ok) note(solution, balance.status, balance.message);
  next->last = step.finish();
  next->last.stiffness = balance.stiffness;
  next->last.end_slope = balance.end_slope;
  if (p.refinement) step.estimate_refinement(coarse_solver_);
  if (p.surface_loads) step.find_surface_loads();
  solution.placement = step.placement();
  const double balanced = step.force_T().z();
  solution.patches = step.take_patches();
  if (solution.patches.empty()) note(solution, Status::no_contact, "the bodies do not touch at this position");
  if (solution.status == Status::no_contact)
    solution.message += missing_part(*geometry_.wheel, -p.state.position.pitch - p.state.wheel_offset.pitch);
  add_damping(p, next->previous, next->last, solution.patches);
  move_down(solution, balance.rail_dz);
  complete(geometry_, solution);
  judge(geometry_, p, balanced, solution);
  state_ = std::move(next);
  return solution;
}

}  // namespace treadmark::wheelrail
