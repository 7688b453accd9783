// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/io/histories/sample_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "treadmark/tests/io/results/sample_run.hpp"

namespace treadmark::testing {

io::SimulationResult sample_simulation(double speed, std::size_t rows) {
  constexpr double kStatic = 62e3, kImpact = 0.05;
  io::SimulationResult result;
  result.version = "0.1.0";
  result.git = "abc";
  result.input_file = "flat \"one\".toml";
  result.input_sha256 = "e3b0c442";
  result.geometry_sha256 = {{"wheel.prw", "11"}, {"rail.prr", "22"}};
  result.inputs = {{"track: gauge", "1435 mm"}, {"track: cant", "1:40"}};
  result.settings = {"vehicle.speed=40", "grid.dx=0.5"};
  result.title = "flat <wheel> & rail, µ";
  result.status = "interrupted";
  result.message = "stopped by the user";
  result.columns = {{"t_s", "s", "time"},
                    {"x_m", "m", "along the track"},
                    {"ws1_right.Q_N", "N", "vertical force"},
                    {"ws1_right.Ty_N", "N", "lateral creep force"}};
  double largest = 0.0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 0.2 * static_cast<double>(i) / static_cast<double>(rows - 1), after = t - kImpact;
    double q = kStatic;
    if (after < 0.0) q *= std::clamp(after < -0.01 ? 1.0 : -(after + 0.005) / 0.005, 0.0, 1.0);
    if (after >= 0.0)
      q *= 1.0 + std::exp(-60.0 * after) * (0.2 + 0.04 * speed) * std::sin(2e3 * after) +
           0.4 * std::exp(-25.0 * after) * std::cos(250.0 * after);
    largest = std::max(largest, q);
    result.values.insert(result.values.end(), {t, speed * t, q, -0.08 * q * (1.0 - std::exp(-(t + 0.01) * 30.0))});
  }
  result.events = {{0.045, 0.045 * speed, "ws1_right", "contact lost"},
                   {kImpact, kImpact * speed, "ws1_right", "contact regained"}};
  result.summary = {{"q_max_N", largest, "N", "largest vertical force"},
                    {"q_min_N", 0.0, "N", "smallest vertical force"}};
  result.statics = {{"ws1_right.Q_N", kStatic, "N", "static load"}};
  result.modes = {{1.2, 0.15, "bounce of the body"}, {45.0, 0.08, "wheelset, \"vertical\""}};
  result.snapshots = sample_run();
  for (std::size_t i = 0; i < result.snapshots.cases.size(); ++i) {
    result.snapshots.cases[i].seconds = 0.25;  // wall-clock: not to be stored
    result.snapshot_times.push_back(0.01 * static_cast<double>(i));
  }
  result.swept = {{"vehicle.speed", fmt::format("{}", speed)}};
  for (int i = 0; i < 1000; ++i) result.checkpoint.push_back(static_cast<std::byte>(i * 37 % 256));
  return result;
}

std::vector<std::string> read_lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

}  // namespace treadmark::testing
