// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/solvers/vehicle/vehicle_on_track.hpp"

namespace treadmark::vehicle {

/// The system between two steps.
struct Motion {
  SystemState state;
  Vector a;                               ///< accelerations of the scheme
  Vector a_before;                        ///< a step earlier
  double step_before = 0.0;               ///< length of the last step [s]; 0 = none
  Vector unbalanced;                      ///< f - C v - K q with all forces: M q'' at this time
  std::vector<PairVector> contact_force;  ///< generalised, of each wheel
  Vector element_force, element_memory;   ///< of the force elements
};

struct StepSettings {
  double spectral_radius = 0.8;   ///< of the scheme for fast vibrations, 0.5 (most damping) to 1 (none)
  double force_tolerance = 1e-3;  ///< what the forces of a step may still change by, over the static wheel load
  int max_iterations = 12;
};

struct Step {
  bool converged = false;
  std::string why_not;
  bool derailed = false;  ///< that is why not
  Motion end;
  std::vector<ContactReaction> reactions;  ///< as evaluated last
  double position_error = 0.0;             ///< estimate of what the step added, by Coordinate::arm [m]
  int iterations = 0;
};

/// One step of the scheme of Hilber, Hughes and Taylor (1977), of second order and unconditionally stable for linear
/// systems, with the error estimate of Zienkiewicz and Xie (1991). Contacts are linearised by their tangents about a
/// predicted state; they are evaluated again until the forces of the linearised contact differ little from those of the
/// last evaluation. Force elements are solved as they are beside every linearisation of the contacts, those between
/// vehicles by the same iteration: what remains to be solved is each vehicle by itself, so a step costs as much as
/// there are vehicles. Coordinates without mass need a damper. Not thread-safe; keeps the factorised system of the last
/// step length.
class ImplicitStep {
 public:
  ImplicitStep(const VehicleOnTrack& vehicle, const StepSettings& settings);
  ~ImplicitStep();
  ImplicitStep(ImplicitStep&&) noexcept;

  /// Motion at rest in the scheme: accelerations from the forces.
  Motion start(const SystemState& state, const std::vector<ContactReaction>& reactions) const;
  /// Evaluates the contact elements, accepts nothing.
  Step take(const Motion& from, double length);

  /// How many numbers the factorised system holds: what a round of a step works through beside the contacts.
  std::size_t factorised_numbers() const;

 private:
  /// What there is of a vehicle.
  struct Part {
    Multibody::Range range;
    std::vector<int> touched;  ///< its coordinates that contacts act on, from its first one
    ElementShare elements;
  };
  struct PartFactors;
  struct Factors;
  const Factors& factors(double length);
  PartFactors factorised(const Part& part, double length) const;
  Vector predicted_acceleration(const Motion& from, double length) const;
  ElementStep element_step(const Part& part, const Vector& q, const Vector& v, const std::optional<LineState>& line,
                           double length) const;
  std::optional<Vector> change_of(const Part& part, const PartFactors& factors, const Vector& right, const Vector& a,
                                  const Matrix& give, ElementStep& step, const Vector& memory,
                                  ElementResponse& response) const;
  void couple(const SystemState& at, const std::optional<LineState>& line, const Motion& from, double length,
              ElementResponse& response) const;

  const VehicleOnTrack& vehicle_;
  StepSettings settings_;
  double alpha_, beta_, gamma_;
  std::vector<Part> parts_;
  std::vector<ElementShare> couplers_;                                         ///< elements between vehicles
  std::vector<Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic>> maps_;  ///< by wheel: from touched coordinates
  std::vector<std::vector<int>> own_;  ///< by wheel: columns of its map that are not zero
  double force_scale_ = 1.0;
  std::unique_ptr<Factors> factors_;
};

}  // namespace treadmark::vehicle
