// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::pictures {

/// Pictures of a comparison as SVG text without scripts. All functions are thread-safe; an empty comparison gives an
/// empty picture.

/// Pressure of the patch that carries most of the load, for up to three cases: the first one, and those in which the
/// errors of the largest pressure differ most between the candidates (the earlier case where they are equal), in the
/// order of the cases. Each case is a block with one window and one scale of colours: the truth, then a column a
/// backend in the order of first appearance, and a row a resolution, from coarse to fine; more than eight columns are
/// spread over several bands (see comparison_grid.hpp). Below a panel: the largest pressure and its error. Errors:
/// Error(configuration) for fields that do not match their grid.
std::string pressures_svg(const io::Comparison& comparison);

/// Largest error of the largest pressure [%] and largest deviation of the surfaces [um] over the resolution [mm], both
/// axes logarithmic, a line a backend. Candidates without a resolution are dotted levels; the truth is not shown.
/// Values below 0.001 are drawn there as hollow markers. Lines and markers become smaller from backend to backend, and
/// every second line is dashed, so that those on the same values are all seen.
std::string error_svg(const io::Comparison& comparison);

/// Accuracy against cost: largest error of the largest pressure [%] over the mean time of search and distance per case
/// [ms], both axes logarithmic; the area of a marker grows with the memory. Errors below 0.001 % are drawn there as
/// hollow markers. Candidates that cannot be drawn are named below the chart.
std::string cost_svg(const io::Comparison& comparison);

}  // namespace treadmark::pictures
