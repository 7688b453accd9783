// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

namespace treadmark::measured {

/// A contact patch as rows across the rolling direction, in which both bodies are cylinders.
struct PatchRows {
  double width = 0.0;        ///< of a row [m]
  std::vector<double> gap;   ///< of the undeformed bodies in the middle of each row [m]; NaN: no surface
  double curvature_x = 0.0;  ///< sum of the bodies' curvatures in the rolling direction [1/m]
  double modulus = 0.0;      ///< G / (1 - nu) of the pair [Pa]
  double force = 0.0;        ///< [N]
};

/// How far numbers of a patch may be off because of errors of its gap: standard deviations.
struct PatchSpread {
  double pressure = 0.0, area = 0.0;  ///< of the largest pressure and of the contact area, over their values
  double force = 0.0;                 ///< of the force over its value, where the approach is prescribed
  double shift = 0.0;                 ///< of the middle of pressure across the rolling direction [m]
};

/// From draws of the gap's error in each row, by an approximate contact of rows: where the bodies would intersect at
/// 0.55 of the approach there is contact, with pressure semi-elliptic along each row (Kik and Piotrowski 1996). Only
/// ratios of its pressures are used, which it gives within a few per cent.
PatchSpread patch_spread(const PatchRows& rows, std::span<const std::vector<double>> errors);

}  // namespace treadmark::measured
