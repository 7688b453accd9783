// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "treadmark/core/constants.hpp"
#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark::vehicle {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// A force through points, linear between them, continued by the first and the last slope.
struct ForceCurve {
  std::vector<double> at, force;  ///< at: increasing, displacements [m] or rates [m/s]; force [N]
  bool odd = true;                ///< at: from >= 0; the same for the other sign
};
struct CurveValue {
  double force = 0.0, slope = 0.0;
  double integral = 0.0;  ///< from 0: the energy of a spring [J]
};
CurveValue value_at(const ForceCurve& curve, double at);

/// A relative displacement on which elements depend: a column.
struct ElementColumn {
  std::vector<std::pair<int, double>> direction;  ///< coordinates and factors
  int link = -1;                                  ///< in Multibody::links; -1: a line does not stretch it
  Freedom freedom = Freedom::x;
  double arm = 1.0;  ///< of rotations: displacement by the angle [m]
  int vehicle = 0;   ///< of a train; -1: between two of its vehicles
};

/// DryFrictionSpec by columns.
struct DryFriction {
  std::string name;
  int first = 0, directions = 1;        ///< columns
  double stiffness = 0.0;               ///< while it sticks [N/m]
  double damping = 0.0;                 ///< then [N s/m]
  std::array<double, 2> coefficient{};  ///< sliding forwards and back
  double static_ratio = 1.0;
  double normal_force = 0.0;            ///< where the load's column is not displaced [N]
  int load = -1;                        ///< column on whose displacement it depends; -1: none
  double by_load = 0.0;                 ///< by that displacement [N/m], or share of the size of `stop`
  std::optional<ForceCurve> stop = {};  ///< force by that displacement
};

/// The force of a damper that a linear one, which stands in Multibody::damping, is not.
struct DamperCurve {
  std::string name;
  int column = 0;
  ForceCurve whole;     ///< by the rate
  double linear = 0.0;  ///< [N s/m]
};

/// AirSpringSpec by a column, its compression; what it does beyond a linear spring, which stands in
/// Multibody::stiffness, and beyond the load at rest.
struct AirSpring {
  std::string name;
  int column = 0;
  double area = 0.0;                      ///< [m2]
  double bellows = 0.0, reservoir = 0.0;  ///< volumes at rest [m3]
  double exponent = 1.4;
  double resistance = 0.0;  ///< of the orifice, pressure over the square of the flow [Pa s2/m6]
  double pressure = 0.0;    ///< absolute, at rest [Pa]
  double linear = 0.0;      ///< [N/m]
};

/// CouplerSpec without its friction, by a column: its stretch.
struct Coupler {
  std::string name;
  int column = 0;
  ForceCurve spring;     ///< with the free play
  double damping = 0.0;  ///< [N s/m]
  int friction = -1;     ///< column of the friction in it; -1: none
};

/// Forces that are neither linear nor functions of displacements alone. Immutable; what they remember stands outside.
struct ForceElements {
  std::vector<ElementColumn> columns;
  std::vector<DryFriction> frictions;
  std::vector<DamperCurve> dampers;
  std::vector<AirSpring> air_springs;
  std::vector<Coupler> couplers;

  int size() const { return static_cast<int>(columns.size()); }
  /// Memory in the reference configuration: how far each column of friction has slid [m], then whether each friction
  /// slides, then of each air spring the volume that has gone into its reservoir [m3] and the pressure in its bellows
  /// [Pa].
  Vector fresh_memory() const;
  /// Displacements (rates) of the columns by those of the coordinates.
  Vector of(const Vector& coordinates) const;
  /// The same of all columns as a matrix: its rows are columns' directions.
  Matrix directions(Eigen::Index coordinates) const;
  /// Adds so many times the generalised force on the coordinates of forces that resist the columns' displacements.
  void add_to(Vector& on_coordinates, const Vector& force, double times) const;
  /// That force.
  Vector on_coordinates(const Vector& force, Eigen::Index coordinates) const;
  /// Place in the memory of an air spring's two numbers.
  Eigen::Index memory_of_air(std::size_t spring) const;
  /// Energy that the springs of friction and couplers and the gas of air springs hold at displacements of the columns
  /// [J].
  double energy(const Vector& displacement, const Vector& memory) const;
};

/// Some elements by themselves.
struct ElementShare {
  ForceElements elements;
  std::vector<int> columns, memory;  ///< which ones of all elements theirs are
};
/// Elements of columns, which must be those of whole elements, increasing. Coordinates count from the first one.
ElementShare share_of(const ForceElements& all, std::vector<int> columns, int first_coordinate);

/// Of all columns.
struct ElementResponse {
  Vector force;               ///< against the displacements [N]
  Matrix stiffness, damping;  ///< its derivatives by displacements and rates
  Vector memory;
};

/// At displacements [m] and rates [m/s] of the columns, from what was remembered so long before [s]; without end:
/// pressures are even. Forces of air springs are NaN where nothing is left of a volume.
ElementResponse respond(const ForceElements& elements, const Vector& displacement, const Vector& rate,
                        const Vector& memory, double duration = kInfinity);

/// A time step as the elements see it: displacement + of_displacement * y, rate + of_rate * y, where accelerations
/// y = free - flexibility * force.
struct ElementStep {
  Vector displacement, rate;
  double of_displacement = 0.0, of_rate = 0.0;
  double duration = kInfinity;  ///< [s]
  Vector free;
  Matrix flexibility;
  Vector guess;            ///< of y
  double tolerance = 0.0;  ///< of forces [N]
};
/// Response that agrees with the accelerations which it makes, by Newton's method. None: they were not found; they are
/// there in a short enough step.
std::optional<ElementResponse> settle(const ForceElements& elements, const ElementStep& step, const Vector& memory);

}  // namespace treadmark::vehicle
