// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/report/blob_store.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::report {

/// The part of a patch's grid that a report keeps: what is in contact and a margin around it.
struct GridPart {
  int ix0 = 0, iy0 = 0, nx = 0, ny = 0;
};

/// The elements in contact with a margin of elements around them; without contact the whole grid.
GridPart shown_part(const io::PatchFields& fields);

struct PackedPatch {
  GridPart part;
  std::vector<std::pair<std::string, Packed>> values;  ///< by the names of the catalogue
};

struct PackedFrame {
  std::vector<PackedPatch> patches;
  std::string trimmed;  ///< what was left out for the size of the file
};

using PackedSets = std::vector<std::vector<PackedFrame>>;

/// Packs all frames, one blob each, within the budget [bytes of text, numbers of patches included]: first with two
/// bytes a value, then with one, then with fewer fields, finally with fewer frames.
/// Each frame says what was left out.
PackedSets pack_frames(const std::vector<FrameSet>& sets, BlobStore& blobs, std::size_t budget);

}  // namespace treadmark::report
