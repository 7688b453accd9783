// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "treadmark/scans/cleaning/band_points.hpp"

namespace treadmark::scans {

struct Hole {
  double a = 0.0, s = 0.0;  ///< where it is widest, a counts from the band's a_min [m]
  double diameter = 0.0;    ///< of the largest circle without points in it [m]
  double area = 0.0;        ///< [m^2]
  bool filled = false;      ///< not wider than the limit
};

/// What part of a band the points cover.
struct Coverage {
  double gap_a = 0.0,
         gap_s = 0.0;  ///< usual distance of points along a and along s: four fifths of the band have no wider one [m]
  double limit = 0.0;  ///< diameter up to which holes are filled [m]
  std::vector<Hole> holes;  ///< largest first
  double area = 0.0;        ///< of the band with all holes [m^2]
  double hole_area = 0.0;   ///< of all holes [m^2]
  std::size_t first_column = 0,
              last_column = 0;     ///< the columns in which most rows have points: the usable width (last is one past)
  std::vector<std::uint8_t> open;  ///< a cell of BandPoints: 1 = in a hole that stays open
  bool whole() const { return open.empty(); }
};

struct CoverageSettings {
  double hole_limit = 0.0;    ///< [m]; 0 = 10 mm, or twice the usual distance of the points if that is more
  double least_filled = 0.6;  ///< columns at the sides of the band with a smaller part of covered rows are left out
  const Coverage* usual = nullptr;  ///< of the whole band: what its gaps, limit and width are
};

/// Looks at points that are used or held out. Deterministic.
Coverage find_coverage(const BandPoints& points, const Band& band, const CoverageSettings& settings);

}  // namespace treadmark::scans
