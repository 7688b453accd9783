// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/core/friction.hpp"
#include "treadmark/core/grid.hpp"
#include "treadmark/core/material.hpp"
#include "treadmark/core/numerical_influence.hpp"
#include "treadmark/core/report.hpp"

namespace treadmark::kalker {

/// One contact patch on a regular grid of constant-traction elements in the contact plane (x rolling, y lateral, n into
/// body 1). Tractions and forces act on body 1 (the rail); slip and creepage are body 1 minus body 2. See
/// core/README.md.

/// plastic: the interface layer shears plastically without slip
enum class ElementState : std::uint8_t { exterior = 0, adhesion = 1, slip = 2, plastic = 3 };

/// Pressure distribution: solved; assumed from the Hertz ellipse of the problem; approximated from the gap at a given
/// approach.
enum class NormalModel { full, elliptic, parabolic, semi_double_elliptic, kpec, analyn };

enum class TangentialModel { full, fastsim, fastsim_one_flexibility, fastrip };

/// Which tangential problem is solved.
enum class Regime {
  frictionless,  ///< normal problem only
  shift,         ///< a finite shift; creepages are lengths and an angle; starts where the history ends
  transient,     ///< a step of rolling from where the history ends
  steady,        ///< steady rolling
};

struct Creepage {
  double xi = 0.0, eta = 0.0;         ///< [-], shift: [m]
  double phi = 0.0;                   ///< spin [rad/m], shift: [rad]
  double spin_x = 0.0, spin_y = 0.0;  ///< spin centre in the grid's axes [m]
};

struct Rolling {
  double chi = 0.0;                       ///< rolling direction [rad]; steady: 0 or pi
  double velocity = 30.0;                 ///< V [m/s]
  double step = 0.0;                      ///< dq [m]; steady rolling is discretised with dq = dx whatever is given
  double spin_offset_factor = 1.0 / 6.0;  ///< share of dq by which the spin centre is shifted for rolling
};

/// FASTSIM with slope reduction (Spiryagin et al. 2013).
struct FastsimSettings {
  double k0 = 1.0, alpha = 1.0, beta = 1.0;
  double flexibility = 0.0;  ///< fastsim_one_flexibility: L [m/Pa]
};

/// Where coefficients of influence come from.
struct InfluenceSettings {
  enum class Kind { constant, bilinear, angle_corrected, table };
  Kind kind = Kind::constant;
  /// angle_corrected: inclination of the surface [rad] at positions along y [m] (Vollebregt 2018)
  std::vector<double> position, inclination;
  int variant = 4;
  bool linear = true;                               ///< one straight line through the table, else the table row by row
  std::shared_ptr<const NumericalInfluence> table;  ///< table: numerical coefficients
};

/// What is carried from one case to the next.
enum class HistoryUse {
  start,         ///< nothing: the bodies come together from rest
  keep_going,    ///< the last solution is the previous instant
  normal_only,   ///< of the last solution only the normal part
  same_instant,  ///< the previous instant stays what it was: the case is solved again
};

/// Hertz ellipse known beforehand: h = A x^2 + B y^2.
struct HertzShape {
  double curvature_x = 0.0, curvature_y = 0.0;  ///< A, B [1/m]
  double semi_axis_x = 0.0, semi_axis_y = 0.0;  ///< a, b [m]
  /// Semi-double-elliptic: semi-axes of the half ellipses towards -y and +y, b is their mean; else 0.
  double semi_axis_y_minus = 0.0, semi_axis_y_plus = 0.0;
  double approach = 0.0, force = 0.0;  ///< [m], [N]
};

struct SolverSettings {
  enum class Method {
    automatic,
    sweeps
  };                         ///< sweeps: over single elements, slow; an independent check (tangential problem)
  double eps = 1e-5;         ///< relative accuracy of tractions
  int max_iterations = 999;  ///< inner iterations per solve
  int max_outer = 100;       ///< active-set corrections, friction iterations
  int max_force = 30;        ///< iterations on a prescribed tangential force
  int max_coupling = 30;     ///< rounds of normal and tangential problem for dissimilar bodies; 1: the tangential
                             ///< tractions do not act on the normal problem
  Method method = Method::automatic;
  /// Falling friction: slip speeds that the iteration starts from. below: none, above: the rolling velocity, last:
  /// those of the last solution.
  enum class FirstSlip { below, above, last };
  FirstSlip first_slip = FirstSlip::last;
  /// As the reference program (CONTACT) has it: displacements, and the elastic energy with them, of parts of a patch
  /// are those of full elastic influence. In KPEC and ANALYN parts are not told apart; KPEC lets ends of rows that lie
  /// further out than its ellipse reach run on; ANALYN takes the deepest element of a row for its deepest point.
  bool reference_quirks = false;
};

/// Parts of a patch that lie apart: elastic influence across is scaled, so that patches come together without a jump.
struct SubPatches {
  int count = 0;                   ///< 0 = one ordinary patch
  std::vector<std::uint8_t> part;  ///< per element: 1 .. count, 0 = never in contact
  std::vector<double> coupling;    ///< count x count, symmetric, 1 on the diagonal
};

struct ContactProblem {
  Grid2 grid;                   ///< element centres [m]
  std::span<const double> gap;  ///< undeformed distance h [m], size grid.size(); NaN = never in contact
  SubPatches sub_patches;       ///< with a prescribed approach only
  Material material;
  FrictionLaw friction;

  bool force_prescribed = true;  ///< normal: force [N], else approach [m]
  double normal_force = 0.0;
  double approach = 0.0;

  Regime regime = Regime::frictionless;
  Creepage creepage;
  Rolling rolling;
  /// Prescribed tangential forces relative to static friction * normal force: the creepage component is then sought.
  std::optional<double> fx_relative, fy_relative;

  NormalModel normal_model = NormalModel::full;
  TangentialModel tangential_model = TangentialModel::full;
  FastsimSettings fastsim;
  std::optional<HertzShape> hertz;  ///< needed by the elliptic and parabolic models; start value otherwise

  SolverSettings settings;

  InfluenceSettings influence;
  HistoryUse history = HistoryUse::start;
  std::vector<FrictionLaw> friction_of_row;  ///< empty, or a law for each row of elements
  /// Added to the rigid slip of elements, relative as slip is (shift: [m]); empty or grid.size().
  std::span<const double> extra_slip_x, extra_slip_y;
  std::optional<Thermal> thermal;  ///< surface temperatures are computed; steady rolling
  bool sensitivities = false;      ///< derivatives of forces are computed
};

/// Derivatives of the forces on body 1 at the solution; adhesion and slip areas and coefficients of friction stay as
/// they are, and so do pressures under tangential tractions of dissimilar bodies.
struct Sensitivities {
  std::array<std::array<double, 2>, 3>
      by_creepage{};                    ///< of (F_x, F_y) by xi, eta [N], phi [N m]; shift: [N/m], [N/m], [N/rad]
  std::array<double, 3> by_approach{};  ///< of (F_n, F_x, F_y) by the approach [N/m]
};

struct ContactSolution {
  Status status = Status::ok;
  Report normal, tangential;

  std::vector<double> pressure;                                        ///< p_n [Pa], size grid.size()
  std::vector<double> traction_x, traction_y;                          ///< on body 1 [Pa]; empty when frictionless
  std::vector<double> displacement_n, displacement_x, displacement_y;  ///< u_1 - u_2 [m]
  std::vector<double> slip_x, slip_y;  ///< relative slip s (shift: slip distance [m]); exterior elements 0
  std::vector<double> friction;        ///< mu per element
  std::vector<ElementState> state;
  /// With a plastic layer, else empty: plastic shear distance u_pl [m] and yield stress [Pa].
  std::vector<double> plastic_x, plastic_y, yield_stress;
  std::vector<double> temperature_1, temperature_2;  ///< of the surfaces [deg C]; empty unless asked for

  double approach = 0.0;                                               ///< [m]
  Creepage creepage;                                                   ///< as used or found
  double rolling_step = 0.0;                                           ///< dq used [m]
  double force_n = 0.0, force_x = 0.0, force_y = 0.0;                  ///< on body 1 [N]
  double moment_x = 0.0, moment_y = 0.0, moment_n = 0.0;               ///< about the grid's origin [N m]
  double max_pressure = 0.0;                                           ///< [Pa]
  double elastic_energy = 0.0;                                         ///< [J]
  double frictional_power = 0.0;                                       ///< [W], negative = dissipated (shift: work [J])
  int elements_contact = 0, elements_adhesion = 0, elements_slip = 0;  ///< slip: with plastic ones
  double max_temperature_1 = 0.0, max_temperature_2 = 0.0;             ///< [deg C]
  std::optional<Sensitivities> sensitivities;
};

/// Sum of forces, moments, energy, power and counts from the fields of a solution.
void accumulate_totals(const ContactProblem& problem, ContactSolution& solution);

}  // namespace treadmark::kalker
