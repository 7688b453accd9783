// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// The profile that was smoothed by its noise; nullptr for other surfaces.
const Profile* noisy_profile(const NaturalSurface& natural);

/// What noise leaves uncertain of the surfaces of one pair. Immutable; safe from any thread.
class NoiseOfResults {
 public:
  NoiseOfResults(const NaturalSurface& rail, const NaturalSurface& wheel);

  /// Whether a profile of the pair was smoothed by its noise.
  bool any() const { return rail_.draws || wheel_.draws; }
  /// Adds to each patch the uncertainty that the noise of its profiles leaves, and a remark where it is large. Patches
  /// without fields stay as they are.
  void add(const io::WheelRailCase& input, io::CaseResult& result) const;

 private:
  struct Known {
    std::shared_ptr<const ProfileScatter> scatter;
    std::optional<measured::ErrorDraws> draws;
    std::vector<double> y, z;  ///< points [m]
    /// Arc length of the nearest point [m].
    double arc_at(double y_at, double z_at) const;
  };
  static Known known_of(const NaturalSurface& natural);
  io::PatchResult::Noise of_patch(const io::WheelRailCase& input, const io::PatchResult& patch) const;

  Known rail_, wheel_;
};

}  // namespace treadmark::app
