// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/shape/spline_surface.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace treadmark {
namespace {

using Homogeneous = Eigen::Vector4d;

/// Values and derivatives at t of the functions of one direction that are not zero where `inside` is.
struct Basis {
  std::size_t first = 0;
  std::array<double, kHighestDegree + 1> value, slope;  // degree + 1 of them count

  Basis(const SplineKnots& of, double t, double inside) {
    const std::vector<double>& knots = of.knots;
    const auto p = static_cast<std::size_t>(of.degree);
    const auto begin = knots.begin() + of.degree, end = knots.end() - of.degree - 1;
    t = std::clamp(t, *begin, *end);
    auto after = std::upper_bound(begin, end, inside);
    if (after == begin) after = std::upper_bound(begin, end, *begin);
    if (after == end) after = std::lower_bound(begin, end, *end);  // the last piece that has a length
    const auto k = static_cast<std::size_t>(after - knots.begin()) - 1;
    first = k - p;
    value[0] = 1.0;
    std::array<double, kHighestDegree + 1> lower;
    for (std::size_t r = 1; r <= p; ++r) {
      if (r == p) std::copy_n(value.begin(), p, lower.begin());
      double left = 0.0;
      for (std::size_t j = 0; j < r; ++j) {
        const double high = knots[k + 1 + j], low = knots[k + 1 + j - r], share = value[j] / (high - low);
        value[j] = left + (high - t) * share;
        left = (t - low) * share;
      }
      value[r] = left;
    }
    for (std::size_t j = 0; j <= p; ++j) {
      const auto piece = [&](std::size_t i) { return lower[i] / (knots[k + 1 + i] - knots[k + 1 + i - p]); };
      slope[j] = of.degree * ((j > 0 ? piece(j - 1) : 0.0) - (j < p ? piece(j) : 0.0));
    }
  }
};

}  // namespace

std::vector<double> SplineKnots::breaks() const {
  std::vector<double> out(knots.begin() + degree, knots.end() - degree);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

bool SplineKnots::smooth() const {
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t i = p + 1; i + p + 1 < knots.size(); ++i)
    if (knots[i] > knots[p] && knots[i] < knots[knots.size() - 1 - p] && knots[i] == knots[i + p - 1]) return false;
  return true;
}

std::optional<KnotFault> fault_of(const SplineKnots& of, int highest_degree) {
  const std::vector<double>& knots = of.knots;
  if (of.degree < 1 || of.degree > highest_degree)
    return KnotFault{fmt::format("degree {} is not known: 1 to {} are", of.degree, highest_degree)};
  const auto p = static_cast<std::size_t>(of.degree);
  if (knots.size() < 2 * p + 2)
    return KnotFault{fmt::format("{} knots are too few for degree {}: {} at least", knots.size(), p, 2 * p + 2)};
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) return KnotFault{fmt::format("knot {} is not finite", i + 1), i};
    if (i > 0 && knots[i] < knots[i - 1])
      return KnotFault{fmt::format("knot {} is less than the one before", i + 1), i};
  }
  const double from = knots[p], to = knots[knots.size() - 1 - p];
  if (!(from < to)) return KnotFault{"the knots leave no interval"};
  std::size_t repeated = 1;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    repeated = knots[i] == knots[i - 1] ? repeated + 1 : 1;
    if (repeated > p + (knots[i] > from && knots[i] < to ? 0 : 1))
      return KnotFault{
          fmt::format("knot {} is repeated {} times, more than degree {} allows", i + 1, repeated, of.degree), i};
  }
  return std::nullopt;
}

void check(const SplineSurface& s) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::input_data, fmt::format("{}: {}", s.name, what), s.where,
                "is the file damaged? write it again");
  };
  if (s.levels.empty()) refuse("it has no basis");
  for (const auto& level : s.levels)
    for (const SplineKnots& knots : level)
      if (const auto fault = fault_of(knots, s.hierarchical ? kHighestHierarchicalDegree : kHighestDegree))
        refuse(fault->what);
  for (const Vec3& p : s.points)
    if (!p.allFinite()) refuse("a coefficient is not finite");
  if (s.hierarchical) {
    if (!s.weights.empty()) refuse("hierarchical splines with weights are not known");
    return;
  }
  const std::size_t ns = s.levels.front()[0].functions(), nt = s.levels.front()[1].functions();
  if (s.points.size() != ns * nt)
    refuse(fmt::format("its basis has {} x {} functions, but it has {} coefficients", ns, nt, s.points.size()));
  if (!s.weights.empty() && s.weights.size() != s.points.size())
    refuse(fmt::format("it has {} weights for {} coefficients", s.weights.size(), s.points.size()));
  for (std::size_t k = 0; k < s.weights.size(); ++k)
    if (!(s.weights[k] > 0.0) || !std::isfinite(s.weights[k]))
      refuse(fmt::format("weight {} is {}, not positive", k + 1, s.weights[k]));
}

SplineJet evaluate(const SplineSurface& tensor, const Vec2& at, const Vec2& inside) {
  const auto& [knots_s, knots_t] = tensor.levels.front();
  const Basis bs(knots_s, at.x(), inside.x()), bt(knots_t, at.y(), inside.y());
  const std::size_t stride = knots_s.functions();
  Homogeneous f = Homogeneous::Zero(), fs = f, ft = f, fst = f;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(knots_t.degree); ++j) {
    Homogeneous row = Homogeneous::Zero(), row_s = row;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(knots_s.degree); ++i) {
      const std::size_t k = bs.first + i + stride * (bt.first + j);
      const double w = tensor.weights.empty() ? 1.0 : tensor.weights[k];
      const Homogeneous point(w * tensor.points[k].x(), w * tensor.points[k].y(), w * tensor.points[k].z(), w);
      row += bs.value[i] * point;
      row_s += bs.slope[i] * point;
    }
    f += bt.value[j] * row;
    fs += bt.value[j] * row_s;
    ft += bt.slope[j] * row;
    fst += bt.slope[j] * row_s;
  }
  SplineJet jet;
  const double w = f.w();
  jet.p = f.head<3>() / w;
  jet.ps = (fs.head<3>() - fs.w() * jet.p) / w;
  jet.pt = (ft.head<3>() - ft.w() * jet.p) / w;
  jet.pst = (fst.head<3>() - fs.w() * jet.pt - ft.w() * jet.ps - fst.w() * jet.p) / w;
  return jet;
}

SplineJet evaluate(const SplineSurface& tensor, double s, double t) { return evaluate(tensor, {s, t}, {s, t}); }

}  // namespace treadmark
