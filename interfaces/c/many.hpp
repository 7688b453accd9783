// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/core/report.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/interfaces/c/numbers.hpp"
#include "treadmark/io/results/listed_number.hpp"

namespace treadmark::c {

/// Instants of a pair that do not depend on each other: row i is the case with the i-th number of every array given.
struct ManyRows {
  std::size_t rows = 0;
  std::vector<std::pair<const CaseNumber*, const double*>> given;  ///< SI, an array of rows numbers
  std::vector<std::pair<io::ListedNumber, double*>> wanted;        ///< likewise; NaN where a number is not known
};

/// One row is done: how it ended, and what is to be said of it: why it is not ok, or that its numbers may be wrong. One
/// call at a time, on any thread.
using RowEnd = std::function<void(std::size_t row, Status status, const std::string& message)>;

/// Solves them on all threads. Rows that make no sense end as failed, without numbers. Errors: BadArgument for a case
/// of a patch and an array of wanted that is another one, too, Error(configuration) for a case with a history and for a
/// number that is given twice; Cancelled, after which numbers of rows that are not done are NaN.
void solve_many(const tm_pair& pair, const tm_case& common, const ManyRows& rows, const RowEnd& end,
                const Progress& progress);

// Of cases.cpp and solving.cpp.

/// Sets a number in SI. Errors: Error(configuration) for a value that it cannot have.
void set_number(tm_case& c, const CaseNumber& number, double value);
/// The case of a wheel on a rail, checked once after each change, also against the surfaces of the pair.
const io::WheelRailCase& checked_for(const tm_pair& pair, const tm_case* c);

}  // namespace treadmark::c
