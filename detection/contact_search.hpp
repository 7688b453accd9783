// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "treadmark/detection/contact_locus.hpp"
#include "treadmark/detection/contact_program/reference_locus.hpp"
#include "treadmark/detection/detector.hpp"
#include "treadmark/detection/pruned_gap.hpp"
#include "treadmark/detection/reference_change.hpp"

namespace treadmark::detection {

/// The contact search (Figure 3 a-h of Vollebregt's paper on 3D wheel and rail surfaces): gap on a grid,
/// interpenetration regions, weighted contact reference and angle, contact patches. Of the grid only what may touch is
/// evaluated (PrunedGap); where profiles are constant, also beside defects, there is no grid (ContactLocus). What was
/// evaluated stays: a wheel that moves along z of T only shifts its gap, so that a force iteration asks at() for one
/// position after the other. The surfaces must outlive this. Deterministic; results do not depend on the questions
/// before, but for rounding. One per thread.
class ContactSearch final : public Detector {
 public:
  /// Errors: Error(configuration) if the search grid is absurdly large, or for SearchMethod::locus without constant
  /// profiles.
  ContactSearch(const BodyPair& bodies, const SearchSettings& settings);

  /// The method in use; never automatic.
  SearchMethod method() const { return locus_ || reference_locus_ ? SearchMethod::locus : settings_.method; }

  double least_gap() override;  ///< on the first grid
  SearchResult at(double wheel_dz) override;
  std::optional<ReferenceChange> reference_change(double wheel_dz, const ContactPatch& patch) override;
  std::optional<WrongLocus> wrong_locus() const override { return locus_check_ ? locus_check_->wrong() : std::nullopt; }

  /// Points of the first grid whose heights were asked for so far.
  std::size_t points_evaluated() const { return gap_ ? gap_->points_known() : 0; }

 private:
  SearchResult found_on_locus(ContactLocus::Found found) const;
  double look_below() const;
  SearchResult on_grid(double wheel_dz, double look_below, ReferenceSum* sum = nullptr);
  const GapField& refined(const Region& region);
  double closest_on_grid();

  BodyPair bodies_;
  SearchSettings settings_;
  std::optional<ContactLocus> locus_;
  std::optional<ReferenceLocus> reference_locus_;
  std::optional<PrunedGap> gap_;
  std::optional<LocusCheck> locus_check_;  ///< against gap_
  std::optional<double> closest_;          ///< at the position given at construction [m]; found out when needed
  struct Refined {
    Grid2 grid;
    GapField field;
  };
  std::vector<std::unique_ptr<Refined>> refined_;  ///< made before, latest last
};

/// One search at the given position.
SearchResult search_contact(const BodyPair& bodies, const SearchSettings& settings);

}  // namespace treadmark::detection
