// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/c/many.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/interfaces/c/calls.hpp"

namespace treadmark::c {
namespace {

tm_case row_case(const tm_case& common, const ManyRows& rows, std::size_t i) {
  tm_case own{std::make_shared<io::Case>(*common.content), common.folder, common.checked};
  for (const auto& [number, values] : rows.given) set_number(own, *number, values[i]);
  return own;
}

}  // namespace

void solve_many(const tm_pair& pair, const tm_case& common, const ManyRows& rows, const RowEnd& end,
                const Progress& progress) {
  const auto* shared = std::get_if<io::WheelRailCase>(&common.content->content);
  require(shared != nullptr, "the case is one of a patch");
  if (shared->history != HistoryUse::start)
    throw Error(ErrorKind::configuration, "many instants do not follow each other in time", {},
                "leave case.history out, or solve them one after the other");
  std::set<const CaseNumber*> numbers;
  std::set<const double*> arrays;
  for (const auto& [number, values] : rows.given) {
    if (!numbers.insert(number).second)
      throw Error(ErrorKind::configuration, fmt::format("two arrays give {}", number->name), {}, "leave one out");
    arrays.insert(values);
  }
  for (const auto& [number, values] : rows.wanted)
    require(rows.rows == 0 || arrays.insert(values).second, "an array of out stands for another one, too");
  for (const auto& [number, values] : rows.wanted)
    std::fill_n(values, rows.rows, std::numeric_limits<double>::quiet_NaN());
  std::mutex ending;
  const auto problem = [&](std::size_t i) {
    const tm_case own = row_case(common, rows, i);
    return app::to_problem(checked_for(pair, &own), pair.geometry.round_wheel);
  };
  const auto take = [&](std::size_t i, wheelrail::PairSolution&& solution) {
    Status ended = solution.status;
    std::string said = with_grave(solution.message, solution.remarks);
    try {
      if (!solution.refused) {
        const tm_case own = row_case(common, rows, i);
        const io::CaseResult result = app::to_result(std::get<io::WheelRailCase>(own.content->content), solution);
        for (const auto& [number, values] : rows.wanted) values[i] = number.si(result);
      }
    } catch (const Error& error) {  // solved, but for what was asked of it, as stresses below the surface
      ended = Status::failed;
      said = error.what();
    }
    const std::lock_guard lock(ending);
    end(i, ended, said);
  };
  pair.pair.solve_many(rows.rows, problem, take, progress);
}

}  // namespace treadmark::c

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_pair_solve_many(const tm_pair* p, const tm_case* c, size_t rows, const char* const* in_names,
                             const double* const* in, size_t n_in, const char* const* out_names, double* const* out,
                             size_t n_out, tm_status* status, tm_row_message told, void* user) {
  return guarded([&] {
    require(p != nullptr && c != nullptr, "pair and case must not be null");
    ManyRows many{rows, {}, {}};
    const std::vector<std::string> given = texts_of(in_names, n_in, "in_names must be n_in texts"),
                                   wanted = texts_of(out_names, n_out, "out_names must be n_out texts");
    require((in != nullptr || n_in == 0) && (out != nullptr || n_out == 0), "in and out must not be null");
    for (std::size_t k = 0; k < n_in; ++k) {
      const int id = case_number_named(given[k]);
      require(id >= 0, "no number of cases has this name (tm_list names them)");
      require(in[k] != nullptr || rows == 0, "an array of in is null");
      many.given.emplace_back(&case_numbers()[static_cast<std::size_t>(id)], in[k]);
    }
    for (std::size_t k = 0; k < n_out; ++k) {
      require(out[k] != nullptr || rows == 0, "an array of out is null");
      many.wanted.emplace_back(io::listed_number(wanted[k], io::Names::si), out[k]);
    }
    if (status != nullptr) std::fill_n(status, rows, TM_CANCELLED);
    solve_many(
        *p, *c, many,
        [&](std::size_t row, Status end, const std::string& message) {
          if (status != nullptr) status[row] = status_of(end);
          if (told != nullptr && !message.empty()) told(user, row, status_of(end), message.c_str());
        },
        callers_progress());
  });
}

}  // extern "C"
