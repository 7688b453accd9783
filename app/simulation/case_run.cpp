// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/case_run.hpp"

#include <algorithm>
#include <functional>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/simulation/result_head.hpp"

namespace treadmark::app {
namespace {

struct CaseColumn {
  io::HistoryColumn head;
  std::function<double(const io::CaseResult&)> value;
};

double sum(const io::CaseResult& c, double io::PatchResult::*member) {
  double total = 0.0;
  for (const io::PatchResult& patch : c.patches) total += patch.*member;
  return total;
}
double most(const io::CaseResult& c, double io::PatchResult::*member) {
  double largest = 0.0;
  for (const io::PatchResult& patch : c.patches) largest = std::max(largest, patch.*member);
  return largest;
}

std::vector<CaseColumn> case_columns() {
  using C = const io::CaseResult&;
  return {{{"case", "1", "number of the case"}, [](C c) { return static_cast<double>(c.number); }},
          {{"Q_N", "N", "vertical force on the rail"},
           [](C c) { return c.has_wheelset ? c.force_tr.z() : sum(c, &io::PatchResult::fn); }},
          {{"Fn_N", "N", "normal force"}, [](C c) { return sum(c, &io::PatchResult::fn); }},
          {{"Tx_N", "N", "longitudinal creep force on the rail"}, [](C c) { return sum(c, &io::PatchResult::fx); }},
          {{"Ty_N", "N", "lateral creep force on the rail"}, [](C c) { return sum(c, &io::PatchResult::fs); }},
          {{"pmax_Pa", "Pa", "largest contact pressure"}, [](C c) { return most(c, &io::PatchResult::pmax); }},
          {{"approach_m", "m", "largest approach of a patch"}, [](C c) { return most(c, &io::PatchResult::approach); }},
          {{"friction_W", "W", "power dissipated by friction"},
           [](C c) { return 0.0 - sum(c, &io::PatchResult::frictional_power); }},
          {{"patches", "1", "contact patches"}, [](C c) { return static_cast<double>(c.patches.size()); }}};
}

/// What the largest of a column is called in the summary: as in that of a simulation, where it has it too.
std::string largest_name(const std::string& column) {
  if (column == "Q_N") return "q_max_N";
  if (column == "pmax_Pa") return column;
  const std::string::size_type unit = column.rfind('_');
  return unit == std::string::npos ? column + "_max" : column.substr(0, unit) + "_max" + column.substr(unit);
}

}  // namespace

RunNames case_run_names() {
  RunNames names;
  for (const CaseColumn& column : case_columns()) {
    if (!names.columns.empty()) names.summary.push_back(largest_name(column.head.name));  // not of the case's number
    names.columns.push_back(column.head.name);
  }
  return names;
}

io::SimulationResult run_case_file(const io::CaseFile& file, SurfaceStore& store, const SimulationOptions& options,
                                   const Progress& progress) {
  io::RunResult run = run_cases(without_error_bars(file), store, progress);
  io::SimulationResult result = result_head(file, options);
  if (!run.complete) result.status = "interrupted";
  const std::vector<CaseColumn> columns = case_columns();
  for (const CaseColumn& column : columns) result.columns.push_back(column.head);
  for (const io::CaseResult& c : run.cases) {
    for (const CaseColumn& column : columns) result.values.push_back(column.value(c));
    if (c.status == Status::failed && result.status == "complete") {
      result.status = "failed";
      result.message = "case " + std::to_string(c.number) + ": " + c.message;
    }
  }
  for (std::size_t i = 1; i < columns.size() && !run.cases.empty(); ++i) {
    double largest = columns[i].value(run.cases.front());
    for (const io::CaseResult& c : run.cases) largest = std::max(largest, columns[i].value(c));
    result.summary.push_back({largest_name(columns[i].head.name), largest, columns[i].head.unit,
                              "largest of all cases: " + columns[i].head.description});
  }
  // Times of this computer are not results.
  for (io::CaseResult& c : run.cases) c.seconds = c.search_s = c.distance_s = c.normal_s = c.tangential_s = 0.0;
  result.snapshots = std::move(run);
  return result;
}

}  // namespace treadmark::app
