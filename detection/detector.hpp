// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/detection/contact_patch.hpp"
#include "treadmark/detection/contact_program/reference_locus.hpp"
#include "treadmark/detection/contact_program/search_mesh.hpp"
#include "treadmark/detection/interpenetration.hpp"
#include "treadmark/model/contact/wheel_on_rail.hpp"

namespace treadmark::detection {

using treadmark::SearchMethod;

/// What is looked for, and how finely.
struct SearchSettings {
  SearchMethod method = SearchMethod::automatic;  ///< of the built-in detectors
  Grid2 grid_T;  ///< first grid, seen along z of T; must cover everything that may touch
  PenetrationWeight weight = PenetrationWeight::squared;  ///< of the depth in the contact reference
  PatchRules rules;                                       ///< which regions make one patch
  /// Evaluate every region again on a grid of its own, at least refined_points across in both directions and never
  /// finer than the given steps; the extents are then the interpolated zero crossings. Off: the first grid decides.
  bool refine = true;
  int refined_points = 64;                    ///< see refine
  double refined_dx = 0.0, refined_dy = 0.0;  ///< see refine [m]
  /// On the first grid (Conventions::contact); refined grids are always exact.
  std::optional<WheelFacets> facets;
  /// The locus on these rows instead of Treadmark's own (Conventions::contact); needs a round wheel. On a rail that
  /// changes along the track the grid decides instead where it shows other contact than the locus.
  std::optional<LocusRows> locus_rows;
  /// The contact reference is the point of deepest penetration instead of the weighted centre.
  bool reference_at_deepest = false;
};

/// What was found at one position.
struct SearchResult {
  std::vector<ContactPatch> patches;  ///< field side first
  /// Least gap over the search grid [m]: negative with contact, NaN where the bodies nowhere face each other.
  double least_gap = 0.0;
  /// The same between the points of the grid as well: exact to a nanometre where the search refines, and without jumps
  /// where contact comes and goes [m].
  double closest = 0.0;
};

/// The bodies with the wheel moved by wheel_dz [m] along z of T.
inline BodyPair moved(BodyPair bodies, double wheel_dz) {
  bodies.X_TW.origin.z() += wheel_dz;
  return bodies;
}

/// What looks for contact of two bodies, bound to one position of them: a wheel that moves along z of T only shifts
/// its gap. The surfaces outlive it. One per thread.
class Detector {
 public:
  virtual ~Detector() = default;

  /// Least gap [m] at the position given at construction; NaN where the bodies nowhere face each other.
  virtual double least_gap() = 0;

  /// Patches with the wheel moved by wheel_dz [m] along z of T from the position given at construction. Deterministic;
  /// results do not depend on the questions before, but for rounding.
  virtual SearchResult at(double wheel_dz) = 0;

  /// How the reference of a patch that at(wheel_dz) has found follows from the surfaces. Nothing: it is not known.
  virtual std::optional<ReferenceChange> reference_change(double wheel_dz, const ContactPatch& patch) {
    static_cast<void>(wheel_dz), static_cast<void>(patch);
    return std::nullopt;
  }

  /// What the last at() found wrong with a locus on rows.
  virtual std::optional<WrongLocus> wrong_locus() const { return std::nullopt; }
};

/// One way to look for contact: all that the rest of Treadmark knows of it.
struct DetectorRow {
  std::string name;     ///< for case files and the command line: small letters, digits, '-', '_'
  std::string summary;  ///< what it is, in one line
  /// Called from any thread. Errors: Error(configuration) for bodies or settings that it is not for.
  std::function<std::unique_ptr<Detector>(const BodyPair&, const SearchSettings&)> make;
};

/// Adds a detector; from then on it is a choice wherever names of detectors are read. Never removed. Safe from any
/// thread. Errors: Error(configuration) for a name that is taken or that no case file could hold, and a row that lacks
/// something.
void register_detector(DetectorRow row);

/// All of them: the built-in ones, then those added, in their order. The rows live as long as the program.
std::vector<const DetectorRow*> detectors();

/// Errors: Error(configuration) that lists the detectors if the name is none of them.
const DetectorRow& detector_of(std::string_view name);

}  // namespace treadmark::detection
