// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/histories/history_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <set>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/tables/csv_of.hpp"

namespace treadmark::io {

namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorKind::configuration, message); }

template <class Named>
void check_names(const std::vector<Named>& list, const char* kind) {
  std::set<std::string> seen;
  for (const Named& one : list) {
    if (one.name.empty() || one.name == "." || one.name.find('/') != std::string::npos ||
        one.name.find('\0') != std::string::npos)
      refuse(fmt::format("\"{}\" cannot be the name of a {}", one.name, kind));
    if (!seen.insert(one.name).second) refuse(fmt::format("two {}s have the name {}", kind, one.name));
  }
}

}  // namespace

void check_simulation(const SimulationResult& result) {
  check_names(result.columns, "column");
  check_names(result.summary, "value of the summary");
  check_names(result.statics, "static value");
  const std::size_t width = result.columns.size();
  if (width == 0 ? !result.values.empty() : result.values.size() % width != 0)
    refuse(fmt::format("{} values are no whole rows of {} columns", result.values.size(), width));
  if (!result.snapshot_times.empty() && result.snapshot_times.size() != result.snapshots.cases.size())
    refuse(fmt::format("{} times for {} snapshots", result.snapshot_times.size(), result.snapshots.cases.size()));
  if (!result.snapshot_scenes.empty() && result.snapshot_scenes.size() != result.snapshots.cases.size())
    refuse(fmt::format("{} scenes for {} snapshots", result.snapshot_scenes.size(), result.snapshots.cases.size()));
  std::set<int> numbers;
  for (const CaseResult& one : result.snapshots.cases)
    if (!numbers.insert(one.number).second) refuse(fmt::format("two snapshots have the number {}", one.number));
  constexpr const char* kStatus[] = {"complete", "derailed", "interrupted", "failed"};
  if (ranges::find(kStatus, result.status) == std::end(kStatus))
    refuse(fmt::format("\"{}\" is no status of a simulation: {}", result.status, fmt::join(kStatus, ", ")));
}

std::size_t column_index(const SimulationResult& result, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < result.columns.size(); ++i) {
    if (result.columns[i].name == name) return i;
    names += (i == 0 ? "" : ", ") + result.columns[i].name;
  }
  throw Error(ErrorKind::configuration, fmt::format("the history has no column \"{}\"", name), {},
              names.empty() ? "it has none at all" : "its columns: " + names);
}

std::vector<double> column_values(const SimulationResult& result, std::size_t index) {
  std::vector<double> out;
  out.reserve(result.rows());
  for (std::size_t i = index; i < result.values.size(); i += result.columns.size()) out.push_back(result.values[i]);
  return out;
}

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
  write_file(path, out);
}

void write_events_csv(const std::filesystem::path& path, const SimulationResult& result) {
  write_file(path, csv_of(result.events, Digits::all));
}

void write_modes_csv(const std::filesystem::path& path, const SimulationResult& result) {
  write_file(path, csv_of(result.modes, Digits::all));
}

}  // namespace treadmark::io

namespace treadmark {
namespace {

using access::of;
using Event = io::HistoryEvent;
using Mode = io::ModeRow;

// A row of a table stays a row: clang-format would give each column a line.
// clang-format off
constexpr Column<Event> kEvents[] = {
    {"t_s", {"s"}, "time", of<&Event::time>(), "instant", 0, "t"},
    {"x_m", unit::kM, "position", of<&Event::position>(), "along the track", 0, "x"},
    {"wheel", unit::kOne, "wheel", of<&Event::wheel>(), "name of the wheel", 0, "wheel"},
    {"kind", unit::kOne, "kind", of<&Event::kind>(), "what happened", 0, "event"}};

constexpr Column<Mode> kModes[] = {
    {"frequency_Hz", {"Hz"}, "frequency", of<&Mode::frequency_Hz>(), "of the mode", 0, "frequency"},
    {"damping_ratio", unit::kOne, "damping_ratio", of<&Mode::damping_ratio>(), "over critical damping", 0, "damping ratio"},
    {"shape", unit::kOne, "shape", of<&Mode::shape>(), "what moves", 0, "shape"}};

}  // namespace

template <> std::span<const Column<Event>> columns() { return kEvents; }
template <> std::span<const Column<Mode>> columns() { return kModes; }
// clang-format on

}  // namespace treadmark
