// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "treadmark/report/page.hpp"

namespace treadmark::report {

/// A number of each row; NaN where it has none.
using RowValue = std::function<double(std::size_t row)>;

/// At most `most` of `count` rows, in order: first and last one, the least and greatest of every watched number in
/// equal stretches, as many `wanted` ones (ascending) as half of them, and others at equal distances. All where they
/// are few. Thread-safe.
std::vector<std::size_t> spread_rows(std::size_t count, std::size_t most, const std::vector<RowValue>& watched,
                                     const std::vector<std::size_t>& wanted = {});

/// The page with no more steps than a browser opens in two seconds, and a banner that says which are there: those that
/// the timeline names as notable, least and greatest values of its curves, and others at equal distances. Charts,
/// tables and contact keep these steps only. Tables without steps keep rows at equal distances. Thread-safe.
Page with_shown_steps(Page page);

}  // namespace treadmark::report
