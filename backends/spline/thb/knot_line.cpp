// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/thb/knot_line.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"

namespace treadmark::spline {
namespace {

[[noreturn]] void refuse_knots(std::string what) { throw Error(ErrorKind::input_data, std::move(what)); }

void check_degree(int degree) {
  if (degree < 1 || degree > kMostDegree)
    refuse_knots(fmt::format("splines of degree {} are not known: 1, 2 and 3 are", degree));
}

void check_increase(std::span<const double> breaks, std::size_t least) {
  if (breaks.size() < least) refuse_knots(fmt::format("a spline needs at least {} intervals", least - 1));
  for (std::size_t i = 0; i < breaks.size(); ++i)
    if (!std::isfinite(breaks[i]) || (i > 0 && breaks[i] <= breaks[i - 1]))
      refuse_knots(fmt::format("break {} of a spline is not greater than the one before", i + 1));
}

}  // namespace

KnotWeights bernstein_blossom(int degree, const double* arguments, double low, double high) {
  KnotWeights w{1.0};
  for (int r = 0; r < degree; ++r) {
    const double share = (arguments[r] - low) / (high - low);
    for (auto m = static_cast<std::size_t>(r) + 1; m > 0; --m) w[m] = (1.0 - share) * w[m] + share * w[m - 1];
    w[0] *= 1.0 - share;
  }
  return w;
}

KnotLine KnotLine::open(int degree, std::span<const double> breaks) {
  check_degree(degree);
  check_increase(breaks, 2);
  std::vector<double> knots(static_cast<std::size_t>(degree), breaks.front());
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), static_cast<std::size_t>(degree), breaks.back());
  return KnotLine(degree, std::move(knots), false);
}

KnotLine KnotLine::periodic(int degree, std::span<const double> breaks) {
  check_degree(degree);
  check_increase(breaks, static_cast<std::size_t>(degree) + 2);
  const double period = breaks.back() - breaks.front();
  const auto n = breaks.size() - 1, p = static_cast<std::size_t>(degree);
  std::vector<double> knots;
  for (std::size_t i = n - p; i < n; ++i) knots.push_back(breaks[i] - period);
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  for (std::size_t i = 1; i <= p; ++i) knots.push_back(breaks[i] + period);
  return KnotLine(degree, std::move(knots), true);
}

KnotLine KnotLine::of_knots(SplineKnots of) {
  if (auto fault = fault_of(of, kMostDegree)) refuse_knots(std::move(fault->what));
  return KnotLine(of.degree, std::move(of.knots), false);
}

KnotLine::KnotLine(int degree, std::vector<double> knots, bool closed)
    : degree_(degree), closed_(closed), knots_(std::move(knots)) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t all = knots_.size() - p - 1;
  for (std::size_t i = p; i < all; ++i) {
    if (knots_[i] == knots_[i + 1]) continue;
    breaks_.push_back(knots_[i]);
    span_.push_back(static_cast<int>(i));
  }
  breaks_.push_back(knots_[all]);
  functions_ = static_cast<int>(closed_ ? all - p : all);
  support_.assign(static_cast<std::size_t>(functions_), {-1, -1});
  for (int i = 0; i < (closed_ ? 2 : 1) * intervals(); ++i)
    for (int k = 0; k <= degree_; ++k) {
      // of a closed line the second round completes what began in the first
      const int unfolded = span_[static_cast<std::size_t>(i % intervals())] - degree_ + k;
      const bool begins = !closed_ || k == degree_;
      Support& s = support_[static_cast<std::size_t>(unfolded % functions_)];
      if (s.first < 0 && begins) s.first = i;
      if (s.first >= 0 && i <= s.first + (closed_ ? degree_ : intervals())) s.last = i;
    }
}

int KnotLine::find(double x) const { return static_cast<int>(piece_at(breaks_, x)); }

int KnotLine::function(int interval, int k) const {
  const int unfolded = span_[static_cast<std::size_t>(interval)] - degree_ + k;
  return unfolded >= functions_ ? unfolded - functions_ : unfolded;
}

KnotWeights KnotLine::blossom(int interval, const double* arguments) const {
  const auto span = static_cast<std::size_t>(span_[static_cast<std::size_t>(interval)]);
  const auto p = static_cast<std::size_t>(degree_);
  // de Boor's triangle for unit vectors, an argument a step
  std::array<KnotWeights, kMostDegree + 1> d{};
  for (std::size_t k = 0; k <= p; ++k) d[k][k] = 1.0;
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t k = p; k >= r; --k) {
      const std::size_t i = span - p + k;
      const double low = knots_[i], high = knots_[i + p - r + 1], share = (arguments[r - 1] - low) / (high - low);
      for (std::size_t m = 0; m <= p; ++m) d[k][m] = (1.0 - share) * d[k - 1][m] + share * d[k][m];
    }
  return d[p];
}

KnotWeights KnotLine::bernstein(int interval, int k) const {
  double arguments[kMostDegree];
  for (int i = 0; i < degree_; ++i) arguments[i] = i < degree_ - k ? from(interval) : to(interval);
  return blossom(interval, arguments);
}

const double* KnotLine::inner_knots(int interval, int k) const {
  return knots_.data() + span_[static_cast<std::size_t>(interval)] - degree_ + k + 1;
}

bool KnotLine::holds(const KnotLine& other) const {
  if (degree_ != other.degree_ || closed_ != other.closed_ || breaks_.front() != other.breaks_.front() ||
      breaks_.back() != other.breaks_.back())
    return false;
  return std::includes(knots_.begin() + degree_, knots_.end() - degree_, other.knots_.begin() + degree_,
                       other.knots_.end() - degree_);
}

}  // namespace treadmark::spline
