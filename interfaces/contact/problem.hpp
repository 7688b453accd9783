// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/app/cases/basic_case.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/interfaces/contact/flags.hpp"
#include "treadmark/interfaces/contact/units.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::contact {

/// Material numbers as they were set, SI units.
struct MaterialInput {
  double fg[2] = {0.0, 0.0}, relaxation[2] = {0.0, 0.0};           ///< [-], [s]
  double flexibility = 0.0, k0 = 1.0, alpha = 1.0, beta = 1.0;     ///< of simplified theory [m/Pa], [-]
  double g3 = 1e6, thickness = 0.0, yield = 0.0, hardening = 0.0;  ///< of the layer [Pa], [m], [Pa], [Pa/m]
  Damping damping;
};

/// A wheel or rail profile that the caller has given.
struct GivenProfile {
  int code = 1;  ///< 0 good, 1 never set, 2 file not found, 3 else
  std::string name;
  io::SurfaceSource source;                    ///< the file, or how its points are to be read
  std::string points;                          ///< as a text of two columns; empty: a file
  std::optional<SurfaceSpec> spec;             ///< but for the radius
  std::optional<spline::ProfileSpline> curve;  ///< of one profile; none of slices
  std::shared_ptr<const NaturalSurface> built;
  double built_radius = 0.0;
};

struct Stopwatch {
  double cpu = 0.0, wall = 0.0;  ///< [s]
};

/// What points below the surface are wanted: blocks from 1.
using SubsurfaceBlocks = std::vector<io::SubsurfaceInput::Block>;

/// A contact problem: one wheel on one rail with all its patches, or one of the basic problems of a result element.
/// What is given is kept in the structs that readers of CONTACT's input files fill, in SI units; nothing is judged
/// before it is solved.
struct Problem {
  Problem(int element, int number, int module);

  const int element, number, module;  ///< ire, icp (-1: of a wheel on a rail), 1 or 3
  std::mutex mutex;                   ///< for all below
  std::atomic<bool> solving{false};

  Units units;
  Flags flags;
  io::ContactSequence given;
  MaterialInput material;
  int material_digit = 0, friction_digit = 0, heat_digit = 0;
  bool damped = false;
  double time_step = 1.0;          ///< of a shift [s]
  std::map<int, double> metadata;  ///< by code, as given
  GivenProfile rail, wheel;
  GivenProfile& profile(Body body) { return body == Body::wheel ? wheel : rail; }

  SubsurfaceBlocks blocks;
  std::map<int, SubsurfaceBlocks> blocks_of_patch;

  app::BasicSequence basic;
  wheelrail::Geometry geometry;
  std::optional<wheelrail::Pair> pair;
  std::optional<io::Case> previous;  ///< the last one that was solved

  /// The last solution; none before the first one and after one that failed.
  std::optional<io::CaseResult> result;
  std::optional<wheelrail::PairSolution> solution;  ///< of a wheel on a rail
  std::map<int, Stopwatch> times;                   ///< by patch from 0
};

/// The case that the settings of a problem make. Errors: Error, Refusal.
io::Case compose(const Problem& problem);

/// The surfaces of wheel and rail, built anew where a radius has changed. Errors: Error; Refusal for a missing profile.
wheelrail::Geometry surfaces(Problem& problem, const io::WheelRailCase& input);

/// Reads a profile, or whatever else stands for a wheel or rail, at once; says in the problem how it went.
/// Errors: Error, after that.
void give_profile(Problem& problem, Body body, const io::SurfaceSource& source);

/// The patch of a solution, from 0; null: there is none.
const io::PatchResult* patch_result(const Problem& problem, int patch);

}  // namespace treadmark::contact
