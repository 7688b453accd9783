// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/report/blob_store.hpp"
#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

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

/// Fields of all frames: a blob a frame, as precise and as many as the size [bytes of text, with what is said of
/// patches] allows: first two bytes a number, then one, then fewer quantities, at last fewer frames. What is left out
/// is said in the frames.
PackedSets pack_frames(const std::vector<FrameSet>& sets, BlobStore& blobs, std::size_t budget);

}  // namespace treadmark::app::report
