// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/history/history_archive.hpp"

#include "treadmark/core/byte_archive.hpp"

namespace treadmark::kalker {

void write(const ContactHistory& h, ByteWriter& out) {
  write(h.grid, out);
  for (const auto* field : {&h.pressure, &h.traction_x, &h.traction_y, &h.friction, &h.plastic_x, &h.plastic_y,
                            &h.yield_stress, &h.layer_x, &h.layer_y})
    out.put(*field);
}

ContactHistory read_history(ByteReader& in) {
  ContactHistory h;
  h.grid = read_grid(in);
  for (auto* field : {&h.pressure, &h.traction_x, &h.traction_y}) read_field(in, h.grid, false, *field);
  for (auto* field : {&h.friction, &h.plastic_x, &h.plastic_y, &h.yield_stress, &h.layer_x, &h.layer_y})
    read_field(in, h.grid, true, *field);
  if (h.plastic_x.size() != h.plastic_y.size()) refuse_saved_state("plastic shear has one component");
  if (h.layer_x.size() != h.layer_y.size()) refuse_saved_state("the displacement of a layer has one component");
  return h;
}

}  // namespace treadmark::kalker
