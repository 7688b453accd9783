// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/core/friction.hpp"
#include "treadmark/core/grid.hpp"
#include "treadmark/core/material.hpp"
#include "treadmark/core/report.hpp"

namespace treadmark::kalker {

/// One contact patch on a regular grid of constant-traction elements in the contact plane (x rolling, y lateral, n into body 1).
/// Tractions and forces act on body 1 (the rail); slip and creepage are body 1 minus body 2. See core/README.md.

enum class ElementState : std::uint8_t { exterior = 0, adhesion = 1, slip = 2 };

/// Pressure distribution: solved, or assumed from the Hertz ellipse of the problem.
enum class NormalModel { full, elliptic, parabolic };

enum class TangentialModel { full, fastsim };

/// Which tangential problem is solved.
enum class Regime {
  frictionless,  ///< normal problem only
  shift,         ///< one finite shift from an unloaded state; creepages are lengths and an angle
  steady,        ///< steady rolling
};

struct Creepage {
  double xi = 0.0, eta = 0.0;  ///< [-], shift: [m]
  double phi = 0.0;            ///< spin [rad/m], shift: [rad]
  double spin_x = 0.0, spin_y = 0.0;  ///< spin centre in the grid's axes [m]
};

struct Rolling {
  double chi = 0.0;        ///< rolling direction: 0 or pi [rad]
  double velocity = 30.0;  ///< V [m/s]
  double step = 0.0;       ///< dq [m]; steady rolling is discretised with dq = dx whatever is given
  double spin_offset_factor = 1.0 / 6.0;  ///< share of dq by which the spin centre is shifted for rolling
};

/// FASTSIM with slope reduction (Spiryagin et al. 2013).
struct FastsimSettings {
  double k0 = 1.0, alpha = 1.0, beta = 1.0;
};

/// Hertz ellipse known beforehand: h = A x^2 + B y^2.
struct HertzShape {
  double curvature_x = 0.0, curvature_y = 0.0;   ///< A, B [1/m]
  double semi_axis_x = 0.0, semi_axis_y = 0.0;   ///< a, b [m]
  double approach = 0.0, force = 0.0;            ///< [m], [N]
};

struct SolverSettings {
  double eps = 1e-5;        ///< relative accuracy of tractions
  int max_iterations = 999; ///< inner iterations per solve
  int max_outer = 100;      ///< active-set corrections, friction iterations
  int max_force = 30;       ///< iterations on a prescribed tangential force
};

/// Parts of a patch that lie apart: elastic influence across is scaled, so that patches come together without a jump.
struct SubPatches {
  int count = 0;                     ///< 0 = one ordinary patch
  std::vector<std::uint8_t> part;    ///< per element: 1 .. count, 0 = never in contact
  std::vector<double> coupling;      ///< count x count, symmetric, 1 on the diagonal
};

struct ContactProblem {
  Grid2 grid;                      ///< element centres [m]
  std::span<const double> gap;     ///< undeformed distance h [m], size grid.size(); NaN = never in contact
  SubPatches sub_patches;          ///< with a prescribed approach only
  Material material;
  FrictionLaw friction;

  bool force_prescribed = true;    ///< normal: force [N], else approach [m]
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
  std::optional<HertzShape> hertz;   ///< needed by the elliptic and parabolic models; start value otherwise

  SolverSettings settings;
};

struct ContactSolution {
  Status status = Status::ok;
  Report normal, tangential;

  std::vector<double> pressure;                    ///< p_n [Pa], size grid.size()
  std::vector<double> traction_x, traction_y;      ///< on body 1 [Pa]; empty when frictionless
  std::vector<double> displacement_n, displacement_x, displacement_y;  ///< u_1 - u_2 [m]
  std::vector<double> slip_x, slip_y;              ///< relative slip s (shift: slip distance [m]); exterior elements 0
  std::vector<double> friction;                    ///< mu per element
  std::vector<ElementState> state;

  double approach = 0.0;                           ///< [m]
  Creepage creepage;                               ///< as used or found
  double rolling_step = 0.0;                       ///< dq used [m]
  double force_n = 0.0, force_x = 0.0, force_y = 0.0;  ///< on body 1 [N]
  double moment_x = 0.0, moment_y = 0.0, moment_n = 0.0;  ///< about the grid's origin [N m]
  double max_pressure = 0.0;                       ///< [Pa]
  double elastic_energy = 0.0;                     ///< [J]
  double frictional_power = 0.0;                   ///< [W], negative = dissipated (shift: work [J])
  int elements_contact = 0, elements_adhesion = 0, elements_slip = 0;
};

/// Sum of forces, moments, energy, power and counts from the fields of a solution.
void accumulate_totals(const ContactProblem& problem, ContactSolution& solution);

}  // namespace treadmark::kalker
