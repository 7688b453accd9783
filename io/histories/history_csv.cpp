// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/history_csv.hpp"

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/csv_text.hpp"

namespace treadmark::io {

void write_history_csv(const std::filesystem::path& path, const SimulationResult& result) {
  check_simulation(result);
  std::string out;
  const auto end_cell = [&](std::size_t column) { out += column + 1 < result.columns.size() ? ',' : '\n'; };
  for (std::size_t i = 0; i < result.columns.size(); ++i) {
    out += csv_cell(result.columns[i].name);
    end_cell(i);
  }
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    out += csv_number(result.values[i]);
    end_cell(i % result.columns.size());
  }
  write_text_file(path, out);
}

void write_events_csv(const std::filesystem::path& path, const SimulationResult& result) {
  std::string out = "t_s,x_m,wheel,kind\n";
  for (const HistoryEvent& event : result.events)
    out += csv_number(event.time) + ',' + csv_number(event.position) + ',' + csv_cell(event.wheel) + ',' +
           csv_cell(event.kind) + '\n';
  write_text_file(path, out);
}

void write_modes_csv(const std::filesystem::path& path, const SimulationResult& result) {
  std::string out = "frequency_Hz,damping_ratio,shape\n";
  for (const ModeRow& mode : result.modes)
    out += csv_number(mode.frequency_Hz) + ',' + csv_number(mode.damping_ratio) + ',' + csv_cell(mode.shape) + '\n';
  write_text_file(path, out);
}

}  // namespace treadmark::io
