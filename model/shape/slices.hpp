// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/model/shape/profile.hpp"

namespace treadmark {

/// Lateral cross-sections at successive longitudinal positions u of a rail (x along the track [m]) or a wheel
/// (angle theta about the axle [rad]; z of a slice is the radial height dr over the nominal radius).
struct SliceSet {
  Body body = Body::rail;
  std::string name;
  std::vector<double> u;          ///< strictly increasing: [m] rail, [rad] wheel
  std::vector<Profile> profiles;  ///< one per u
  bool approximate_u = false;     ///< false: interpolate the slices in u; true: slices are control points
  /// Arc-length positions of features, measured from the first point of each slice [m]; NaN = feature missing.
  /// Empty: one part that covers the whole profile. Otherwise features[i].size() is the same for every slice i.
  std::vector<std::vector<double>> features;
  /// Features (indices into features[i], neither the first nor the last, increasing) along which the surface may turn
  /// sharply.
  std::vector<int> kinks;
  /// Wheel with slices all round: false = smooth over the seam, as if slices went on for ever; true = constant between
  /// the last and the first slice.
  bool open_seam = false;
  /// Lateral places at which splines are laid through slices without features, so that parts of a set get those of the
  /// whole; 0: 0.5 mm apart along the longest slice.
  int across = 0;
};

}  // namespace treadmark
