// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/backends/spline/bspline_basis.hpp"
#include "treadmark/backends/spline/fit_profile.hpp"

namespace treadmark::spline {
namespace {

// Interior knots of one section between corners (points first .. last).
void add_section_knots(const ProfileData& data, int first, int last, double lambda, double spacing,
                       std::vector<double>& knots) {
  const auto position = [&data](int i) { return data.s[static_cast<std::size_t>(i)]; };
  const double begin = position(first), length = position(last) - begin;
  if (last - first < 2) return;
  if (lambda >= kTinyBsplinePenalty) {
    const int intervals = std::max(1, static_cast<int>(std::lround(length / spacing)));
    for (int i = 1; i < intervals; ++i) knots.push_back(begin + length * i / intervals);
    return;
  }
  // Without much of a penalty every coefficient needs data of its own (Schoenberg and Whitney 1953).
  const double least = std::pow(20.0 * lambda * 1e-6, 1.0 / 6.0);
  double previous = begin;
  for (int i = first + 2; i <= last - 2; ++i)
    if (position(i) - previous >= least) knots.push_back(previous = position(i));
}

std::vector<double> knot_sequence(const ProfileData& data, double lambda, double spacing) {
  std::vector<double> knots(4, data.s.front());
  for (std::size_t k = 0; k + 1 < data.kinks.size(); ++k) {
    add_section_knots(data, data.kinks[k], data.kinks[k + 1], lambda, spacing, knots);
    const bool at_end = k + 2 == data.kinks.size();
    knots.insert(knots.end(), at_end ? 4 : 3, data.s[static_cast<std::size_t>(data.kinks[k + 1])]);
  }
  return knots;
}

struct Observation {
  double s, y, z, weight;
};

// A section of two points only gets two more on its chord, which makes it straight.
std::vector<Observation> observations(const ProfileData& data) {
  std::vector<Observation> all;
  for (std::size_t i = 0; i < data.s.size(); ++i) all.push_back({data.s[i], data.y[i], data.z[i], data.weights[i]});
  for (std::size_t k = 0; k + 1 < data.kinks.size(); ++k) {
    if (data.kinks[k + 1] - data.kinks[k] != 1) continue;
    const Observation a = all[static_cast<std::size_t>(data.kinks[k])],
                      b = all[static_cast<std::size_t>(data.kinks[k]) + 1];
    for (const double f : {1.0 / 3.0, 2.0 / 3.0})
      all.push_back({a.s + f * (b.s - a.s), a.y + f * (b.y - a.y), a.z + f * (b.z - a.z), 0.5 * (a.weight + b.weight)});
  }
  return all;
}

}  // namespace

ProfileSpline fit_bspline_smoothing(const ProfileData& data, double lambda, double knot_spacing) {
  const std::vector<double> knots = knot_sequence(data, lambda, knot_spacing);
  const int size = static_cast<int>(knots.size()) - 4;
  BandedCholesky matrix(size, 3);
  std::vector<double> y(static_cast<std::size_t>(size), 0.0), z(y);

  // Least squares.
  for (const Observation& o : observations(data)) {
    int span = find_span(knots, o.s, 3, size - 1);
    const BasisPowers basis = basis_powers(knots, span);
    const double t = o.s - knots[static_cast<std::size_t>(span)];
    for (int a = 0; a < 4; ++a) {
      const double value = power_value(basis[static_cast<std::size_t>(a)], t);
      const int row = span - 3 + a;
      y[static_cast<std::size_t>(row)] += o.weight * value * o.y;
      z[static_cast<std::size_t>(row)] += o.weight * value * o.z;
      for (int b = 0; b <= a; ++b)
        matrix.at(row, span - 3 + b) += o.weight * value * power_value(basis[static_cast<std::size_t>(b)], t);
    }
  }
  // Penalty: f''' is constant on every knot interval.
  for (int span = 3; span < size; ++span) {
    const double h = knots[static_cast<std::size_t>(span) + 1] - knots[static_cast<std::size_t>(span)];
    if (!(h > 0.0)) continue;
    const BasisPowers basis = basis_powers(knots, span);
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b <= a; ++b)
        matrix.at(span - 3 + static_cast<int>(a), span - 3 + static_cast<int>(b)) +=
            lambda * h * 36.0 * basis[a][3] * basis[b][3];
  }
  matrix.factor();
  matrix.solve(y);
  matrix.solve(z);

  // Piecewise cubics on the knot intervals.
  std::vector<double> breaks{knots.front()};
  std::vector<CubicSegment> segments;
  for (int span = 3; span < size; ++span) {
    const double end = knots[static_cast<std::size_t>(span) + 1];
    if (!(end > knots[static_cast<std::size_t>(span)])) continue;
    const BasisPowers basis = basis_powers(knots, span);
    CubicSegment segment;
    for (std::size_t b = 0; b < 4; ++b)
      for (std::size_t k = 0; k < 4; ++k) {
        segment.y[k] += basis[b][k] * y[static_cast<std::size_t>(span) - 3 + b];
        segment.z[k] += basis[b][k] * z[static_cast<std::size_t>(span) - 3 + b];
      }
    segments.push_back(segment);
    breaks.push_back(end);
  }
  std::vector<double> kinks;
  for (std::size_t k = 1; k + 1 < data.kinks.size(); ++k)
    kinks.push_back(data.s[static_cast<std::size_t>(data.kinks[k])]);
  return ProfileSpline(std::move(breaks), std::move(segments), std::move(kinks));
}

}  // namespace treadmark::spline
