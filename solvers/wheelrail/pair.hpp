// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/detection/contact_frame.hpp"
#include "treadmark/detection/contact_search.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/wheelrail/kinematics.hpp"

namespace treadmark::wheelrail {

/// One contact patch between wheel and rail, solved.
struct PatchSolution {
  detection::ContactPatch region;     ///< where the undeformed bodies interpenetrate
  detection::ContactFrame frame;      ///< tangent plane, pose in the track frame
  Grid2 grid;                         ///< potential contact area, contact axes [m]
  std::vector<double> distance;       ///< undeformed distance h [m], NaN = no surface
  double approach = 0.0;              ///< rigid penetration [m]
  ContactKinematics kinematics;
  kalker::ContactSolution contact;    ///< pressures, tractions, forces in contact axes, on the rail
  Vec3 reference_rail = Vec3::Zero();   ///< contact reference in rail axes [m]
  Vec3 reference_wheel = Vec3::Zero();  ///< in wheel profile axes (not pitched) [m]
  double reference_s = 0.0;             ///< arc length along the rail profile from y = 0 [m]
  Vec3 force_T = Vec3::Zero();          ///< on the rail, track axes [N]
};

/// Seconds spent, and how often.
struct PhaseTimes {
  double search_s = 0.0, distance_s = 0.0, normal_s = 0.0, tangential_s = 0.0;
  int searches = 0, distances = 0, normal_solves = 0, tangential_solves = 0;
};

struct PairSolution {
  Status status = Status::ok;
  std::string message;
  Placement placement;
  double z = 0.0;                       ///< vertical wheelset position, given or found [m]
  std::vector<PatchSolution> patches;   ///< field side first
  Vec3 force_T = Vec3::Zero();          ///< total on the rail, track axes [N]
  Vec3 force_Ws = Vec3::Zero();         ///< the same in wheelset axes [N]
  Vec3 moment_rail_T = Vec3::Zero();    ///< on the rail about the rail marker, track axes [N m]
  Vec3 moment_wheel_Ws = Vec3::Zero();  ///< on the rail about the wheel marker, wheelset axes [N m]
  std::vector<std::pair<double, double>> force_iterations;  ///< (z [m], vertical force [N])
  PhaseTimes times;
};

/// Contact of one wheel and one rail (Kalker 1990; Vollebregt's grid-based contact search).
/// Geometry is set once; solve() is called for one state after the other and starts each solve from what it can re-use of
/// the same solve only, so that results do not depend on what was solved before. Not thread-safe: one Pair per thread.
class Pair {
 public:
  /// Errors: Error(configuration) if a surface is missing or faces the wrong way.
  explicit Pair(Geometry geometry);

  /// Errors: Error(configuration) for inconsistent input. Lack of contact or of convergence is a status.
  PairSolution solve(const Problem& problem);

 private:
  struct Level;
  PairSolution solve_right_hand(const Problem& problem);
  Level evaluate(const Problem& problem, const Placement& placement, const detection::SearchResult& found,
                 const detection::BodyPair& bodies, PhaseTimes& times);
  kalker::ContactProblem contact_problem(const Problem& problem, const PatchSolution& patch) const;
  kalker::ContactSolver& solver(std::size_t patch);

  Geometry geometry_;
  std::vector<kalker::ContactSolver> solvers_;
};

}  // namespace treadmark::wheelrail
