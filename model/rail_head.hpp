// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

namespace treadmark {

/// Points of a section that are a rail's head, of which `top` is the highest one.
struct RailHead {
  std::size_t first = 0, last = 0, top = 0;
  double z_top = 0.0;  ///< [m]
};

/// Of what lies less than `depth` below its own top in one piece the widest: the head without a keeper or check rail
/// beside its groove, which may be up to 30 mm higher, by its place or by the rail's inclination. innermost: the piece
/// of least y less than `depth` below the top of all instead, and that top. y, z: of points along the section, z down
/// [m]; those without z (NaN) are holes, which end nothing. height: of the top near a point, where it is known better
/// than by the points. Nothing where no point has a height. Thread-safe.
std::optional<RailHead> head_of_rail(std::span<const double> y, std::span<const double> z, double depth,
                                     bool innermost = false, const std::function<double(std::size_t)>& height = {});

}  // namespace treadmark
