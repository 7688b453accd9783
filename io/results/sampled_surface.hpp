// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace treadmark::io {

/// Points of a wheel or rail as it was used in a run: nu stations, nv points across in each. In the axes of the body:
/// of a wheel on its axle (x = r sin(theta), z = r cos(theta)), of a rail those of its profile; that of a left-hand
/// pair already is the mirror image.
struct SampledSurface {
  std::string body;  ///< "wheel" or "rail"
  std::string name;  ///< in the run: "wheel_1"
  int nu = 0, nv = 0;
  bool closed = false;          ///< the last station joins the first
  std::vector<double> u;        ///< stations: x of a rail [m], angle round a wheel or roller [rad]; increasing
  std::vector<double> x, y, z;  ///< [m], station after station, y increasing in each; NaN = no surface
  std::vector<double>
      deviation;  ///< along the outward normal from the body's mean section [m]; empty: all sections are alike

  std::size_t index(int iu, int iv) const {
    return static_cast<std::size_t>(iu) * static_cast<std::size_t>(nv) + static_cast<std::size_t>(iv);
  }
};

/// Errors: Error(configuration) for lists of wrong lengths, other bodies than these two, and names that are not fit for
/// a file or repeated.
void check_surfaces(std::span<const SampledSurface> surfaces);

/// Index of the surface of this name; -1 = none.
int surface_index(std::span<const SampledSurface> surfaces, const std::string& name);

}  // namespace treadmark::io
