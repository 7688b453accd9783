// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/make.hpp"

#include <utility>

#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/backends/offset/sheet_field.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::offset {

std::shared_ptr<const Surface> make_offset_surface(std::shared_ptr<const Surface> base,
                                                   std::shared_ptr<const SparseOffsets> offsets,
                                                   Interpolation interpolation, std::string backend) {
  if (!base || !offsets) throw Error(ErrorKind::configuration, "an offset surface needs a base and offsets");
  const Body body = offsets->frame.body;
  if ((base->facing() == Facing::down) != (body == Body::wheel))
    throw Error(ErrorKind::configuration, body == Body::wheel ? "offsets of a wheel cannot be added to a rail"
                                                              : "offsets of a rail cannot be added to a wheel");
  return displacement::make_displaced_surface(std::move(base), make_sheet_field(std::move(offsets), interpolation),
                                              body, std::move(backend));
}

std::size_t memory_bytes(const SparseOffsets& offsets) { return sizeof(offsets) + offsets.grid.memory_bytes(); }

std::size_t active_count(const SparseOffsets& offsets) { return offsets.grid.active_count(); }

}  // namespace treadmark::offset
