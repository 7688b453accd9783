// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/csv_text.hpp"
#include "treadmark/io/histories/study_store.hpp"

namespace treadmark::io {

void write_sweep_csv(const std::filesystem::path& path, const StudyResult& study) {
  const StudyTable table = study_table(study);
  std::string out;
  for (const std::string& key : table.keys) out += csv_cell(key) + ',';
  for (const NamedValue& quantity : table.quantities) out += csv_cell(quantity.name) + ',';
  out += "run,label,status,message\n";
  for (const SimulationRun* run : table.runs) {
    for (const std::string& key : table.keys) {
      const std::string* value = swept_value(*run, key);
      out += (value != nullptr ? csv_cell(*value) : "") + ',';
    }
    for (const NamedValue& quantity : table.quantities) {
      const auto same = [&](const NamedValue& one) { return one.name == quantity.name; };
      const auto found = std::find_if(run->summary.begin(), run->summary.end(), same);
      out += (found != run->summary.end() ? csv_number(found->value) : "") + ',';
    }
    out +=
        fmt::format("{},{},{},{}\n", run->number, csv_cell(run->label), csv_cell(run->status), csv_cell(run->message));
  }
  write_text_file(path, out);
}

}  // namespace treadmark::io
