// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "treadmark/app/import/layout_line.hpp"
#include "treadmark/app/import/write_outputs.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/io/imports/import_report.hpp"

namespace treadmark::app {

/// What the surface of a scan should be.
struct Truth {
  std::filesystem::path file, surface;  ///< as named; the surface
  NaturalSurface natural;
  std::optional<Pose> X_CT;           ///< the surface's frame in the cloud's [m]; nothing: only the surface is known
  std::optional<std::size_t> points;  ///< of the cloud
  LayoutLine line;  ///< along which a rail was scanned: X_CT is then that of the line's own frame; empty: straight
};

/// Reads what `treadmark scan --truth` wrote (*.json), with the surface that it names, or a surface: anything that
/// named_surface reads. nominal_radius: of a wheel whose file does not have it [m], or 0. Errors: those of the readers;
/// Error(configuration) for the other body or a surface that is not the one that was scanned.
Truth read_truth(const std::filesystem::path& file, Body body, double nominal_radius);

/// Errors: Error(configuration) if the truth is that of a cloud with another number of points.
void check_points(const Truth& truth, std::size_t points_read);

/// Compares the surface with the truth along its normal: frame on frame first, only stations counted from the same
/// place, then laid on it best by a rigid motion (least squares). Where the surface lies in the cloud tells which
/// stations belong together; without that the shift at which both agree best. Fills the report's truth and its map, or
/// warns where they have too little in common.
void compare_with_truth(const Truth& truth, const FittedScan& fit, io::ImportReport& report);

}  // namespace treadmark::app
