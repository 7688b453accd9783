// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/roughness.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "treadmark/analysis/measures/bands.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measures {
namespace {

constexpr double kCircle = 2.0 * std::numbers::pi;

void take_line(std::vector<double>& h) {
  const auto n = static_cast<double>(h.size());
  double mean = 0.0, slope = 0.0, square = 0.0;
  for (const double v : h) mean += v / n;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const double x = static_cast<double>(i) - 0.5 * (n - 1.0);
    slope += x * h[i], square += x * x;
  }
  slope /= square;
  for (std::size_t i = 0; i < h.size(); ++i) h[i] -= mean + slope * (static_cast<double>(i) - 0.5 * (n - 1.0));
}

/// Upward points that stand alone: above the line through both sides by more than these scatter about it.
std::size_t take_spikes(std::vector<double>& h, double step) {
  constexpr double kReach = 8e-3;  // [m]
  const auto half = std::max<std::ptrdiff_t>(3, to_whole<std::ptrdiff_t>(kReach / step));
  const std::vector<double> before = h;
  std::size_t count = 0;
  const auto n = static_cast<std::ptrdiff_t>(h.size());
  std::vector<double> left, right;
  const auto median = [](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  constexpr double kOut = 6.0, kLeast = 2e-6;
  for (std::ptrdiff_t i = half; i < n - half; ++i) {
    const auto value = [&](std::ptrdiff_t j) { return before[static_cast<std::size_t>(j)]; };
    if (value(i) < 0.5 * (value(i - half) + value(i + half)) + 0.5 * kLeast) continue;
    left.assign(before.begin() + (i - half), before.begin() + (i - half / 2));
    right.assign(before.begin() + (i + half / 2 + 1), before.begin() + (i + half + 1));
    const double a = median(left), b = median(right), between = 0.5 * (a + b);
    // scatter about the line through both sides
    const double slope = (b - a) / (1.5 * static_cast<double>(half));
    left.clear();
    for (std::ptrdiff_t j = i - half; j <= i + half; ++j)
      if (std::abs(j - i) > half / 2)
        left.push_back(std::fabs(value(j) - between - slope * static_cast<double>(j - i)));
    if (value(i) - between > std::max(kLeast, kOut * 1.4826 * median(left)))
      h[static_cast<std::size_t>(i)] = between, ++count;
  }
  return count;
}

struct Spectrum {
  double line = 0.0;          // between lines [1/m]
  std::vector<double> power;  // mean square of each line [m^2]
};

/// Power of the lines of a detrended segment under a Hann window, by Goertzel's recurrence (1958).
Spectrum spectrum_of(std::vector<double> h, double step) {
  take_line(h);
  const std::size_t n = h.size();
  double window = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = 0.5 - 0.5 * std::cos(kCircle * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    h[i] *= w;
    window += w * w;
  }
  Spectrum out;
  out.line = 1.0 / (step * static_cast<double>(n));
  out.power.resize(n / 2, 0.0);
  for (std::size_t k = 1; k < n / 2; ++k) {
    const double c = 2.0 * std::cos(kCircle * static_cast<double>(k) / static_cast<double>(n));
    double a = 0.0, b = 0.0;
    for (const double v : h) {
      const double next = v + c * a - b;
      b = a, a = next;
    }
    out.power[k] = 2.0 * (a * a + b * b - c * a * b) / (static_cast<double>(n) * window);
  }
  return out;
}

/// Wavelengths between two ends, by a windowed sinc; empty where the record is too short.
std::vector<double> passed(const std::vector<double>& h, double step, double shortest, double longest) {
  const auto half = to_whole<std::ptrdiff_t>(1.5 * longest / step);
  const auto n = static_cast<std::ptrdiff_t>(h.size());
  if (n < 2 * half + to_whole<std::ptrdiff_t>(longest / step) || shortest < 4.0 * step) return {};
  std::vector<double> kernel(static_cast<std::size_t>(2 * half + 1));
  const double high = 1.0 / shortest, low = 1.0 / longest;
  for (std::ptrdiff_t i = -half; i <= half; ++i) {
    const double x = static_cast<double>(i) * step;
    const double ideal = i == 0 ? 2.0 * (high - low)
                                : (std::sin(kCircle * high * x) - std::sin(kCircle * low * x)) / (std::numbers::pi * x);
    const double w = 0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(half + 1));
    kernel[static_cast<std::size_t>(i + half)] = ideal * w * step;
  }
  std::vector<double> out;
  for (std::ptrdiff_t i = half; i < n - half; ++i) {
    double sum = 0.0;
    for (std::ptrdiff_t j = -half; j <= half; ++j)
      sum += kernel[static_cast<std::size_t>(j + half)] * h[static_cast<std::size_t>(i + j)];
    out.push_back(sum);
  }
  return out;
}

WaveBand wave_band(const std::vector<double>& h, double step, double shortest, double longest) {
  WaveBand band{shortest, longest};
  const std::vector<double> wave = passed(h, step, shortest, longest);
  if (wave.empty()) return band;
  double square = 0.0;
  for (const double v : wave) square += v * v;
  band.rms = std::sqrt(square / static_cast<double>(wave.size()));
  const auto window = std::min(wave.size(), to_whole<std::size_t>(3.0 * longest / step));
  band.peak_to_peak = 0.0;
  for (std::size_t i = 0; i + window <= wave.size(); i += std::max<std::size_t>(1, window / 8)) {
    const auto [least, most] = std::minmax_element(wave.begin() + static_cast<std::ptrdiff_t>(i),
                                                   wave.begin() + static_cast<std::ptrdiff_t>(i + window));
    band.peak_to_peak = std::max(band.peak_to_peak, *most - *least);
  }
  return band;
}

}  // namespace

std::vector<double> closed_pits(std::span<const double> height, double step, double wheel_radius) {
  const auto [least, most] = std::minmax_element(height.begin(), height.end());
  const auto n = static_cast<std::ptrdiff_t>(height.size());
  const auto reach = std::min<std::ptrdiff_t>(
      n, to_whole<std::ptrdiff_t>(std::sqrt(2.0 * wheel_radius * (*most - *least)) / step) + 1);
  std::vector<double> lift(static_cast<std::size_t>(reach) + 1), centre(height.size()), out(height.size());
  for (std::ptrdiff_t j = 0; j <= reach; ++j) {
    const double x = static_cast<double>(j) * step;
    lift[static_cast<std::size_t>(j)] = wheel_radius - std::sqrt(std::max(0.0, wheel_radius * wheel_radius - x * x));
  }
  const auto over = [&](const auto& from, std::vector<double>& to, double sign) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      double best = from[static_cast<std::size_t>(i)];
      for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - reach); j <= std::min(n - 1, i + reach); ++j) {
        const double v = from[static_cast<std::size_t>(j)] - sign * lift[static_cast<std::size_t>(std::abs(j - i))];
        best = sign > 0.0 ? std::max(best, v) : std::min(best, v);
      }
      to[static_cast<std::size_t>(i)] = best;
    }
  };
  over(height, centre, +1.0);
  over(centre, out, -1.0);
  return out;
}

RoughnessMeasures measure_roughness(std::span<const double> height, double step, const RoughnessGauge& gauge,
                                    std::span<const double> limits) {
  constexpr std::size_t kFewest = 64;
  if (height.size() < kFewest || !(step > 0.0))
    throw Error(ErrorKind::input_data, "the line along the rail has too few samples for a spectrum");
  for (const double h : height)
    if (std::isnan(h)) throw Error(ErrorKind::input_data, "the line along the rail has gaps");
  std::vector<double> h(height.begin(), height.end());
  take_line(h);
  RoughnessMeasures out;
  out.step = step;
  out.length = step * static_cast<double>(h.size());
  if (gauge.remove_spikes) out.spikes = take_spikes(h, step);
  if (gauge.wheel_radius > 0.0) h = closed_pits(h, step, gauge.wheel_radius);

  const auto size = std::min(h.size(), to_whole<std::size_t>(std::round(gauge.segment / step)));
  std::vector<Spectrum> spectra;
  for (std::size_t i = 0; i + size <= h.size(); i += std::max<std::size_t>(1, size / 2))
    spectra.push_back(spectrum_of(
        {h.begin() + static_cast<std::ptrdiff_t>(i), h.begin() + static_cast<std::ptrdiff_t>(i + size)}, step));
  out.segments = static_cast<int>(spectra.size());
  for (std::size_t b = 0; b < third_octaves().size(); ++b) {
    RoughnessBand band;
    band.wavelength = third_octaves()[b];
    band.limit = limits.empty() ? iso_3095_limit(band.wavelength) : limits[b];
    const BandEnds ends = ends_of(band.wavelength);
    const double low = 1.0 / ends.longest, high = 1.0 / ends.shortest, line = spectra.front().line;
    const auto first = to_whole<std::size_t>(std::ceil(low / line)),
               last = to_whole<std::size_t>(std::ceil(high / line));
    // in a segment: with fewer a band is narrower than what the window makes of one sine, which its neighbours get
    constexpr double kFewestWaves = 8.0;
    if (last > first && last <= spectra.front().power.size() &&
        ends.longest * kFewestWaves < step * static_cast<double>(size)) {
      std::vector<double> power;
      double mean = 0.0;
      for (const Spectrum& s : spectra) {
        double sum = 0.0;
        for (std::size_t k = first; k < last; ++k) sum += s.power[k];
        power.push_back(sum);
        mean += sum / static_cast<double>(spectra.size());
      }
      if (mean > 0.0) band.level = level_of(std::sqrt(mean));
      if (power.size() > 1 && mean > 0.0) {
        double square = 0.0;
        for (const double p : power) {
          const double d = 10.0 * std::log10(std::max(p, 1e-6 * mean) / mean);
          square += d * d;
        }
        band.spread = std::sqrt(square / static_cast<double>(power.size() - 1));
      }
      if (gauge.noise > 0.0) band.floor = level_of(gauge.noise * std::sqrt(2.0 * step * (high - low)));
    }
    out.bands.push_back(band);
  }
  for (const auto& [shortest, longest] : {std::pair{10e-3, 30e-3}, {30e-3, 100e-3}, {100e-3, 300e-3}, {300e-3, 1.0}})
    out.waves.push_back(wave_band(h, step, shortest, longest));
  return out;
}

}  // namespace treadmark::measures
