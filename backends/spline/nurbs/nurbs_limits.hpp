// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

/// Limits that the scalar search for a hit in a leaf (nurbs_leaf.hpp) and the one in lanes share.
namespace treadmark::spline::nurbs_limits {

// Of s and t: how far beyond the border a solution still belongs to the leaf (neighbours meet there), and how far steps
// may lead.
constexpr double kBorder = 0.5 + 1e-9, kFurthest = 0.75;
constexpr double kContraction = 0.5;  // greatest |E| of a regular leaf
constexpr double kRounding = 1e-9;    // of ranges of s and t
constexpr double kSlack = 1e-9;       // [m] rounding of boxes
// Residuals [m] at which a last step of first order is exact: its error is their square times curvature.
constexpr double kNear = 1e-8, kExact = 1e-11;

}  // namespace treadmark::spline::nurbs_limits
