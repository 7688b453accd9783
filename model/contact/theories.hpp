// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "treadmark/model/contact/contact_settings.hpp"

namespace treadmark {

/// Which theories there are: one row each. Keys and schema of case files, control digits of .inp files, rules between
/// settings and `treadmark list solvers` read these tables; a new theory is an enumerator, a row and its
/// implementation.

/// How an input file of CONTACT (.inp) asks for a theory.
struct ContactDigit {
  int value = -1;                                ///< -1: no digit of its own
  std::string_view on_rail = {}, of_patch = {};  ///< what it needs in module 1 and 3; empty: nothing
};

/// What a theory cannot do without.
struct TheoryLimits {
  bool patch_only = false;      ///< not for a wheel on a rail
  bool hertzian = false;        ///< Hertzian geometry
  bool given_approach = false;  ///< of one patch: a given approach, not a normal force
  bool steady_only = false;     ///< tractions do not depend on the previous instant: no shift, no transient rolling
  bool rolling_only = false;    ///< steady or transient rolling: no shift
  bool full_normal = false;     ///< the full normal problem
  bool springs = false;         ///< tractions deform springs row by row, not half-spaces
  bool strips = false;          ///< ends of a strip may slip without traction, parts of a contact share the creepage
  bool no_slip = false;         ///< every element adheres, though tractions exceed friction
};

template <class Id>
struct Theory {
  Id id;
  std::string_view word;  ///< in case files
  std::string_view name;
  ContactDigit digit = {};
  TheoryLimits limits = {};
};

/// Rows lie in the order of the enumerators.
inline constexpr Theory<NormalModel> kNormalTheories[] = {
    {NormalModel::full, "full", "full normal problem", {0}},
    {NormalModel::elliptic,
     "elliptic",
     "elliptic pressure",
     {2, "", "Hertzian geometry only: IPOTCN < 0"},
     {.patch_only = true, .hertzian = true}},
    {NormalModel::parabolic,
     "parabolic",
     "parabolic pressure",
     {3, "", "Hertzian geometry only: IPOTCN < 0"},
     {.patch_only = true, .hertzian = true}},
    {NormalModel::semi_double_elliptic,
     "semi_double_elliptic",
     "semi-double-elliptic pressure (SDEC)",
     {4, "", "with IPOTCN = -6 only"},
     {.patch_only = true}},
    {NormalModel::kpec, "kpec", "KPEC", {5, "D other than 4", "N = 0 only"}, {.given_approach = true}},
    {NormalModel::analyn, "analyn", "ANALYN", {6, "D other than 4", "N = 0 only"}, {.given_approach = true}},
};

inline constexpr Theory<TangentialModel> kTangentialTheories[] = {
    {TangentialModel::full, "full", "Kalker's exact theory"},
    {TangentialModel::fastsim,
     "fastsim",
     "FASTSIM with three flexibilities",
     {3, "T = 0, 2, 3; D other than 3, 4", "T = 0, 2, 3"},
     {.rolling_only = true, .springs = true}},
    {TangentialModel::fastsim_one_flexibility,
     "fastsim_one_flexibility",
     "FASTSIM with one flexibility",
     {2, "T = 0, 2, 3; D other than 3, 4", "T = 0, 2, 3"},
     {.rolling_only = true, .springs = true}},
    {TangentialModel::fastrip,
     "fastrip",
     "FaStrip",
     {5, "T = 0, 3; D other than 3, 4", "T = 0, 3"},
     {.steady_only = true, .springs = true, .strips = true}},
    {TangentialModel::linear,
     "linear",
     "Kalker's linear theory: no slip and no friction bound, for creep coefficients",
     {},
     {.steady_only = true, .no_slip = true}},
};

inline constexpr Theory<Regime> kRegimes[] = {
    {Regime::frictionless, "none", "no tangential problem", {0}},
    {Regime::shift, "shift", "shift", {1}},
    {Regime::transient, "transient", "transient rolling", {2}},
    {Regime::steady, "steady", "steady rolling", {3, "", "CHI = 0 or 180d"}},
};

inline constexpr Theory<InfluenceSettings::Kind> kInfluenceKinds[] = {
    {InfluenceSettings::Kind::constant, "constant", "half-space, constant elements", {2}},
    {InfluenceSettings::Kind::bilinear, "bilinear", "half-space, bilinear elements", {3}},
    {InfluenceSettings::Kind::angle_corrected,
     "angle_corrected",
     "angle-corrected influence coefficients",
     {4, "D = 4 and B = 0, 1", "B = 0, 1 and M = 0, 2 ... 5"},
     {.full_normal = true}},
    {InfluenceSettings::Kind::table,
     "table",
     "numerical influence coefficients from a file",
     {9, "", "B = 0, 1 and M = 0, 2 ... 5; NMATRIX = 1 in the file"},
     {.patch_only = true, .full_normal = true}},
};

constexpr const Theory<NormalModel>& theory(NormalModel id) { return kNormalTheories[static_cast<std::size_t>(id)]; }
constexpr const Theory<TangentialModel>& theory(TangentialModel id) {
  return kTangentialTheories[static_cast<std::size_t>(id)];
}
constexpr const Theory<Regime>& theory(Regime id) { return kRegimes[static_cast<std::size_t>(id)]; }
constexpr const Theory<InfluenceSettings::Kind>& theory(InfluenceSettings::Kind id) {
  return kInfluenceKinds[static_cast<std::size_t>(id)];
}

/// Whether the rigid slip may be another one at every element: not where there are strips, nor in the linear theory.
constexpr bool takes_slip_of_elements(TangentialModel id) {
  const TheoryLimits& limits = theory(id).limits;
  return !limits.strips && !limits.no_slip;
}

/// The theory that a control digit asks for; the first of the table where the digit asks for no other.
template <class Id, std::size_t count>
constexpr Id of_contact_digit(const Theory<Id> (&table)[count], int digit) {
  for (const Theory<Id>& row : table)
    if (row.digit.value == digit) return row.id;
  return table[0].id;
}

/// All tables as text, a line a theory.
std::string theory_list();

}  // namespace treadmark
