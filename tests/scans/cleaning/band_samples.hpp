// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "treadmark/scans/cleaning/band_points.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans::tests {

struct Sample {
  double a, s, d;
};

inline Section straight_section(double width, double v = 0.0) {
  std::vector<Vec2> points;
  for (int k = 0; k <= 20; ++k) points.emplace_back(width * (k / 20.0 - 0.5), v);
  return Section(points);
}

/// A rail's band, or a wheel's all round.
inline Band straight_band(double length, double width, bool closed) {
  const double radius = length / (2.0 * std::numbers::pi);
  if (closed)
    return {Body::wheel, radius, straight_section(width, radius), -std::numbers::pi * radius, std::numbers::pi * radius,
            true};
  return {Body::rail, 1.0, straight_section(width), 0.0, length, false};
}

/// Sorted into cells; index: the sample's number.
inline BandPoints sorted(const Band& band, std::size_t rows, std::size_t columns, const std::vector<Sample>& samples) {
  BandPoints out;
  out.rows = rows;
  out.columns = columns;
  out.cell_a = band.length() / static_cast<double>(rows);
  out.cell_s = band.section.length() / static_cast<double>(columns);
  std::vector<std::vector<std::uint32_t>> cells(rows * columns);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto row = std::min(rows - 1, static_cast<std::size_t>(samples[i].a / out.cell_a));
    const auto column = std::min(columns - 1, static_cast<std::size_t>(samples[i].s / out.cell_s));
    cells[row * columns + column].push_back(static_cast<std::uint32_t>(i));
  }
  out.begin.assign(1, 0);
  for (const auto& cell : cells) {
    for (const std::uint32_t i : cell) {
      out.a.push_back(static_cast<float>(samples[i].a));
      out.s.push_back(static_cast<float>(samples[i].s));
      out.d.push_back(static_cast<float>(samples[i].d));
      out.index.push_back(i);
      out.state.push_back(PointState::used);
    }
    out.begin.push_back(static_cast<std::uint32_t>(out.size()));
  }
  return out;
}

/// per_cell points at random places of every cell, at distance(a, s) and noise.
template <class Distance>
std::vector<Sample> scattered(const Band& band, std::size_t rows, std::size_t columns, int per_cell, double noise,
                              std::uint64_t seed, const Distance& distance) {
  Random random(seed);
  std::vector<Sample> out;
  const double da = band.length() / static_cast<double>(rows),
               ds = band.section.length() / static_cast<double>(columns);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      for (int k = 0; k < per_cell; ++k) {
        const double a = da * (static_cast<double>(r) + random.uniform()),
                     s = ds * (static_cast<double>(c) + random.uniform());
        const double d = distance(a, s);
        out.push_back({a, s, d + noise * gaussian(random)});
      }
  return out;
}

}  // namespace treadmark::scans::tests
