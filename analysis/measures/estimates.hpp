// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/analysis/measures/running.hpp"

namespace treadmark::measures {

/// One assessed quantity in one section of any run.
struct SectionValue {
  Assessed assessed;
  SectionKind kind = SectionKind::straight;
  double cant_deficiency = kUnknown;  ///< mean of the section [m]; NaN: not known
};

/// What the values of many sections of a kind say about the largest one, as EN 14363 evaluates test sections by
/// statistics. Factors and confidence are those that the literature quotes, not verified against its text.
struct Estimate {
  std::string quantity, place;
  SectionKind kind = SectionKind::straight;
  std::size_t sections = 0;  ///< with a value
  double mean = kUnknown, deviation = kUnknown;
  double factor = kUnknown;   ///< k: 3 where safety is at stake, 0 of quasi-static quantities, else 2.2
  double largest = kUnknown;  ///< mean + k deviation
  double limit = kUnknown;    ///< least of the sections'; NaN: none
  /// Of the straight line by cant deficiency, where at least five sections differ in it.
  double slope = kUnknown;      ///< by cant deficiency [1/m]
  double reference = kUnknown;  ///< cant deficiency for which the bound holds: the largest one of the sections [m]
  double bound = kUnknown;      ///< below which a further section lies there with 99 %
  double share() const { return largest / limit; }
};

/// By quantity, kind and place; those of three sections at least. Values that are not ok are passed over.
std::vector<Estimate> estimates_of(std::span<const SectionValue> values);

/// What lies below this share (0.5 to 1) of Student's distribution with so many degrees of freedom (> 0).
double student_quantile(double share, int freedoms);

}  // namespace treadmark::measures
