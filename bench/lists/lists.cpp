// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::bench {
namespace {

/// Files of wheel profiles, S1002 with treads worn each by another depth, points every 0.2 mm.
class Fleet {
 public:
  /// The first one is new.
  std::vector<std::string> files(std::size_t count) {
    const Profile points = analytic::sample_profile(StandardProfile{"S1002"}, 0.2e-3);
    for (std::size_t k = made_.size(); k < count; ++k) {
      const double depth = 1e-6 * static_cast<double>(k);
      std::string text;
      for (std::size_t i = 0; i < points.y.size(); ++i) {
        const double worn = depth * std::exp(-std::pow(points.y[i] / 20e-3, 2));
        text += fmt::format("{:.5f} {:.5f}\n", 1e3 * points.y[i], 1e3 * (points.z[i] - worn));
      }
      made_.push_back((folder_.path() / fmt::format("wheel{:04}.txt", k)).string());
      write_file(made_.back(), text);
    }
    return {made_.begin(), made_.begin() + static_cast<std::ptrdiff_t>(count)};
  }

 private:
  const OutputFolder folder_{std::filesystem::temp_directory_path(), OutputFolder::Old::kept};
  std::vector<std::string> made_;
};

Fleet& fleet() {
  static Fleet kept;
  return kept;
}

std::size_t column_of(const app::ResultList& list, const std::string& name) {
  std::size_t k = 0;
  while (list.numbers.at(k).name != name) ++k;
  return k;
}

/// Reading, contact geometry and conicity at 61 amplitudes of pairs with a wheel each.
void pairs(benchmark::State& state) {
  const ThreadLimit threads(static_cast<int>(state.range(1)));
  app::GeometryRequest usual;
  usual.rail = "60E1", usual.gauge = 1.435, usual.cant = std::atan(1.0 / 40.0);
  for (int i = 0; i <= 60; ++i) usual.settings.amplitudes.push_back(1e-3 + 1e-4 * i);
  std::vector<app::GeometryRequest> requests;
  for (const std::string& file : fleet().files(static_cast<std::size_t>(state.range(0)))) {
    requests.push_back(usual);
    requests.back().label = requests.back().wheel = file;
  }
  app::ResultList list;
  for (auto _ : state) list = app::run_pairs(requests);
  // S1002 on 60E1 at 1:40 and 1435 mm: docs/geometry.md
  const double known = list.rows.front().numbers.at(column_of(list, "tan_gamma_e_3mm"));
  if (list.failed() > 0 || !(std::fabs(known - 0.174) < 0.003)) refuse(state, "the conicity of the new pair is wrong");
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(pairs)->ArgNames({"", "threads"})->Args({20, 2})->Args({1000, 1})->Args({1000, 2})->UseRealTime();

/// Reading and measuring wheels against their nominal section.
void wheels(benchmark::State& state) {
  const ThreadLimit threads(static_cast<int>(state.range(1)));
  const auto files = fleet().files(static_cast<std::size_t>(state.range(0)));
  app::MeasureRequest request;
  request.nominal = "S1002";
  app::ResultList list;
  for (auto _ : state) list = app::measure_files(files, request);
  const auto known = [&](const char* name) { return list.rows.front().numbers.at(column_of(list, name)); };
  if (list.failed() > 0 || !(std::fabs(known("flange_height_mm") - 28.0) < 1e-3) ||
      !(std::fabs(known("flange_thickness_mm") - 32.5) < 1e-3))
    refuse(state, "the measures of the new wheel are wrong");
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(wheels)->ArgNames({"", "threads"})->Args({20, 2})->Args({1000, 1})->Args({1000, 2})->UseRealTime();

}  // namespace
}  // namespace treadmark::bench
