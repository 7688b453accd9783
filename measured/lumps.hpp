// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <optional>

#include "treadmark/model/profile.hpp"

namespace treadmark::measured {

/// A few points that stand out of a profile which runs smoothly to both sides of them, as dirt or a chip does.
struct Lump {
  std::size_t first = 0, last = 0;  ///< points
  double height = 0.0;              ///< across the profile [m], positive: out of the material
};

/// The highest one that is significant against the noise (standard deviation across the profile [m]) and more than
/// 0.1 mm high, of one to six points and at most 3 mm wide (three points: 4.5 mm, unless `narrow`). Thread-safe.
std::optional<Lump> highest_lump(const Profile& profile, double noise, bool narrow = false);

}  // namespace treadmark::measured
