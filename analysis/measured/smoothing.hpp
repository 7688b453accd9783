// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/profile_scatter.hpp"

namespace treadmark::measured {

/// Noise below which points are taken as exact [m]: tables that are rounded to 0.1 um are.
inline constexpr double kExactPoints = 0.1e-6;

/// The profile with its points moved onto the curve that they stand for, and its scatter. The curve is the most
/// probable one whose curvature is a random walk, the more restless the more a wheel is bent around, or the more the
/// curvature of a rail changes around; restlessness and noise by restricted maximum likelihood (Wahba 1985), and
/// rounded numbers are known within half a step only. Exact points stay where they are; where they lie far apart, what
/// the curve may be off between them is known (interpolation.hpp). The profile's smoothing is then that of an
/// interpolation. Errors: none; points that no curve fits stay, too.
Profile smoothed_by_noise(Profile profile);

/// Whether it is known what the curve of a profile may be off: by noise, or between exact points.
inline bool has_errors(const Profile& profile) { return profile.scatter && !profile.scatter->s.empty(); }

/// Whether the points of a profile were moved onto a curve by their noise.
inline bool is_smoothed(const Profile& profile) { return has_errors(profile) && profile.scatter->between.empty(); }

/// Standard deviation of a sum of weights times the curve's errors across itself, at these arc lengths (those of
/// scatter.s). 0 where the points were not smoothed.
double deviation_of_sum(const ProfileScatter& scatter, std::span<const double> s, std::span<const double> weights);

/// Standard deviations of the curve across itself at its points, what other assumptions make of them included [m]; of
/// exact points those beside them. Empty where nothing of them is known.
std::vector<double> deviations(const ProfileScatter& scatter);

/// Errors that the curve may have across itself, each as probable as any other, those of wheels and rails independent
/// of each other. Immutable; the same in every run.
class ErrorDraws {
 public:
  /// Of a profile that has errors.
  explicit ErrorDraws(const Profile& profile);

  std::size_t size() const;
  /// At an arc length [m]; beyond the ends as at them.
  double at(std::size_t draw, double s) const;
  /// The profile with these errors at its points; between exact ones it gets more of them.
  Profile moved(Profile profile, std::size_t draw) const;

 private:
  std::shared_ptr<const ProfileScatter> scatter_;
  std::size_t shift_;  ///< of the bit of a draw that says which way round another assumption's difference is
};

}  // namespace treadmark::measured
