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
           [](C c) { return -sum(c, &io::PatchResult::frictional_power); }},
          {{"patches", "1", "contact patches"}, [](C c) { return static_cast<double>(c.patches.size()); }}};
}

}  // namespace

io::SimulationResult run_case_file(const io::CaseFile& file, SurfaceStore& store, const SimulationOptions& options,
                                   const Progress& progress) {
  io::RunResult run = run_cases(file, store, progress);
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
    const std::string& name = columns[i].head.name;
    const std::string::size_type unit = name.rfind('_');
    const std::string summary =
        unit == std::string::npos ? name + "_max" : name.substr(0, unit) + "_max" + name.substr(unit);
    result.summary.push_back({summary == "Q_max_N"       ? "q_max_N"
                              : summary == "pmax_max_Pa" ? "pmax_Pa"
                                                         : summary,
                              largest, columns[i].head.unit, "largest of all cases: " + columns[i].head.description});
  }
  // Times of this computer are not results.
  for (io::CaseResult& c : run.cases) c.seconds = c.search_s = c.distance_s = c.normal_s = c.tangential_s = 0.0;
  result.snapshots = std::move(run);
  return result;
}

}  // namespace treadmark::app
