// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/import/import_scan.hpp"

namespace treadmark::app {

/// Whether a scan is imported tile by tile: a rail that becomes slices, by the settings and the size of its files.
/// Errors: Error(configuration) where that is asked for and cannot be.
bool goes_by_tiles(const ImportRequest& request);

/// Where an import by tiles keeps what is finished while it is not at its end.
std::filesystem::path unfinished_file(const ImportRequest& request);

/// The same as import_scan in bounded memory: a sample of the points tells line, place and section; then all points are
/// sorted by place along the rail into a file beside the output, and fitted tile by tile on one grid of knots. Tiles
/// look so far beyond their ends that what they are at a seam is the same from both sides (10 nm). Where a hole stays
/// open the surface ends: then there is a file for each stretch between, NAME-1.slcs, NAME-2.slcs ..., of one frame.
/// What was finished before it was stopped, or the disk was full, is kept, and the same request goes on from there.
/// Errors: as import_scan.
io::ImportReport import_tiles(const ImportRequest& request, const Progress& progress);

}  // namespace treadmark::app
