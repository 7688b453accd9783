// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/signal.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measures {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Corner over that of each of two passes whose product is at -3 dB there: (sqrt(2) - 1)^(1/4).
const double kTwoPasses = std::pow(std::numbers::sqrt2 - 1.0, 0.25);
constexpr double kButterworth = std::numbers::sqrt2 / 2.0;  // quality of second order

/// The integral of a polyline from its first point, at any place.
class RunningIntegral {
 public:
  RunningIntegral(std::span<const double> at, std::span<const double> values) : at_(at), line_(at, values) {
    if (at.size() < 2 || at.size() != values.size() || !(at.back() > at.front()))
      throw Error(ErrorKind::input_data, "a signal needs two points at least");
    sum_.resize(at.size());
    for (std::size_t i = 1; i < at.size(); ++i) {
      if (!(at[i] >= at[i - 1])) throw Error(ErrorKind::input_data, "the places of a signal decrease");
      sum_[i] = sum_[i - 1] + 0.5 * (at[i] - at[i - 1]) * (values[i] + values[i - 1]);
    }
  }

  /// Mean over a window, which is cut at both ends of the signal.
  double mean(double from, double to) const {
    from = std::max(from, at_.front()), to = std::min(to, at_.back());
    return (upto(to) - upto(from)) / (to - from);
  }

 private:
  double upto(double place) const {
    const std::size_t piece = line_.piece(place);
    return sum_[piece] + line_.integral(piece, place);
  }

  std::span<const double> at_;
  BrokenLine line_;
  std::vector<double> sum_;
};

EvenSignal means(const RunningIntegral& integral, double first, double last, double width, double step) {
  constexpr double kMost = 1e8, kSlack = 1e-9;
  if (!(step > 0.0) || !((last - first) / step < kMost))
    throw Error(ErrorKind::input_data, "a signal cannot be sampled so finely");
  EvenSignal out{first, step, {}};
  const auto count = to_whole<std::size_t>(std::floor((last - first) / step + kSlack)) + 1;
  out.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double middle = first + step * static_cast<double>(i);
    out.values.push_back(integral.mean(middle - 0.5 * width, middle + 0.5 * width));
  }
  return out;
}

/// (n2 p^2 + n1 p + n0)/(d2 p^2 + d1 p + 1), p = s over the angular corner, with p = (1/t)(1 - 1/z)/(1 + 1/z).
FilterSection bilinear(double n2, double n1, double n0, double d2, double d1, double t) {
  const double t2 = t * t, norm = d2 + d1 * t + t2;
  return {(n2 + n1 * t + n0 * t2) / norm, 2.0 * (n0 * t2 - n2) / norm, (n2 - n1 * t + n0 * t2) / norm,
          2.0 * (t2 - d2) / norm, (d2 - d1 * t + t2) / norm};
}
double warped(double corner, double step) { return std::tan(0.5 * kTurn * corner * step); }

/// In the state that a constant first sample leaves.
void filter_in_place(std::vector<double>& values, const FilterSection& s) {
  if (values.empty()) return;
  const double gain = (s.b0 + s.b1 + s.b2) / (1.0 + s.a1 + s.a2), first = values.front();
  // transposed direct form II
  double z1 = (gain - s.b0) * first, z2 = (s.b2 - s.a2 * gain) * first;
  for (double& v : values) {
    const double x = v, y = s.b0 * x + z1;
    z1 = s.b1 * x - s.a1 * y + z2;
    z2 = s.b2 * x - s.a2 * y;
    v = y;
  }
}

std::vector<double> both_ways(std::span<const double> values, const FilterSection& section, double settling) {
  if (values.empty()) return {};
  const auto n = static_cast<std::ptrdiff_t>(values.size());
  const auto more = std::min<std::ptrdiff_t>(n - 1, to_whole<std::ptrdiff_t>(std::ceil(settling)));
  std::vector<double> v;
  v.reserve(static_cast<std::size_t>(n + 2 * more));
  for (std::ptrdiff_t i = more; i > 0; --i) v.push_back(2.0 * values.front() - values[static_cast<std::size_t>(i)]);
  v.insert(v.end(), values.begin(), values.end());
  for (std::ptrdiff_t i = 1; i <= more; ++i)
    v.push_back(2.0 * values.back() - values[static_cast<std::size_t>(n - 1 - i)]);
  for (int pass = 0; pass < 2; ++pass) {
    filter_in_place(v, section);
    ranges::reverse(v);
  }
  return {v.begin() + more, v.begin() + more + n};
}

constexpr double kPeriods = 3.0;  // of the corner, in which a filter settles

struct WeightingParameters {
  double f1, f2, f3, f4, q4;
  double f5, q5, f6, q6;  ///< 0: no upward step
  double gain;
};

WeightingParameters parameters(Weighting weighting) {
  // ISO 8041:2005, parameters of the frequency weightings; band limits are Butterworth's
  if (weighting == Weighting::b) return {0.4, 100.0, 16.0, 16.0, 0.55, 2.5, 0.9, 4.0, 0.95, 1.024};
  return {0.4, 100.0, 2.0, 2.0, 0.63, 0.0, 0.0, 0.0, 0.0, 1.0};
}

}  // namespace

EvenSignal even_samples(std::span<const double> at, std::span<const double> values, double step) {
  const RunningIntegral integral(at, values);
  return means(integral, at.front(), at.back(), step, step);
}

EvenSignal sliding_means(std::span<const double> at, std::span<const double> values, double begin, double end,
                         double width, double step) {
  const RunningIntegral integral(at, values);
  begin = std::max(begin, at.front()), end = std::min(end, at.back());
  if (end - begin < width * (1.0 - 1e-9)) return {begin, step, {}};
  return means(integral, begin + 0.5 * width, end - 0.5 * width, width, step);
}

FilterSection low_pass_section(double corner, double quality, double step) {
  return bilinear(0.0, 0.0, 1.0, 1.0, 1.0 / quality, warped(corner, step));
}

FilterSection high_pass_section(double corner, double quality, double step) {
  return bilinear(1.0, 0.0, 0.0, 1.0, 1.0 / quality, warped(corner, step));
}

FilterSection transition_section(double zero, double corner, double quality, double step) {
  return bilinear(0.0, corner / zero, 1.0, 1.0, 1.0 / quality, warped(corner, step));
}

FilterSection step_section(double zero, double zero_quality, double corner, double quality, double step) {
  const double ratio = corner / zero, scale = 1.0 / (ratio * ratio);
  return bilinear(1.0, scale * ratio / zero_quality, scale, 1.0, 1.0 / quality, warped(corner, step));
}

double magnitude(std::span<const FilterSection> sections, double frequency, double step) {
  const std::complex<double> back = std::polar(1.0, -kTurn * frequency * step);
  std::complex<double> h = 1.0;
  for (const FilterSection& s : sections)
    h *= (s.b0 + back * (s.b1 + back * s.b2)) / (1.0 + back * (s.a1 + back * s.a2));
  return std::abs(h);
}

std::vector<double> filtered(std::span<const double> values, std::span<const FilterSection> sections) {
  std::vector<double> out(values.begin(), values.end());
  for (const FilterSection& section : sections) filter_in_place(out, section);
  return out;
}

std::vector<double> low_passed(std::span<const double> values, double step, double corner) {
  const FilterSection pass = bilinear(0.0, 0.0, 1.0, 1.0, 1.0 / kButterworth, warped(corner, step) / kTwoPasses);
  return both_ways(values, pass, kPeriods / (corner * step));
}

std::vector<double> high_passed(std::span<const double> values, double step, double corner) {
  const FilterSection pass = bilinear(1.0, 0.0, 0.0, 1.0, 1.0 / kButterworth, warped(corner, step) * kTwoPasses);
  return both_ways(values, pass, kPeriods / (corner * step));
}

double low_pass_magnitude(double frequency, double corner) {
  return 1.0 / (1.0 + std::pow(kTwoPasses * frequency / corner, 4.0));
}

double high_pass_magnitude(double frequency, double corner) {
  return frequency > 0.0 ? 1.0 / (1.0 + std::pow(kTwoPasses * corner / frequency, 4.0)) : 0.0;
}

std::vector<FilterSection> weighting_sections(Weighting weighting, double step) {
  const WeightingParameters p = parameters(weighting);
  std::vector<FilterSection> sections{high_pass_section(p.f1, kButterworth, step),
                                      low_pass_section(p.f2, kButterworth, step),
                                      transition_section(p.f3, p.f4, p.q4, step)};
  if (p.f5 > 0.0) sections.push_back(step_section(p.f5, p.q5, p.f6, p.q6, step));
  FilterSection& first = sections.front();
  first.b0 *= p.gain, first.b1 *= p.gain, first.b2 *= p.gain;
  return sections;
}

double weighting_magnitude(Weighting weighting, double frequency) {
  const WeightingParameters p = parameters(weighting);
  const std::complex<double> s(0.0, frequency);
  const auto second = [&](double corner, double quality) {
    return 1.0 + s / (quality * corner) + s * s / (corner * corner);
  };
  std::complex<double> h = p.gain * (s * s / (p.f1 * p.f1)) / second(p.f1, kButterworth) / second(p.f2, kButterworth) *
                           (1.0 + s / p.f3) / second(p.f4, p.q4);
  if (p.f5 > 0.0) h *= second(p.f5, p.q5) / second(p.f6, p.q6) * (p.f5 * p.f5) / (p.f6 * p.f6);
  return std::abs(h);
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto low = values.begin() + to_whole<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), low, values.end());
  if (low + 1 == values.end()) return *low;
  const double next = *std::min_element(low + 1, values.end());
  return *low + (place - std::floor(place)) * (next - *low);
}

double rms_of(std::span<const double> values) {
  double square = 0.0;
  for (const double v : values) square += v * v;
  return std::sqrt(square / static_cast<double>(values.size()));
}

}  // namespace treadmark::measures
