// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/bench/bench_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::app {

void write_bench_folder(const std::filesystem::path& folder, const BenchReport& report) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  write_file(output.path() / "bench.svg", bench_svg(report));
  write_file(output.path() / "bench.csv", bench_csv(report));
  write_file(output.path() / "bench.json", bench_json(report));
  output.move_into("bench.json");
}

namespace {

struct Cell {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double value) const { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return io::csv_cell(value); }
};

template <class Text>
std::string line(const std::vector<io::NamedField>& fields, Text text) {
  std::string out;
  for (const io::NamedField& field : fields) {
    if (!out.empty()) out += ',';
    out += text(field);
  }
  return out + '\n';
}

}  // namespace

std::vector<io::NamedField> bench_fields(const BenchRow& row) {
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return {
      {"backend", row.backend},
      {"resolution_mm", row.resolution > 0.0 ? io::FieldValue(1e3 * row.resolution) : io::FieldValue(BenchRow::kNone)},
      {"body", std::string(row.body == Body::rail ? "rail" : "wheel")},
      {"agrees", std::string(row.agrees ? "true" : "false")},
      {"reason", row.reason},
      {"difference_um", 1e6 * row.difference},
      {"build_s", row.build},
      {"memory_bytes", count(row.memory_bytes)},
      {"points", count(row.points)},
      {"ns_per_height", 1e9 * row.height},
      {"ns_per_height_tilted", 1e9 * row.height_tilted},
      {"ns_per_normal", 1e9 * row.normal},
      {"base_ns_per_height", 1e9 * row.base_height},
      {"search_cold_s", row.search_cold},
      {"search_warm_s", row.search_warm},
      {"distance_s", row.distance},
      {"patches", row.patches >= 0 ? io::FieldValue(std::int64_t{row.patches}) : io::FieldValue(BenchRow::kNone)}};
}

std::string bench_csv(const BenchReport& report) {
  std::string out = line(bench_fields({}), [](const io::NamedField& f) { return std::string(f.name); });
  for (const BenchRow& row : report.rows)
    out += line(bench_fields(row), [](const io::NamedField& f) { return std::visit(Cell{}, f.value); });
  return out;
}

}  // namespace treadmark::app
