// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/core/report.hpp"
#include "treadmark/model/contact/contact_settings.hpp"
#include "treadmark/model/contact/friction.hpp"
#include "treadmark/model/contact/material.hpp"

namespace treadmark::kalker {

using treadmark::FastsimSettings;
using treadmark::HistoryUse;
using treadmark::InfluenceSettings;
using treadmark::NormalModel;
using treadmark::Regime;
using treadmark::SolverSettings;
using treadmark::TangentialModel;

/// One contact patch on a regular grid of constant-traction elements in the contact plane (x rolling, y lateral, n into
/// body 1). Tractions and forces act on body 1 (the rail); slip and creepage are body 1 minus body 2. See
/// core/README.md.

/// plastic: the interface layer shears plastically without slip
enum class ElementState : std::uint8_t { exterior = 0, adhesion = 1, slip = 2, plastic = 3 };

/// Relative rigid motion of body 1 against body 2: divided by the rolling speed, or the displacements of a shift.
struct Creepage {
  double xi = 0.0, eta = 0.0;         ///< [-], shift: [m]
  double phi = 0.0;                   ///< spin [rad/m], shift: [rad]
  double spin_x = 0.0, spin_y = 0.0;  ///< spin centre in the grid's axes [m]
};

/// Direction, speed and step of rolling.
struct Rolling {
  double chi = 0.0;                       ///< rolling direction [rad]; steady: 0 or pi
  double velocity = 30.0;                 ///< V [m/s]
  double step = 0.0;                      ///< dq [m]; steady rolling is discretised with dq = dx whatever is given
  double spin_offset_factor = 1.0 / 6.0;  ///< share of dq by which the spin centre is shifted for rolling
  double usual_step = 0.0;                ///< most steps dq of transient rolling are this one [m]; 0: unknown
  friend bool operator==(const Rolling&, const Rolling&) = default;
};

/// Hertz ellipse known beforehand: h = A x^2 + B y^2.
struct HertzShape {
  double curvature_x = 0.0, curvature_y = 0.0;  ///< A, B [1/m]
  double semi_axis_x = 0.0, semi_axis_y = 0.0;  ///< a, b [m]
  /// Semi-double-elliptic: semi-axes of the half ellipses towards -y and +y, b is their mean; else 0.
  double semi_axis_y_minus = 0.0, semi_axis_y_plus = 0.0;
  double approach = 0.0, force = 0.0;  ///< [m], [N]
  friend bool operator==(const HertzShape&, const HertzShape&) = default;
};

/// Parts of a patch that lie apart: elastic influence across is scaled, so that patches come together without a jump.
struct SubPatches {
  int count = 0;                   ///< 0 = one ordinary patch
  std::vector<std::uint8_t> part;  ///< per element: 1 .. count, 0 = never in contact
  std::vector<double> coupling;    ///< count x count, symmetric, 1 on the diagonal
};

/// What is given of one patch. Spans must live until the problem is solved.
struct ContactProblem {
  Grid2 grid;                   ///< element centres [m]
  std::span<const double> gap;  ///< undeformed distance h [m], size grid.size(); NaN = never in contact
  SubPatches sub_patches;
  Material material;
  FrictionLaw friction;

  bool force_prescribed = true;  ///< the normal force, else the approach
  double normal_force = 0.0;     ///< F_n [N]
  double approach = 0.0;         ///< rigid penetration [m]

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

/// What is found. Fields have a value for each element, or none where they have no meaning.
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
