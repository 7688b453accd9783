// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/frame_packer.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "treadmark/report/field_catalogue.hpp"

namespace treadmark::report {
namespace {

constexpr int kMargin = 4;  // elements

/// How much is kept.
struct Detail {
  Precision precision;
  std::size_t fields;  ///< the first ones of the catalogue
  int every;           ///< frame
};

constexpr std::size_t kAllFields = 1000;  // with 5 there are pressure, state and tractions
constexpr Detail kDetails[] = {{Precision::two_bytes, kAllFields, 1},
                               {Precision::byte, kAllFields, 1},
                               {Precision::byte, 5, 1},
                               {Precision::byte, 2, 1},
                               {Precision::byte, 2, 4},
                               {Precision::byte, 2, 16},
                               {Precision::byte, 2, 64}};

template <class T>
std::vector<T> part_of(const std::vector<T>& values, const Grid2& grid, const GridPart& part) {
  std::vector<T> out;
  out.reserve(static_cast<std::size_t>(part.nx) * static_cast<std::size_t>(part.ny));
  for (int iy = part.iy0; iy < part.iy0 + part.ny; ++iy) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(iy) * grid.nx + part.ix0;
    out.insert(out.end(), first, first + part.nx);
  }
  return out;
}

PackedPatch pack_patch(const io::PatchResult& patch, const Detail& detail, BlobStore& blobs) {
  PackedPatch out{shown_part(patch.fields), {}};
  const std::size_t size = patch.fields.grid.size();
  for (const FieldInfo& field : field_catalogue().first(std::min(detail.fields, field_catalogue().size()))) {
    if (field.kind == FieldInfo::Kind::state) {
      if (patch.fields.state.size() == size && size > 0)
        out.values.emplace_back(field.name, blobs.add_codes(part_of(patch.fields.state, patch.fields.grid, out.part)));
      continue;
    }
    const std::vector<double> values = field.values(patch);
    if (values.size() == size && size > 0)
      out.values.emplace_back(field.name, blobs.add(part_of(values, patch.fields.grid, out.part), detail.precision));
  }
  return out;
}

std::string trimmed_words(const Detail& detail, bool without_fields) {
  if (without_fields) return "The fields of this step are not in this file, to keep it small.";
  if (detail.fields < field_catalogue().size()) return "Only the main fields are in this file, to keep it small.";
  return {};
}

PackedSets pack(const std::vector<FrameSet>& sets, BlobStore& blobs, const Detail& detail) {
  PackedSets out;
  for (const FrameSet& set : sets) {
    std::vector<PackedFrame>& frames = out.emplace_back();
    for (std::size_t i = 0; i < set.frames.size(); ++i) {
      PackedFrame& frame = frames.emplace_back();
      const bool left_out = i % static_cast<std::size_t>(detail.every) != 0;
      frame.trimmed = trimmed_words(detail, left_out);
      if (left_out) continue;
      blobs.begin_blob();
      for (const io::PatchResult& patch : set.frames[i].result->patches)
        frame.patches.push_back(pack_patch(patch, detail, blobs));
    }
  }
  return out;
}

/// What stands beside the numbers of the fields, about [bytes]: names, numbers and places of cases and patches.
std::size_t size_of_words(const PackedSets& sets) {
  constexpr std::size_t kFrame = 500, kPatch = 900, kField = 120;
  std::size_t size = 0;
  for (const auto& frames : sets)
    for (const PackedFrame& frame : frames) {
      size += kFrame;
      for (const PackedPatch& patch : frame.patches) size += kPatch + kField * patch.values.size();
    }
  return size;
}

}  // namespace

GridPart shown_part(const io::PatchFields& fields) {
  const Grid2& grid = fields.grid;
  int x_low = grid.nx, x_high = -1, y_low = grid.ny, y_high = -1;
  for (std::size_t i = 0; i < fields.pressure.size(); ++i) {
    const bool contact = fields.state.size() == fields.pressure.size() ? fields.state[i] > 0 : fields.pressure[i] > 0.0;
    if (!contact) continue;
    const int ix = static_cast<int>(i % static_cast<std::size_t>(grid.nx)),
              iy = static_cast<int>(i / static_cast<std::size_t>(grid.nx));
    x_low = std::min(x_low, ix), x_high = std::max(x_high, ix);
    y_low = std::min(y_low, iy), y_high = std::max(y_high, iy);
  }
  if (x_high < 0) return {0, 0, grid.nx, grid.ny};
  x_low = std::max(0, x_low - kMargin), y_low = std::max(0, y_low - kMargin);
  x_high = std::min(grid.nx - 1, x_high + kMargin), y_high = std::min(grid.ny - 1, y_high + kMargin);
  return {x_low, y_low, x_high - x_low + 1, y_high - y_low + 1};
}

PackedSets pack_frames(const std::vector<FrameSet>& sets, BlobStore& blobs, std::size_t budget) {
  for (const Detail& detail : kDetails) {
    BlobStore attempt = blobs;
    PackedSets packed = pack(sets, attempt, detail);
    attempt.finish();
    if (attempt.text_size() + size_of_words(packed) <= budget || &detail == std::end(kDetails) - 1) {
      blobs = std::move(attempt);
      return packed;
    }
  }
  return {};
}

}  // namespace treadmark::report
