// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/instant_cases.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/simulation/history_record.hpp"
#include "treadmark/app/simulation/snapshots.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::app {
namespace {

/// Row of the history nearest to a time.
std::size_t row_at(const std::vector<double>& times, double time, const SourcePosition& where) {
  if (times.empty()) throw Error(ErrorKind::configuration, "the history is empty", where);
  constexpr double kRounded = 1e-6;  // of the whole: times are copied from tables
  const double slack = kRounded * std::max(times.back(), 1e-3);
  if (time < times.front() - slack || time > times.back() + slack)
    throw Error(ErrorKind::configuration,
                fmt::format("t = {} s lies outside the history, {} to {} s", time, times.front(), times.back()), where);
  const auto nearest = ranges::min_element(times, {}, [time](double one) { return std::abs(one - time); });
  return static_cast<std::size_t>(nearest - times.begin());
}

}  // namespace

io::CaseFile cases_at(const io::SimulationFile& file, const io::SimulationResult& history, double time) {
  const SourcePosition where{file.path.string()};
  if (file.contact.regime == Regime::transient)
    throw Error(ErrorKind::configuration,
                "in transient rolling an instant goes on from the tractions of the one before, which no case holds",
                where, "--set case.regime=steady writes the same motion in steady rolling, which gives other forces");
  const std::vector<double> times = io::column_values(history, io::column_index(history, "t_s"));
  const std::size_t row = row_at(times, time, where);
  io::CaseFile out;
  out.path = file.path;
  out.title = fmt::format("{}, t = {:.9g} s", file.title, times[row]);
  for (std::size_t wheel = 0; wheel < file.wheels.size(); ++wheel) {
    if (file.wheels[wheel].model == io::ContactModelInput::table) continue;
    vehicle::PairMotion motion;
    motion.time = times[row];
    for (const MotionColumn& column : motion_columns())
      column.place(motion) = history.values.at(row * history.columns.size() +
                                               io::column_index(history, column_prefix(file, wheel) + column.name));
    io::Case one;
    one.number = static_cast<int>(out.cases.size()) + 1;
    one.sequence = one.number - 1;
    one.where = where;
    io::WheelRailCase input = input_of(file, wheel, motion);
    input.wheel = wheel_source(file, file.wheels[wheel]);
    input.history = HistoryUse::start;
    input.longitudinal_force.reset();
    input.rail_springs.reset();
    one.content = std::move(input);
    out.cases.push_back(std::move(one));
  }
  if (out.cases.empty())
    throw Error(ErrorKind::configuration, "no wheel of this simulation has contact = \"full\"", where);
  return out;
}

}  // namespace treadmark::app
