// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/damage/surface_record.hpp"

#include <algorithm>

namespace treadmark {

double CellSheet::sum() const {
  double sum = 0.0;
  for (const auto& [j, row] : rows_)
    for (const double value : row) sum += value;
  return sum;
}

double CellSheet::largest() const {
  double largest = 0.0;
  for (const auto& [j, row] : rows_)
    for (const double value : row) largest = std::max(largest, value);
  return largest;
}

StressRecord::StressRecord(int nu) {
  for (const auto& row : kStressSheets) this->*row.sheet = CellSheet(nu);
}

FlowRecord::FlowRecord(int nu) {
  for (const auto& row : kFlowSheets) this->*row.sheet = CellSheet(nu);
}

SurfaceRecord::SurfaceRecord(int nu, std::size_t depths, std::size_t flow_depths)
    : stresses(depths, StressRecord(nu)), flow(flow_depths, FlowRecord(nu)) {
  for (const auto& row : kSheets) this->*row.sheet = CellSheet(nu);
}

std::size_t SurfaceRecord::memory_bytes() const {
  std::size_t sum = 0;
  for (const auto& row : kSheets) sum += (this->*row.sheet).memory_bytes();
  for (const StressRecord& s : stresses)
    for (const auto& row : kStressSheets) sum += (s.*row.sheet).memory_bytes();
  for (const FlowRecord& f : flow)
    for (const auto& row : kFlowSheets) sum += (f.*row.sheet).memory_bytes();
  return sum;
}

}  // namespace treadmark
