// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/bench/bench_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark {
namespace {

using B = app::BenchRow;
using access::of;
using unit::kMm;
using unit::kOne;

constexpr FileUnit kNs{"ns", 1e9, "s"}, kS{"s"}, kUm{"um", 1e6, "m"}, kBytes{"bytes"};

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
constexpr Column<B> kRows[] = {
    {"backend", kOne, "", of<&B::backend>()},
    {"resolution_mm", kMm, "",
     {[](const B& b) { return b.resolution > 0.0 ? b.resolution : B::kNone; },
      [](B& b, double v) { b.resolution = std::isnan(v) ? 0.0 : v; }}, "spacing of the samples; null: as given, or a formula"},
    {"body", kOne, "", access::word(+[](const B& b) { return std::string(body_name(b.body)); })},
    {"agrees", kOne, "", access::flag<&B::agrees>(), "with every oracle; otherwise there are no times"},
    {"reason", kOne, "", of<&B::reason>(), "why it does not agree or could not be built; empty where it agrees"},
    {"difference_um", kUm, "", of<&B::difference>(), "largest normal distance from the surface as given, on the grids that are measured", kInTable, "differs"},
    {"build_s", kS, "", of<&B::build>(), "from the surface as given to this representation", kInTable, "build"},
    {"memory_bytes", kBytes, "", of<&B::memory_bytes>(), "", kInTable, "memory"},
    {"points", kOne, "", of<&B::points>(), "of the grid of heights", kInTable, "points"},
    {"ns_per_height", kNs, "", of<&B::height>(), "plane level with the body", kInTable, "height, level"},
    {"ns_per_height_tilted", kNs, "", of<&B::height_tilted>(), "plane rolled, yawed and pitched by 0.05, 0.03, 0.02 rad", kInTable, "height, tilted"},
    {"ns_per_normal", kNs, "", of<&B::normal>(), "height and both slopes, tilted plane", kInTable, "with slopes"},
    {"base_ns_per_height", kNs, "", of<&B::base_height>(), "offsets: the surface below them, level plane", kInTable, "base of offsets"},
    {"search_cold_s", kS, "", of<&B::search_cold>(), "both bodies in this representation: a first contact search", kInTable, "first search"},
    {"search_warm_s", kS, "", of<&B::search_warm>(), "the same after the wheel moved by a micrometre", kInTable, "after a small move"},
    {"distance_s", kS, "", of<&B::distance>(), "undeformed distance over the potential contact area", kInTable, "distance"},
    {"patches", kOne, "", {[](const B& b) { return b.patches >= 0 ? b.patches : B::kNone; }, nullptr, nullptr, true},
     "found by the search", kInTable, "patches"}};
// clang-format on

}  // namespace

template <>
std::span<const Column<app::BenchRow>> columns() {
  return kRows;
}

namespace app {

void write_bench_folder(const std::filesystem::path& folder, const BenchReport& report) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  write_file(output.path() / "bench.svg", bench_svg(report));
  write_file(output.path() / "bench.csv", bench_csv(report));
  write_file(output.path() / "bench.json", bench_json(report));
  output.move_into("bench.json");
}

std::string bench_csv(const BenchReport& report) { return io::csv_of(report.rows, Digits::six); }

}  // namespace app
}  // namespace treadmark
