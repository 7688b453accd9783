// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_csv.hpp"

#include <fmt/format.h>

#include <cmath>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/csv_text.hpp"
#include "treadmark/io/results/comparison_fields.hpp"

namespace treadmark::io {
namespace {

struct CellText {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double value) const { return std::isfinite(value) ? fmt::format("{:.12g}", value + 0.0) : ""; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return csv_cell(value); }
};

template <class Cell>
std::string line(const std::vector<NamedField>& fields, Cell cell) {
  std::string out;
  for (const NamedField& field : fields) {
    if (&field != fields.data()) out += ',';
    out += cell(field);
  }
  return out + '\n';
}

}  // namespace

std::string to_csv(const Comparison& comparison) {
  std::string out = line(row_fields({}, {}), [](const NamedField& field) { return std::string(field.name); });
  for (const ComparisonCandidate& candidate : comparison.candidates)
    for (const ComparisonRow& row : candidate.rows)
      out +=
          line(row_fields(candidate, row), [](const NamedField& field) { return std::visit(CellText{}, field.value); });
  return out;
}

void write_csv(const std::filesystem::path& path, const Comparison& comparison) {
  write_text_file(path, to_csv(comparison));
}

}  // namespace treadmark::io
