// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/half_fits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/fit/section_levels.hpp"

namespace treadmark::scans {
namespace {

/// The points of one half, held-out ones included; which those are depends on their numbers only.
BandPoints half_of(const BandPoints& points, std::size_t half) {
  constexpr std::uint64_t kSeed = 0x68616c66u;
  BandPoints out;
  out.rows = points.rows, out.columns = points.columns;
  out.cell_a = points.cell_a, out.cell_s = points.cell_s;
  out.halvings_a = points.halvings_a, out.halvings_s = points.halvings_s;
  out.numbers = points.numbers;
  out.begin.reserve(points.begin.size());
  for (std::size_t cell = 0; cell + 1 < points.begin.size(); ++cell) {
    out.begin.push_back(static_cast<std::uint32_t>(out.d.size()));
    for (std::size_t i = points.begin[cell]; i < points.begin[cell + 1]; ++i) {
      if (points.state[i] == PointState::outlier || points.state[i] == PointState::off_band) continue;
      if (Random(kSeed + points.number(i)).bits() >> 63 != half) continue;
      out.a.push_back(points.a[i]);
      out.s.push_back(points.s[i]);
      out.d.push_back(points.d[i]);
      out.index.push_back(points.index[i]);
      out.state.push_back(points.state[i]);
    }
  }
  out.begin.push_back(static_cast<std::uint32_t>(out.d.size()));
  return out;
}

/// Values at even steps from 0, joined by lines.
struct EvenLine {
  double step = 1.0;
  std::vector<double> value;

  double at(double s) const {
    const double x = std::clamp(s / step, 0.0, static_cast<double>(value.size() - 1));
    const auto k = std::min(value.size() - 2, to_whole<std::size_t>(std::floor(x)));
    return value[k] + (x - static_cast<double>(k)) * (value[k + 1] - value[k]);
  }
};

/// How far another section lies out of the material from this one, along it.
EvenLine between(const Section& section, const Section& other) {
  constexpr double kStep = 0.25e-3, kFarthest = 5e-3;  // [m]
  const auto steps = to_whole<std::size_t>(std::ceil(section.length() / kStep));
  EvenLine out{section.length() / static_cast<double>(steps), {}};
  for (std::size_t k = 0; k <= steps; ++k) {
    const auto foot = other.foot(section.at(out.step * static_cast<double>(k)).position, kFarthest);
    out.value.push_back(foot ? -foot->distance : 0.0);
  }
  return out;
}

}  // namespace

std::array<Section, 2> half_sections(const BandPoints& points, const Band& band, double finest) {
  return {refine_section(half_of(points, 0), band, finest), refine_section(half_of(points, 1), band, finest)};
}

std::vector<double> error_stations(const Band& band, std::span<const Damage> damage, std::span<const Hole> holes) {
  constexpr std::size_t kEven = 32, kInDamage = 8, kMostDamages = 4, kMostHoles = 4;
  constexpr double kBeside = 6e-3;  // from where no contact reaches a hole [m]
  std::vector<double> out;
  const auto put = [&](double a) {
    out.push_back(band.closed ? a - band.length() * std::floor(a / band.length()) : std::clamp(a, 0.0, band.length()));
  };
  const auto add = [&](double from, double length, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k)
      put(from + length * (static_cast<double>(k) + 0.5) / static_cast<double>(count));
  };
  add(0.0, band.length(), kEven);
  for (const Damage& one : damage.first(std::min(kMostDamages, damage.size())))
    add(one.a - 0.5 * one.length, one.length, kInDamage);
  std::size_t filled = 0;
  for (const Hole& hole : holes) {
    if (!hole.filled || filled++ >= kMostHoles) continue;
    const double half = 0.5 * hole.diameter;
    for (const double off : {-half - kBeside, -0.25 * half, 0.25 * half, half + kBeside}) put(hole.a + off);
  }
  return out;
}

SurfaceErrors half_fit_errors(const FittedBand& fitted, const BandPoints& points, const LocalNoise& noise,
                              const FitSettings& settings, const std::array<Section, 2>* sections,
                              std::span<const double> stations, double nominal_radius, const Progress& progress) {
  constexpr double kPlaces = 0.5e-3;  // of errors across the band [m]
  const Band& band = fitted.band;
  const bool wheel = band.body == Body::wheel;
  SurfaceErrors out;
  const auto steps = to_whole<std::size_t>(std::max(1.0, std::ceil((fitted.s_max - fitted.s_min) / kPlaces)));
  std::vector<double> s(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    // wheels' profiles run with decreasing y, bands do not
    const double share = static_cast<double>(wheel ? steps - i : i) / static_cast<double>(steps);
    s[i] = fitted.s_min + share * (fitted.s_max - fitted.s_min);
    const Vec2 p = band.section.at(s[i]).position;
    out.y.push_back(p.x());
    out.z.push_back(wheel ? p.y() - nominal_radius : -p.y());
  }
  for (const double a : stations) out.u.push_back(fitted.u_at(a));
  out.draws.resize(stations.size());
  for (std::size_t half = 0; half < 2; ++half) {
    BandPoints seen = half_of(points, half);
    EvenLine moved;
    if (sections != nullptr) {
      moved = between(band.section, (*sections)[half]);
      for (std::size_t i = 0; i < seen.size(); ++i) seen.d[i] -= static_cast<float>(moved.at(seen.s[i]));
    }
    const SplineField field = fit_field(seen, band, noise, settings, progress).field;
    parallel_for((stations.size() + 1 - half) / 2, [&](std::size_t k) {
      const std::size_t at = 2 * k + half;
      for (const double across : s)
        out.draws[at].push_back(fitted.field.value(stations[at], across) - field.value(stations[at], across) -
                                (sections != nullptr ? moved.at(across) : 0.0));
    });
  }
  return out;
}

}  // namespace treadmark::scans
