// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/surface_record.hpp"

namespace treadmark {

std::size_t SurfaceRecord::memory_bytes() const {
  std::size_t sum = 0;
  for (const CellSheet* sheet :
       {&volume, &work, &sliding, &passages, &pressure, &traction, &t_gamma, &fi_surf, &damage})
    sum += sheet->memory_bytes();
  for (const StressRecord& s : stresses)
    for (const CellSheet* sheet : {&s.von_mises, &s.shear, &s.shakedown, &s.dang_van}) sum += sheet->memory_bytes();
  return sum;
}

}  // namespace treadmark
