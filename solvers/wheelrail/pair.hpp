// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/detection/contact_frame.hpp"
#include "treadmark/detection/contact_search.hpp"
#include "treadmark/model/remarks.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/refinement.hpp"
#include "treadmark/solvers/wheelrail/contact_shape.hpp"
#include "treadmark/solvers/wheelrail/kinematics.hpp"
#include "treadmark/solvers/wheelrail/loads.hpp"
#include "treadmark/solvers/wheelrail/pair_gradient.hpp"

namespace treadmark::wheelrail {

/// Heights of rail and wheel along n at which the rigid slip of each element was taken [m]; empty: in the contact plane
/// and at the approach.
struct SlipHeights {
  std::vector<double> rail, wheel;  ///< by element of the grid [m]
};

/// What a patch does to its bodies (surface_loads.hpp): loads on the rail in contact axes, moments about the contact
/// reference [N], [N m].
struct SurfaceLoads {
  Wrench pressure;           ///< of the pressures alone, as the rail takes them
  Wrench pressure_on_wheel;  ///< the opposite of what the wheel takes of them
  Wrench rail;               ///< as the rail takes the whole load
  Wrench wheel;              ///< the opposite of what the wheel takes
  double slip_power = 0.0;   ///< of the tractions on the rigid slip, lost by the bodies [W]
};

/// One contact patch between wheel and rail, solved.
struct PatchSolution {
  detection::ContactPatch region;  ///< where the undeformed bodies interpenetrate
  detection::ContactFrame frame;   ///< tangent plane, pose in the track frame
  Grid2 grid;                      ///< potential contact area, contact axes [m]
  std::vector<double> distance;    ///< undeformed distance h [m], NaN = no surface
  double approach = 0.0;           ///< rigid penetration [m]
  ContactKinematics kinematics;
  kalker::ContactSolution contact;  ///< pressures, tractions, forces in contact axes, on the rail
  /// Where the contact reference lies in the grid's axes [m]: (0, 0), or elsewhere for grids that stay aligned in time.
  Vec2 reference_C = Vec2::Zero();
  /// Curved reference: inclination of each row against the contact plane [rad]; empty otherwise. Then the contact
  /// problem's tractions and its force components are local ones ("tilde"), force_C is their resultant.
  std::vector<double> row_angle;
  std::vector<double> extra_slip_x, extra_slip_y;  ///< rigid slip beyond creepage and spin; empty = none
  Vec3 force_C = Vec3::Zero();                     ///< on the rail, contact axes, with damping [N]
  Vec3 moment_C = Vec3::Zero();                    ///< about the contact reference [N m]
  Wrenches load;
  std::optional<SurfaceLoads> surface_loads;  ///< where they were asked for, with damping; load is then theirs
  std::uint64_t id = 0;                       ///< stays with a patch through a sequence in time; > 0
  std::vector<std::uint64_t> came_from;       ///< patches of the previous instant that it continues
  Vec3 reference_rail = Vec3::Zero();         ///< contact reference in rail axes [m]
  Vec3 reference_wheel = Vec3::Zero();        ///< in wheel profile axes (not pitched) [m]
  Vec3 reference_wheelset = Vec3::Zero();     ///< in wheelset axes [m]
  double reference_s = 0.0;                   ///< arc length along the rail profile from y = 0 [m]
  double angle_rail = 0.0, angle_wheelset = 0.0, angle_wheel = 0.0;  ///< contact angle in those axes [rad]
  std::optional<kalker::Refinement> refinement;                      ///< where it was asked for
  std::optional<ContactShape> rail_shape, wheel_shape;  ///< at the contact reference; none where a surface ends there
};

/// Seconds spent, and how often.
struct PhaseTimes {
  double search_s = 0.0, distance_s = 0.0, normal_s = 0.0, tangential_s = 0.0;  ///< as used_seconds() counts
  int searches = 0, distances = 0, normal_solves = 0, tangential_solves = 0;    ///< how often each was done
  /// Searches for places alone, and searches and solutions on few elements; the other numbers do not count them.
  int looks = 0;

  PhaseTimes& operator+=(const PhaseTimes& other);
};

/// Contact of the whole wheel at one instant.
struct PairSolution {
  Status status = Status::ok;
  /// By solve_many(), which has an error as status and message: nothing else here is known.
  bool refused = false;
  std::string message;          ///< why the status is not ok
  std::vector<Remark> remarks;  ///< warnings, also where the status is ok
  Placement placement;
  double z = 0.0;           ///< vertical wheelset position, given or found [m]
  double pitch_rate = 0.0;  ///< of the wheelset, given or found [rad/s]
  /// Least distance from rail to wheel along z of the track at this position [m], also where they do not touch;
  /// negative: greatest penetration. It falls by what the wheel comes down, so that the loss of contact is a simple
  /// root of it. NaN where no wheel lies over the rail.
  double least_gap = std::numeric_limits<double>::quiet_NaN();
  int hidden_patches = 0;  ///< found, but left out: along their normal another part of a section comes first
  double rail_deflection_y = 0.0, rail_deflection_z = 0.0;  ///< of a rail on springs [m]
  std::vector<PatchSolution> patches;                       ///< field side first
  Wrenches load;                                            ///< sum over the patches
  std::vector<std::pair<double, double>> force_iterations;  ///< (z [m], vertical force [N])
  PhaseTimes times;
};

/// A number by which derivatives are wanted: of a pair's problem, of its surfaces, or of both.
struct PairParameter {
  /// Adds an amount of either sign to the number. It may change track, roller, wheelset, state, a given vertical force,
  /// coefficients of friction and the surfaces. Called from any thread.
  std::function<void(double amount, Problem& problem, Geometry& geometry)> change;
  /// Places and gaps are differenced over it, nothing else is: in the unit of the number, what moves surfaces by some
  /// hundredths of a micrometre.
  double step = 5e-8;
  /// Instead of both: of the surface that faces so, this one of its parameters (Surface::parameters).
  std::optional<Facing> shape_of = std::nullopt;
  std::size_t shape = 0;  ///< which of them
};

/// Two solutions beside a given one, on either side of it along its tangent: with a number that is given more by the
/// step, and less by it. Their central difference is the total derivative. They have z, placement and of every patch
/// contact plane, kinematics, approach, forces, moments, loads, largest pressure, energy and power; they have no
/// fields, no shapes of the bodies, and whatever else has no derivative is as in the given solution.
struct PairNeighbours {
  PairSolution more, less;
  double step = 0.0;  ///< of the parameter, in its unit
  /// Of a parameter of a shape: how heights of the elements' surfaces were found to change. Where the contact plane
  /// lies is differenced in any case.
  HeightsBy heights = HeightsBy::exact;
  Report report;  ///< where the status is not ok, the derivatives are none

  /// Of a number of a solution, by the parameter.
  template <class Number>
  double derivative(Number&& number) const {
    return (number(more) - number(less)) / (2.0 * step);
  }
};

struct Instant;
class RailMemory;

/// Contact of one wheel and one rail (Kalker 1990; Vollebregt's grid-based contact search).
/// Geometry is set once; solve() is called for one state after the other. Without history (Problem::history == start)
/// results do not depend on what was solved before; sequences in time go on from the last solution. Every error and
/// every status leaves the pair usable; a solve that fails with an error leaves the history as it was. Memory does not
/// grow with the number of calls. Not thread-safe: one Pair per thread; two Pairs on the same surfaces may work at
/// once.
class Pair {
 public:
  /// Errors: Error(configuration) if a surface is missing or faces the wrong way.
  explicit Pair(Geometry geometry);
  ~Pair();
  Pair(Pair&&) noexcept;
  Pair& operator=(Pair&&) noexcept;

  /// Errors: Error(configuration) for inconsistent input or numbers that are not finite. Lack of contact or of
  /// convergence, forces that cannot be balanced, a wheel inside the rail or beside it are statuses.
  PairSolution solve(const Problem& problem);

  /// Solves many problems that do not depend on each other, on all threads with pairs of their own: the bits of
  /// solve(), whatever their number and order, and the history stays as it was. problem(i) and take(i, solution) are
  /// called on any thread, once for each i, and take() once for each. What problem(i) or solve() refuse with an Error,
  /// and what is to go on from a history, is refused: Status::failed, and the error as its message; the others go on.
  /// Memory does not grow with count. Throws Cancelled after a stop request, of progress or of the scope that holds.
  void solve_many(std::size_t count, const std::function<Problem(std::size_t)>& problem,
                  const std::function<void(std::size_t, PairSolution&&)>& take, const Progress& progress = {}) const;

  /// Derivatives of a number of a solution of this problem by the gaps of its patches. Costs a linear system for the
  /// number and, with a vertical force that is given, one for each patch. The history stays as it is. Errors:
  /// Error(configuration) for a solution that is not ok, rails on springs, a longitudinal force that is given, curved
  /// contact, and as kalker::ContactSolver::gradient.
  PairGradient gradient(const Problem& problem, const PairSolution& solution, const PairQuantity& quantity);

  /// Total derivatives of all numbers of a solution of this problem: through placement, search, contact planes that
  /// move and turn, gaps, creepages, coefficient of friction and the balance of a vertical force that is given.
  /// Elements stay in contact or out of it and adhere or slip, as in kalker::Gradient; so does the element of the
  /// largest pressure and that of the greatest penetration. Costs some linear systems for each patch and two searches
  /// without pressures for each parameter; parameters on all threads, with the same bits for any number of them. The
  /// history stays as it is. A parameter that changes anything else of the problem, or contact that comes, goes or
  /// leaves a surface with it, is told in its report. Errors: as gradient(), Error(configuration) for transient
  /// rolling, shifts, damping, the slip of surfaces, a shape that has no such parameter, and what changed problems and
  /// surfaces are refused for.
  std::vector<PairNeighbours> neighbours(const Problem& problem, const PairSolution& solution,
                                         std::span<const PairParameter> parameters);

  /// Puts numbers of a solution in as many places.
  using Numbers = std::function<void(const PairSolution&, std::span<double>)>;
  /// Total derivatives of numbers of a solution of this problem by the heights of its surfaces, and so by all that a
  /// surface follows from (pulled_back()): what neighbours() tells of one parameter after the other, backwards and for
  /// all of them at once. numbers: as many as count, of a solution as neighbours() gives them; called some dozens of
  /// times for each patch. Costs up to nine linear systems for each patch, for all numbers together: of a pressure
  /// under a load three, of a force two. The history stays as it is. Errors: as neighbours(), and Error(configuration)
  /// for CONTACT's conventions. Numbers of reports: Status::failed where contact comes or goes with the height, for arc
  /// lengths along a rail, and where it is not known how the search or the placement follow from heights.
  std::vector<HeightGradient> height_gradients(const Problem& problem, const PairSolution& solution, std::size_t count,
                                               const Numbers& numbers);

  /// Forgets the history: the bodies come together from rest.
  void reset();

  /// Everything on which following solutions depend; cheap to copy, can be restored into any Pair on the same geometry.
  class State;
  /// The state after the last solution.
  std::shared_ptr<const State> save() const;
  /// Goes on from a state of save(); null is that of a new pair.
  void restore(const std::shared_ptr<const State>& state);

 private:
  PairSolution solve_right_hand(const Problem& problem, Side side);
  Instant choose_previous(const Problem& problem) const;

  Geometry geometry_;
  detection::BodyPair bodies_;  ///< without places; wheel_lines from the first search that wants them
  std::unique_ptr<RailMemory> rail_memory_;
  std::vector<kalker::ContactSolver> solvers_;      ///< by number of the patch; keep coefficients
  std::vector<kalker::ContactSolver> few_solvers_;  ///< the same of few elements
  kalker::ContactSolver coarse_solver_;             ///< to estimate what refining would change
  std::shared_ptr<const State> state_;
};

}  // namespace treadmark::wheelrail
