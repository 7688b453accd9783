// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/model/damage/fatigue.hpp"
#include "treadmark/model/damage/surface_record.hpp"
#include "treadmark/model/origin.hpp"
#include "treadmark/model/remarks.hpp"
#include "treadmark/model/rows.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io {

/// What came of an evolution, SI.

/// What is known of the material of a body, of a stored one as far as results need it, and what the present contacts do
/// to it.
struct EvolvedFatigue {
  FatigueSettings known;
  std::vector<ContactFatigue> contacts;  ///< by case: the largest of its patches
};

/// By which law the material of a body flows; no theory: it does not.
struct EvolvedFlow {
  std::string theory, source;  ///< word of kFlowTheories, and where its numbers come from
  std::vector<double> depths;  ///< of the strains of the record [m]
  double max_raised = 0.0;     ///< largest height above the surface as it was [m]
};

/// A number of a generation, for tables and charts.
struct EvolutionQuantity {
  std::string name;  ///< with its unit at the end
  std::string unit, meaning;
  double value = 0.0;
  unsigned shown = kInChart;  ///< of Shown
};

/// A body at one generation.
struct EvolvedBody {
  Body body = Body::wheel;
  std::string law, source;  ///< word of the theory, and where its numbers come from
  SurfaceCells cells;
  SurfaceRecord record;
  EvolvedFatigue fatigue;
  EvolvedFlow flow;
  double max_depth = 0.0;                  ///< [m]
  double max_slope = 0.0;                  ///< of the depth across [-]
  std::string surface_file;                ///< name in the folder
  std::vector<EvolutionQuantity> numbers;  ///< of the body as workshops measure it; may be none
  std::vector<double> z;  ///< height of the section of column 0 by row, profile coordinate z [m]; NaN: none
};

/// The contacts of a case at one generation.
struct EvolvedCase {
  int run = 0, number = 0;  ///< position, and case of its file, from 1
  std::string label, status;
  double weight = 0.0;
  int patches = 0, remarks = 0, doubts = 0;
  double fn = 0.0, fx = 0.0, fs = 0.0;  ///< sums over the patches [N]
  double pmax = 0.0;                    ///< [Pa]
  double t_gamma = 0.0;                 ///< power of friction over rolling speed [N]
};

struct Generation {
  int number = 0;
  double progress = 0.0;         ///< share of the whole
  double distance = 0.0;         ///< that the wheel has rolled [m]; 0 where it does not evolve
  double passages = 0.0;         ///< of wheels over the rail
  double next_step = 0.0;        ///< share that the step control proposes
  double step = 0.0;             ///< that led here
  int refused = 0;               ///< steps that changed pressures too much before it
  bool limits_kept = true;       ///< false: the smallest step changed more than the limits allow
  double pressure_change = 0.0;  ///< by the step that led here, the largest, as a share
  std::vector<EvolvedBody> bodies;
  std::vector<EvolvedCase> cases;
  std::vector<EvolutionQuantity> numbers;     ///< of the histories that contacts are from; none: there are no such ones
  std::vector<EvolutionQuantity> quantities;  ///< kept once records are forgotten; empty before
};

struct EvolutionResult : Origin {
  std::string status = "complete", message;  ///< "interrupted", "failed"
  std::vector<Remark> remarks;               ///< on the laws; stores have their sources, which say so too
  std::vector<Generation> generations;       ///< the last one with its records, others may have forgotten them
};

/// All quantities in their order; names are the same in all generations of a result.
std::vector<EvolutionQuantity> quantities_of(const Generation& generation);

/// How many grave remarks the contacts of all generations have.
double doubts_of(const EvolutionResult& result);

/// Empties the sheets of its records, which are most of its memory; quantities_of stays as it is.
void forget_records(Generation& generation);

/// Relative differences between what the law takes and what the geometry has lost, and between the work that is stored
/// on the surface and that of the contacts.
double volume_balance(const EvolvedBody& body);
double work_balance(const EvolvedBody& body);

}  // namespace treadmark::io

namespace treadmark {

template <>
std::span<const Column<io::Generation>> columns();
template <>
std::span<const Column<io::EvolvedBody>> columns();
template <>
std::span<const Column<io::EvolvedCase>> columns();

}  // namespace treadmark
