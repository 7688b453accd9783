// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstdlib>

#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"

namespace treadmark::fuzz {

/// What the surfaces rely on.
inline void require_sound(const offset::OffsetFile& file) {
  const offset::SheetFrame& f = file.offsets->frame;
  const bool sound = f.du > 0.0 && f.dy > 0.0 && std::isfinite(f.du + f.dy + f.u0 + f.y0 + f.first + f.last) &&
                     (f.body == Body::rail || std::isfinite(f.period())) && file.base.body == f.body;
  if (!sound) std::abort();
  for (const offset::SheetEntry& block : file.offsets->grid.blocks())
    for (int k = 0; k < offset::kBlockI * offset::kBlockJ; ++k)
      if (!std::isfinite(block.values[k])) std::abort();
}

}  // namespace treadmark::fuzz
