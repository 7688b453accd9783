// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/pair.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/detection/undeformed_distance.hpp"
#include "treadmark/solvers/wheelrail/force_balance.hpp"
#include "treadmark/solvers/wheelrail/mirror.hpp"
#include "treadmark/solvers/wheelrail/missing_surface.hpp"
#include "treadmark/solvers/wheelrail/search_window.hpp"
#include "treadmark/solvers/wheelrail/sub_patches.hpp"

namespace treadmark::wheelrail {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total), start_(Clock::now()) {}
  ~Stopwatch() { total_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  double& total_;
  Clock::time_point start_;
};

// Hertz, sphere of 0.3 m radius on a plane: only the order of magnitude matters to start the force iteration.
double stiffness_guess(const Material& material) {
  const CombinedMaterial m = combine(material);
  constexpr double kRadius = 0.3;
  return 4.0 / 3.0 * m.shear_modulus / (1.0 - m.poisson) * std::sqrt(kRadius);
}

double profile_arc_length(const Surface& rail, const Vec3& point_R) {
  constexpr int kSteps = 400;
  const double step = std::abs(point_R.y()) / kSteps;
  if (step == 0.0) return 0.0;
  std::vector<double> z(kSteps + 1);
  rail.heights({Pose{}, {point_R.x(), std::min(0.0, point_R.y()), 1.0, step, 1, kSteps + 1}}, {z, {}, {}});
  double length = 0.0;
  for (std::size_t i = 1; i < z.size(); ++i) {
    const double dz = z[i] - z[i - 1];
    length += std::isnan(dz) ? step : std::hypot(step, dz);
  }
  return std::copysign(length, point_R.y());
}

void require_facing(const std::shared_ptr<const Surface>& surface, Facing facing, const char* body) {
  if (!surface) throw Error(ErrorKind::configuration, std::string("a ") + body + " surface is missing");
  if (surface->facing() != facing)
    throw Error(ErrorKind::configuration, std::string("the ") + body + " surface faces the wrong way");
}

}  // namespace

/// Everything known at one vertical position.
struct Pair::Level {
  std::vector<PatchSolution> patches;
  double least_gap = 0.0;
  Report worst;   ///< of the normal problems
};

Pair::Pair(Geometry geometry) : geometry_(std::move(geometry)) {
  require_facing(geometry_.rail, Facing::up, "rail");
  require_facing(geometry_.wheel, Facing::down, "wheel");
}

Pair::~Pair() = default;
Pair::Pair(Pair&&) noexcept = default;
Pair& Pair::operator=(Pair&&) noexcept = default;

kalker::ContactSolver& Pair::solver(std::size_t patch) {
  while (solvers_.size() <= patch) solvers_.emplace_back();
  return solvers_[patch];
}

kalker::ContactProblem Pair::contact_problem(const Problem& p, const PatchSolution& patch) const {
  kalker::ContactProblem c;
  c.grid = patch.grid;
  c.gap = patch.distance;
  c.sub_patches = sub_patches(p.discretisation, patch.region, patch.frame, patch.grid);
  c.material = p.material;
  c.friction = friction_at(p.friction_inclination, p.friction_laws, patch.frame.angle, p.friction);
  c.normal_model = p.normal_model;
  c.tangential_model = p.tangential_model;
  c.fastsim = p.fastsim;
  c.influence = p.influence;
  c.force_prescribed = false;
  c.approach = patch.approach;
  c.regime = p.regime;
  c.creepage.xi = patch.kinematics.xi;
  c.creepage.eta = patch.kinematics.eta;
  c.creepage.phi = patch.kinematics.phi;
  c.rolling.chi = patch.kinematics.chi;
  c.rolling.velocity = patch.kinematics.velocity;
  c.rolling.step = p.discretisation.dq_relative * patch.grid.dx;
  c.settings = p.solver;
  // A wheel that stands still does not creep.
  if (!(patch.kinematics.velocity > 0.0)) c.regime = kalker::Regime::frictionless;
  return c;
}

namespace {

/// A hole within contact makes wrong pressures round it: the case fails. An edge is worth a remark.
void note_missing_surface(const PatchSolution& patch, PairSolution& solution) {
  const MissingSurface missing = missing_beside_contact(patch.grid, patch.distance, patch.contact.pressure);
  if (missing.hole > 0) {
    solution.status = Status::failed;
    solution.message = "the wheel or the rail has a hole of " + std::to_string(missing.hole) + " elements (" +
                       std::to_string(1e6 * missing.hole * patch.grid.cell_area()) + " mm2) within contact, at y = " +
                       std::to_string(1e3 * patch.frame.X_TC.origin.y()) +
                       " mm of the track: pressures round it are not to be trusted; fill the hole in the data";
  } else if (missing.edge > 0 && solution.message.empty()) {
    solution.message = "contact reaches an edge of the wheel's or rail's surface (" + std::to_string(missing.edge) +
                       " elements beside contact have no surface): pressures there depend on where the data end";
  }
}

}  // namespace

Pair::Level Pair::evaluate(const Problem& p, const Placement& placed, const detection::SearchResult& found,
                           const detection::BodyPair& bodies, PhaseTimes& times) {
  Level level;
  level.least_gap = found.least_gap;
  for (const detection::ContactPatch& region : found.patches) {
    PatchSolution patch;
    patch.region = region;
    {
      const Stopwatch watch(times.distance_s);
      ++times.distances;
      patch.frame = detection::contact_frame(bodies, region);
      patch.grid = detection::potential_contact_grid(
          bodies, region, patch.frame, {p.discretisation.dx, p.discretisation.ds, p.discretisation.max_elements});
      auto undeformed = detection::undeformed_distance(bodies, patch.frame.X_TC, patch.grid);
      patch.distance = std::move(undeformed.distance);
      patch.approach = undeformed.approach;
    }
    // Interpenetration between the element centres only: no contact on this grid.
    if (!(patch.approach > 0.0)) continue;
    patch.kinematics = contact_kinematics(p, placed, patch.frame.X_TC, patch.approach);
    {
      const Stopwatch watch(times.normal_s);
      ++times.normal_solves;
      patch.contact = solver(level.patches.size()).solve_normal(contact_problem(p, patch));
    }
    if (patch.contact.status == Status::no_contact) continue;
    if (patch.contact.normal.status != Status::ok) level.worst = patch.contact.normal;
    level.patches.push_back(std::move(patch));
  }
  return level;
}

PairSolution Pair::solve(const Problem& problem) {
  if (problem.side == Side::right) return solve_right_hand(problem);
  return mirrored(solve_right_hand(mirrored(problem)));
}

PairSolution Pair::solve_right_hand(const Problem& given) {
  if (given.vertical_force && !(*given.vertical_force > 0.0))
    throw Error(ErrorKind::configuration, "the prescribed vertical force must be positive");
  if (given.regime == kalker::Regime::shift)
    throw Error(ErrorKind::configuration, "wheel-rail contact is solved without friction or in steady rolling");
  for (auto& s : solvers_) s.reset();

  Problem p = given;
  if (p.vertical_force) p.state.position.z = 0.0;
  PairSolution solution;
  solution.placement = place(geometry_, p);
  PhaseTimes& times = solution.times;

  const detection::BodyPair bodies{geometry_.rail.get(), geometry_.wheel.get(), solution.placement.X_TS, solution.placement.X_TA};
  std::optional<detection::ContactSearch> search;
  double gap_at_start = 0.0;
  {
    const Stopwatch watch(times.search_s);
    search.emplace(bodies, search_settings(geometry_, p, solution.placement));
    gap_at_start = search->least_gap();
  }
  const auto search_at = [&](double dz) {
    const Stopwatch watch(times.search_s);
    ++times.searches;
    return search->at(dz);
  };

  const double z_start = p.state.position.z;
  solution.z = z_start;
  if (std::isnan(gap_at_start)) {
    solution.status = Status::no_contact;
    solution.message = "wheel and rail nowhere face each other: the wheel is off the rail";
    return solution;
  }

  // Tangential forces per patch relative to the normal ones: they carry part of the vertical load.
  std::vector<double> lateral_share;
  const auto vertical_force = [&](const std::vector<PatchSolution>& patches) {
    double sum = 0.0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const double share = i < lateral_share.size() ? lateral_share[i] : 0.0;
      sum += patches[i].contact.force_n * (std::cos(patches[i].frame.angle) + share * std::sin(patches[i].frame.angle));
    }
    return sum;
  };
  const auto place_at = [&](double z) {
    Placement placed = solution.placement;
    const double dz = z - z_start;
    for (Pose* pose : {&placed.X_TWs, &placed.X_TW, &placed.X_TA}) pose->origin.z() += dz;
    return placed;
  };

  Level level;
  Placement placed = solution.placement;
  const auto evaluate_at = [&](double z, const detection::SearchResult& found) {
    placed = place_at(z);
    level = evaluate(p, placed, found, search->bodies_at(z - z_start), times);
  };
  const auto solve_tangential = [&] {
    const Stopwatch watch(times.tangential_s);
    lateral_share.assign(level.patches.size(), 0.0);
    for (std::size_t i = 0; i < level.patches.size(); ++i) {
      PatchSolution& patch = level.patches[i];
      const kalker::ContactProblem problem = contact_problem(p, patch);
      if (problem.regime != kalker::Regime::frictionless) ++times.tangential_solves;
      solver(i).solve_tangential(problem, patch.contact);
      if (patch.contact.force_n > 0.0) lateral_share[i] = patch.contact.force_y / patch.contact.force_n;
    }
  };

  bool balanced = true;
  if (!p.vertical_force) {
    evaluate_at(z_start, search_at(0.0));
    solve_tangential();
  } else {
    const double target = *p.vertical_force;
    ForceBalance balance(target, p.solver.eps, stiffness_guess(p.material));
    double z = balance.first(z_start + gap_at_start);
    ForceBalance::State state = ForceBalance::State::search;
    bool tangential_done = false;
    for (int i = 0; i < p.max_force_iterations; ++i) {
      if (state == ForceBalance::State::search) {
        evaluate_at(z, search_at(z - z_start));
        tangential_done = false;
      }
      const double force = vertical_force(level.patches);
      solution.force_iterations.emplace_back(z, force);
      state = balance.add(z, force, level.least_gap);
      if (state == ForceBalance::State::no_balance) break;
      if (state == ForceBalance::State::found) {
        if (tangential_done) break;
        solve_tangential();
        tangential_done = true;
        balance.restart();
        continue;
      }
      z = balance.next();
    }
    balanced = state == ForceBalance::State::found && tangential_done;
    if (!balanced && !level.patches.empty() && !tangential_done) solve_tangential();
    solution.z = z;
    if (!balanced) {
      solution.status = Status::not_converged;
      solution.message = state == ForceBalance::State::no_balance
                             ? "no vertical balance: the contact force jumps across the prescribed one"
                             : "the vertical force was not reached within the allowed iterations";
    }
  }

  solution.placement = placed;
  solution.patches = std::move(level.patches);
  if (solution.patches.empty()) {
    if (solution.status == Status::ok) {
      solution.status = Status::no_contact;
      solution.message = "the bodies do not touch at this position";
    }
    return solution;
  }
  for (PatchSolution& patch : solution.patches) {
    const kalker::ContactSolution& c = patch.contact;
    if (solution.message.empty() && patch.grid.cell_area() > 1.5 * p.discretisation.dx * p.discretisation.ds)
      solution.message = "elements were enlarged to keep the potential contact area below " +
                         std::to_string(p.discretisation.max_elements) + " elements";
    note_missing_surface(patch, solution);
    const Pose& X_TC = patch.frame.X_TC;
    patch.force_T = X_TC.rotation * Vec3(c.force_x, c.force_y, c.force_n);
    const Vec3 moment_T = X_TC.rotation * Vec3(c.moment_x, c.moment_y, c.moment_n);
    solution.force_T += patch.force_T;
    solution.moment_rail_T += (X_TC.origin - placed.X_TR.origin).cross(patch.force_T) + moment_T;
    solution.moment_wheel_Ws +=
        placed.X_TWs.rotation.transpose() * ((X_TC.origin - placed.X_TW.origin).cross(patch.force_T) + moment_T);
    patch.reference_rail = placed.X_TR.apply_inverse(X_TC.origin);
    patch.reference_wheel = placed.X_TW.apply_inverse(X_TC.origin);
    patch.reference_s = profile_arc_length(*geometry_.rail, placed.X_TS.apply_inverse(X_TC.origin));
    for (const Report* report : {&c.normal, &c.tangential})
      if (report->status != Status::ok && solution.status == Status::ok) {
        solution.status = report->status;
        solution.message = report->message.empty() ? "a contact problem did not converge" : report->message;
      }
  }
  solution.force_Ws = placed.X_TWs.rotation.transpose() * solution.force_T;
  return solution;
}

}  // namespace treadmark::wheelrail
