// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/estimates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/roots.hpp"

namespace treadmark::measures {
namespace {

constexpr std::size_t kFewest = 3, kFewestOfLine = 5;
constexpr double kConfidence = 0.99;

double factor_of(const std::string& quantity) {
  if (quantity.ends_with("_qst")) return 0.0;
  const bool safety = quantity == "sumY_2m" || quantity == "YQ_2m" || quantity == "ay_safety";
  return safety ? 3.0 : 2.2;
}

/// Probability that |t| is below a value (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4).
double within(double t, int freedoms) {
  const double angle = std::atan(t / std::sqrt(freedoms)), cosine = std::cos(angle);
  const bool odd = freedoms % 2 == 1;
  double term = odd ? cosine : 1.0, sum = 0.0;
  for (int k = odd ? 3 : 2; k <= freedoms; k += 2) {
    sum += term;
    term *= cosine * cosine * (k - 1) / k;
  }
  return odd ? 2.0 / kPi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
}

/// The straight line by cant deficiency and where a further section lies below it.
void add_line(std::span<const SectionValue* const> values, Estimate& out) {
  double mean_x = 0.0, mean_y = 0.0;
  std::size_t n = 0;
  for (const SectionValue* v : values)
    if (std::isfinite(v->cant_deficiency)) mean_x += v->cant_deficiency, mean_y += v->assessed.value, ++n;
  if (n < kFewestOfLine) return;
  const auto count = static_cast<double>(n);
  mean_x /= count, mean_y /= count;
  double xx = 0.0, xy = 0.0, yy = 0.0, most = -kInfinity;
  for (const SectionValue* v : values) {
    if (!std::isfinite(v->cant_deficiency)) continue;
    const double x = v->cant_deficiency - mean_x, y = v->assessed.value - mean_y;
    xx += x * x, xy += x * y, yy += y * y;
    most = std::max(most, v->cant_deficiency);
  }
  constexpr double kSame = 1e-3;  // [m]
  if (!(std::sqrt(xx / count) > kSame)) return;
  out.slope = xy / xx;
  out.reference = most;
  const double scatter = std::sqrt(std::max(0.0, yy - out.slope * xy) / (count - 2.0)), ahead = most - mean_x;
  out.bound = mean_y + out.slope * ahead +
              student_quantile(kConfidence, static_cast<int>(n) - 2) * scatter *
                  std::sqrt(1.0 + 1.0 / count + ahead * ahead / xx);
}

}  // namespace

double student_quantile(double share, int freedoms) {
  constexpr double kFar = 1e6;
  return bisect(0.0, kFar, [&](double t) { return 0.5 * (1.0 + within(t, freedoms)) < share; }).middle();
}

std::vector<Estimate> estimates_of(std::span<const SectionValue> values) {
  std::map<std::tuple<std::string, SectionKind, std::string>, std::vector<const SectionValue*>> groups;
  for (const SectionValue& v : values)
    if (v.assessed.status == AssessedStatus::ok && std::isfinite(v.assessed.value))
      groups[{v.assessed.quantity, v.kind, v.assessed.place}].push_back(&v);
  std::vector<Estimate> all;
  all.reserve(groups.size());
  for (const auto& [key, group] : groups) {
    if (group.size() < kFewest) continue;
    Estimate e;
    e.quantity = std::get<0>(key), e.kind = std::get<1>(key), e.place = std::get<2>(key);
    e.sections = group.size();
    const auto count = static_cast<double>(group.size());
    e.mean = 0.0;
    for (const SectionValue* v : group) e.mean += v->assessed.value / count;
    double squares = 0.0;
    for (const SectionValue* v : group) {
      squares += (v->assessed.value - e.mean) * (v->assessed.value - e.mean);
      const double limit = v->assessed.limit;
      if (std::isfinite(limit) && !(e.limit <= limit)) e.limit = limit;
    }
    e.deviation = std::sqrt(squares / (count - 1.0));
    e.factor = factor_of(e.quantity);
    e.largest = e.mean + e.factor * e.deviation;
    add_line(group, e);
    all.push_back(std::move(e));
  }
  return all;
}

}  // namespace treadmark::measures
