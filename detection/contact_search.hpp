// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/detection/contact_locus.hpp"
#include "treadmark/detection/contact_patch.hpp"
#include "treadmark/detection/interpenetration.hpp"
#include "treadmark/detection/pruned_gap.hpp"
#include "treadmark/detection/reference_locus.hpp"
#include "treadmark/detection/search_mesh.hpp"
#include "treadmark/model/wheel_on_rail.hpp"

namespace treadmark::detection {

using treadmark::SearchMethod;

struct SearchSettings {
  SearchMethod method = SearchMethod::automatic;
  Grid2 grid_T;  ///< first grid, seen along z of T; must cover everything that may touch
  PenetrationWeight weight = PenetrationWeight::squared;
  PatchRules rules;
  /// Evaluate every region again on a grid of its own, at least refined_points across in both directions and never
  /// finer than the given steps; the extents are then the interpolated zero crossings. Off: the first grid decides.
  bool refine = true;
  int refined_points = 64;
  double refined_dx = 0.0, refined_dy = 0.0;  ///< [m]
  /// On the first grid, for agreement with the reference program; refined grids are always exact.
  std::optional<SearchMesh> mesh;
  /// The locus on these rows instead of Treadmark's own, for agreement with that program; needs a round wheel. On a
  /// rail that changes along the track the grid decides instead where it shows other contact than the locus.
  std::optional<LocusRows> locus_rows;
  std::optional<DistanceMesh> distance_mesh;  ///< passed on to bodies_at()
  /// The contact reference is the point of deepest penetration instead of the weighted centre.
  bool reference_at_deepest = false;
};

struct SearchResult {
  std::vector<ContactPatch> patches;  ///< field side first
  /// Least gap over the search grid [m]: negative with contact, NaN where the bodies nowhere face each other.
  double least_gap = 0.0;
  /// The same between the points of the grid as well: exact to a nanometre unless the mesh or the grid of the reference
  /// program is asked for, and without jumps where contact comes and goes [m].
  double closest = 0.0;
};

/// The contact search (Figure 3 a-h of Vollebregt's paper on 3D wheel and rail surfaces): gap on a grid,
/// interpenetration regions, weighted contact reference and angle, contact patches. Of the grid only what may touch is
/// evaluated (PrunedGap); where profiles are constant, also beside defects, there is no grid (ContactLocus). What was
/// evaluated stays: a wheel that moves along z of T only shifts its gap, so that a force iteration asks at() for one
/// position after the other. The surfaces must outlive this. Deterministic; results do not depend on the questions
/// before, but for rounding. One per thread.
class ContactSearch {
 public:
  /// Errors: Error(configuration) if the search grid is absurdly large, or for SearchMethod::locus without constant
  /// profiles.
  ContactSearch(const BodyPair& bodies, const SearchSettings& settings);

  /// The method in use; never automatic.
  SearchMethod method() const { return locus_ || reference_locus_ ? SearchMethod::locus : settings_.method; }

  /// Least gap [m] at the position given at construction, on the first grid; NaN where the bodies nowhere face each
  /// other.
  double least_gap();

  /// Patches with the wheel moved by wheel_dz [m] along z of T from the position given at construction.
  SearchResult at(double wheel_dz);

  /// Rows between two points in T in which the locus of the reference program missed contact, or found some where there
  /// is none.
  struct WrongLocus {
    Vec3 low, high;
    bool grid_decides;  ///< false: no wheel could roll over what was missed
  };
  /// By the last at().
  const std::optional<WrongLocus>& wrong_locus() const { return wrong_; }

  /// The bodies with the wheel moved.
  BodyPair bodies_at(double wheel_dz) const;

  /// Points of the first grid whose heights were asked for so far.
  std::size_t points_evaluated() const { return gap_ ? gap_->points_known() : 0; }

 private:
  SearchResult found_on_locus(ContactLocus::Found found) const;
  bool is_wrong(double wheel_dz, const std::vector<ContactPatch>& found);
  SearchResult on_grid(double wheel_dz, double look_below);
  const GapField& refined(const Region& region);
  double closest_on_grid();

  BodyPair bodies_;
  SearchSettings settings_;
  std::optional<ContactLocus> locus_;
  std::optional<ReferenceLocus> reference_locus_;
  std::optional<PrunedGap> gap_;
  double agreed_ = -kInfinity;  ///< greatest wheel_dz at which locus and grid show the same contact
  std::optional<WrongLocus> wrong_;
  std::optional<double> closest_;  ///< at the position given at construction [m]; found out when needed
  struct Refined {
    Grid2 grid;
    GapField field;
  };
  std::vector<std::unique_ptr<Refined>> refined_;  ///< made before, latest last
};

/// One search at the given position.
SearchResult search_contact(const BodyPair& bodies, const SearchSettings& settings);

}  // namespace treadmark::detection
