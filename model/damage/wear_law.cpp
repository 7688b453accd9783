// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/damage/wear_law.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

constexpr const char* kNoOwnNumbers = "a law of wear has no numbers of its own: give those of a test";

[[noreturn]] void refuse(std::string message, std::string advice) {
  throw Error(ErrorKind::configuration, std::move(message), {}, std::move(advice));
}

bool needs(const WearTheoryRow& row, std::string_view key) {
  std::istringstream words{std::string(row.keys)};
  return std::find(std::istream_iterator<std::string>(words), {}, key) != std::istream_iterator<std::string>();
}

const std::vector<double>& list_of(const WearLaw& law, std::string_view key) {
  const auto& value = ranges::find(kWearNumbers, key, &WearNumber::key)->value;
  return law.*std::get<std::vector<double> WearLaw::*>(value);
}

void check_number(double value, const WearNumber& n, bool needed) {
  if (needed && (!(value > 0.0) || !std::isfinite(value)))
    refuse(fmt::format("the law needs a positive {}", n.key), kNoOwnNumbers);
  if (!(value > 0.0) && !(n.may_be_zero && value == 0.0))
    refuse(fmt::format("{} must {}", n.key, n.may_be_zero ? "not be negative" : "be positive"), "");
}

void check_regimes(const WearNumber& n, std::size_t regimes, const std::vector<double>& limits) {
  if (limits.size() + 1 != regimes)
    refuse(fmt::format("{} has {} values and {} has {}", n.key, regimes, n.limits, limits.size()),
           "there is one limit less than there are regimes");
  for (std::size_t i = 0; i < limits.size(); ++i)
    if (!(limits[i] > (i > 0 ? limits[i - 1] : 0.0)))
      refuse(fmt::format("{} must be positive and increase", n.limits), "");
}

void check_line(const WearNumber& n, const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2 || x.size() != y.size())
    refuse(fmt::format("{} has {} values and {} has {}", n.over, x.size(), n.key, y.size()),
           "they are the points of a line: as many, and at least two");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1])) refuse(fmt::format("{} must increase from 0 on", n.over), "");
  if (y.back() < y[y.size() - 2])
    refuse(fmt::format("{} falls at the end of the line, which goes on behind it", n.key),
           "let its last piece not fall");
}

void check_list(const WearLaw& law, const std::vector<double>& values, const WearNumber& n) {
  if (values.empty()) refuse(fmt::format("the law needs {}", n.key), kNoOwnNumbers);
  for (const double value : values)
    if (!(value >= 0.0) || !std::isfinite(value)) refuse(fmt::format("{} must not be negative", n.key), "");
  if (!n.limits.empty()) check_regimes(n, values.size(), list_of(law, n.limits));
  if (!n.over.empty()) check_line(n, list_of(law, n.over), values);
}

}  // namespace

void check(const WearLaw& law) {
  const WearTheoryRow& row = kWearTheories[static_cast<std::size_t>(law.theory)];
  for (const WearNumber& n : kWearNumbers)
    if (const auto* value = std::get_if<double WearLaw::*>(&n.value);
        value && (needs(row, n.key) || may_lack(n, *value)))
      check_number(law.**value, n, needs(row, n.key));
  for (const WearNumber& n : kWearNumbers)
    if (const auto* list = std::get_if<std::vector<double> WearLaw::*>(&n.value); list && needs(row, n.key))
      check_list(law, law.**list, n);
}

}  // namespace treadmark
