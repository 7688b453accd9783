// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/round.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "treadmark/analysis/measures/bands.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measures {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kRoundSigmas = 1.96;

/// Coefficients of 1, cos, sin, cos 2 ... by least squares over the samples in use. spread: if given, their variances
/// for scatter of variance 1.
Eigen::VectorXd harmonics(std::span<const double> theta, std::span<const double> value, const std::vector<char>& use,
                          int orders, Eigen::VectorXd* spread = nullptr) {
  const int n = 1 + 2 * orders;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n), row(n);
  for (std::size_t i = 0; i < theta.size(); ++i) {
    if (use[i] == 0) continue;
    row[0] = 1.0;
    for (int k = 1; k <= orders; ++k) {
      row[2 * k - 1] = std::cos(k * theta[i]);
      row[2 * k] = std::sin(k * theta[i]);
    }
    normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
    right += value[i] * row;
  }
  const auto solver = normal.selfadjointView<Eigen::Lower>().ldlt();
  if (spread != nullptr) *spread = solver.solve(Eigen::MatrixXd::Identity(n, n)).diagonal();
  return solver.solve(right);
}

double harmonic_value(const Eigen::VectorXd& c, double theta) {
  double sum = c[0];
  for (Eigen::Index k = 1; 2 * k < c.size(); ++k)
    sum +=
        c[2 * k - 1] * std::cos(static_cast<double>(k) * theta) + c[2 * k] * std::sin(static_cast<double>(k) * theta);
  return sum;
}

double median_size(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  for (double& v : values) v = std::fabs(v);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Revolution {
 public:
  Revolution(std::span<const double> theta, std::span<const double> radius, const RoundGauge& gauge)
      : theta_(theta), radius_(radius), g_(gauge) {}

  RoundMeasures measure() {
    there_.resize(theta_.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < theta_.size(); ++i) {
      there_[i] = std::isnan(radius_[i]) ? 0 : 1;
      count += there_[i] != 0 ? 1U : 0U;
    }
    out_.gaps = 1.0 - static_cast<double>(count) / std::max<double>(1.0, static_cast<double>(theta_.size()));
    constexpr double kMostGaps = 1.0 / 3.0;
    if (out_.gaps > kMostGaps || count < 4U * static_cast<unsigned>(g_.orders))
      throw Error(
          ErrorKind::input_data,
          fmt::format("too little of the revolution is there: {} samples, {:.0f} % missing", count, 100.0 * out_.gaps),
          {}, "scan the wheel all round, or measure a section");
    find_round_part();
    orders();
    flats();
    return out_;
  }

 private:
  /// Takes out dips until low orders describe what is left.
  void find_round_part() {
    constexpr int kLow = 8, kRounds = 8;
    round_ = there_;
    const double step = kFullTurn / static_cast<double>(theta_.size());
    for (int pass = 0; pass < kRounds; ++pass) {
      const Eigen::VectorXd base = harmonics(theta_, radius_, round_, std::min(kLow, g_.orders));
      deviation_.assign(theta_.size(), kUnknown);
      std::vector<double> inside;
      for (std::size_t i = 0; i < theta_.size(); ++i)
        if (there_[i] != 0) {
          deviation_[i] = radius_[i] - harmonic_value(base, theta_[i]);
          if (round_[i] != 0) inside.push_back(deviation_[i]);
        }
      const double sigma = 1.4826 * median_size(inside);
      // a dip is a run of samples below the threshold and well out of the scatter; its skirts go with it
      std::vector<char> next = there_;
      const double deep = std::max(g_.flat_threshold, 3.0 * sigma),
                   skirt = std::max(0.1 * g_.flat_threshold, 2.0 * sigma);
      const auto size = static_cast<std::ptrdiff_t>(theta_.size());
      const auto wrapped = [size](std::ptrdiff_t i) { return static_cast<std::size_t>(((i % size) + size) % size); };
      const auto margin = to_whole<std::ptrdiff_t>(std::ceil(0.01 / step));
      const auto longest = to_whole<std::ptrdiff_t>(g_.longest_flat / (base[0] * step));
      for (std::ptrdiff_t i = 0; i < size; ++i) {
        if (!(smooth(wrapped(i)) < -deep)) continue;
        for (const std::ptrdiff_t way : {-1, +1}) {
          std::ptrdiff_t j = i, spare = 0;
          for (; std::abs(j - i) < longest && spare < margin; j += way) {
            spare = smooth(wrapped(j)) < -skirt ? 0 : spare + 1;
            next[wrapped(j)] = 0;
          }
        }
      }
      if (next == round_) break;
      round_ = next;
    }
  }

  /// Mean of the deviation over a few samples: dips are wider than that.
  double smooth(std::size_t i) const {
    const auto size = static_cast<std::ptrdiff_t>(theta_.size());
    const std::ptrdiff_t half = std::max<std::ptrdiff_t>(0, to_whole<std::ptrdiff_t>(kSmoothArc / out_arc()) / 2);
    double sum = 0.0;
    int count = 0;
    for (std::ptrdiff_t j = -half; j <= half; ++j) {
      const double d =
          deviation_[static_cast<std::size_t>(((static_cast<std::ptrdiff_t>(i) + j) % size + size) % size)];
      if (d == d) sum += d, ++count;
    }
    return count > 0 ? sum / count : kUnknown;
  }
  double out_arc() const {  // between samples
    const double r = radius_[0] == radius_[0] ? radius_[0] : 0.46;
    return r * kFullTurn / static_cast<double>(theta_.size());
  }

  void orders() {
    Eigen::VectorXd spread;
    const Eigen::VectorXd c = harmonics(theta_, radius_, round_, g_.orders, &spread);
    out_.radius = c[0];
    double square = 0.0;
    std::size_t used = 0;
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (std::size_t i = 0; i < theta_.size(); ++i) {
      if (there_[i] != 0) {
        least = std::min(least, radius_[i]);
        greatest = std::max(greatest, radius_[i]);
      }
      if (round_[i] == 0) continue;
      const double off = radius_[i] - harmonic_value(c, theta_[i]);
      square += off * off;
      ++used;
    }
    const double free = std::max(1.0, static_cast<double>(used) - static_cast<double>(c.size()));
    out_.scatter = std::sqrt(square / free);
    const double scatter = std::max(out_.scatter, g_.scatter);
    out_.runout = {greatest - least, kRoundSigmas * std::numbers::sqrt2 * out_.scatter, {}};
    const auto error_of = [&](int k) {
      return kRoundSigmas * scatter * std::sqrt(std::max(spread[2 * k - 1], spread[2 * k]));
    };
    out_.eccentricity = {std::hypot(c[1], c[2]), error_of(1), {}};
    for (int k = 2; k <= g_.orders; ++k) {
      const double a = c[2 * k - 1], b = c[2 * k], amplitude = std::hypot(a, b);
      out_.orders.push_back({k, amplitude, std::atan2(-b, a), error_of(k), level_of(amplitude / std::numbers::sqrt2),
                             kFullTurn * out_.radius / k});
    }
    for (const double nominal : third_octaves()) {
      const BandEnds ends = ends_of(nominal);
      if (ends.shortest < out_.orders.back().wavelength || ends.longest > kFullTurn * out_.radius) continue;
      double power = 0.0;
      for (const RoundOrder& o : out_.orders)
        if (o.wavelength >= ends.shortest && o.wavelength < ends.longest) power += 0.5 * o.amplitude * o.amplitude;
      out_.bands.push_back({nominal, power > 0.0 ? level_of(std::sqrt(power)) : kUnknown});
    }
    // flats lie below what the round part would be there
    for (std::size_t i = 0; i < theta_.size(); ++i)
      deviation_[i] = there_[i] != 0 ? radius_[i] - harmonic_value(low_orders(c), theta_[i]) : kUnknown;
  }

  /// Across a flat only orders much longer than it can be told.
  static Eigen::VectorXd low_orders(const Eigen::VectorXd& c) {
    constexpr Eigen::Index kLow = 8;
    return c.head(std::min<Eigen::Index>(c.size(), 1 + 2 * kLow));
  }

  void flats() {
    const auto size = static_cast<std::ptrdiff_t>(theta_.size());
    const auto wrapped = [size](std::ptrdiff_t i) { return static_cast<std::size_t>(((i % size) + size) % size); };
    const double arc = out_.radius * kFullTurn / static_cast<double>(size);
    // runs of samples that were taken out
    std::ptrdiff_t first = 0;
    while (first < size && round_[static_cast<std::size_t>(first)] == 0) ++first;
    if (first == size) return;
    const double noise = local_noise();
    const double smoothed = noise / std::sqrt(std::max(1.0, kSmoothArc / arc));
    for (std::ptrdiff_t i = first; i < first + size;) {
      if (round_[wrapped(i)] != 0 || there_[wrapped(i)] == 0) {
        ++i;
        continue;
      }
      std::ptrdiff_t end = i, deepest = i;
      while (end < first + size && round_[wrapped(end)] == 0) {
        if (smooth(wrapped(end)) < smooth(wrapped(deepest)) || there_[wrapped(deepest)] == 0) deepest = end;
        ++end;
      }
      const double bottom = smooth(wrapped(deepest));
      if (bottom < -g_.flat_threshold) out_.flats.push_back(flat(deepest, bottom, arc, smoothed, wrapped));
      i = end;
    }
    std::sort(out_.flats.begin(), out_.flats.end(),
              [](const RoundFlat& a, const RoundFlat& b) { return a.depth.value > b.depth.value; });
  }

  /// Standard deviation of single samples, from neighbours.
  double local_noise() const {
    std::vector<double> sizes;
    for (std::size_t i = 1; i + 1 < deviation_.size(); ++i) {
      const double d = deviation_[i] - 0.5 * (deviation_[i - 1] + deviation_[i + 1]);
      if (d == d) sizes.push_back(d / std::sqrt(1.5));
    }
    return 1.4826 * median_size(std::move(sizes));
  }

  /// Parabola d(x) by least squares over samples about one of them, with what scatter does to it.
  struct Dip {
    Eigen::Vector3d c = Eigen::Vector3d::Zero();
    Eigen::Matrix3d variance = Eigen::Matrix3d::Zero();

    double root() const { return std::sqrt(std::max(0.0, c[1] * c[1] - 4.0 * c[0] * c[2])); }
    double length() const { return root() / c[2]; }
    double length_error(double base) const {
      const double r = std::max(root(), 1e-9);
      const Eigen::Vector3d d(-2.0 / r, c[1] / (r * c[2]), -2.0 * c[0] / (r * c[2]) - r / (c[2] * c[2]));
      return std::sqrt(d.dot(variance * d) + d[0] * d[0] * base * base);
    }
    double bottom_at() const { return c[2] > 0.0 ? -0.5 * c[1] / c[2] : 0.0; }
    double bottom() const { return c[0] + bottom_at() * (c[1] + bottom_at() * c[2]); }
  };
  template <class Wrapped>
  Dip dip(std::ptrdiff_t middle, std::ptrdiff_t left, std::ptrdiff_t right, double arc, double sigma,
          const Wrapped& wrapped) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    const double scale = arc * static_cast<double>(std::max<std::ptrdiff_t>(left + right, 1));
    for (std::ptrdiff_t j = -left; j <= right; ++j) {
      const double d = deviation_[wrapped(middle + j)];
      if (!(d == d)) continue;
      const double x = static_cast<double>(j) * arc / scale;
      const Eigen::Vector3d row(1.0, x, x * x);
      normal += row * row.transpose();
      sums += d * row;
    }
    const Eigen::Vector3d units(1.0, 1.0 / scale, 1.0 / (scale * scale));
    Dip out;
    out.c = units.asDiagonal() * Eigen::Vector3d(normal.ldlt().solve(sums));
    out.variance = sigma * sigma * (units.asDiagonal() * normal.inverse() * units.asDiagonal()).eval();
    return out;
  }

  template <class Wrapped>
  RoundFlat flat(std::ptrdiff_t deepest, double bottom, double arc, double noise, const Wrapped& wrapped) const {
    RoundFlat out;
    const double sigma = std::max(g_.scatter, noise * std::sqrt(std::max(1.0, kSmoothArc / arc)));  // of single samples
    // what the round part may be off below the flat: 17 coefficients from all samples
    const double base = std::max(out_.scatter, g_.scatter) * std::sqrt(17.0 / static_cast<double>(theta_.size()));
    const double tolerance = std::max(0.1 * g_.flat_threshold, 2.5 * noise);
    const double level = std::max(g_.flat_threshold, 2.0 * tolerance);
    const auto crossing = [&](double below, std::ptrdiff_t way) {
      std::ptrdiff_t j = deepest;
      while (std::fabs(static_cast<double>(j - deepest)) * arc < g_.longest_flat && smooth(wrapped(j + way)) < -below)
        j += way;
      const double inner = smooth(wrapped(j)), outer = smooth(wrapped(j + way));
      const double part = outer > inner ? std::clamp((-below - inner) / (outer - inner), 0.0, 1.0) : 0.0;
      return (std::fabs(static_cast<double>(j - deepest)) + part) * arc;
    };
    // A fresh flat is a chord: a parabola of curvature 1/R down from the round wheel.
    const double low = std::min(level, -0.5 * bottom);
    const auto whole = [&](double length) {
      return std::max<std::ptrdiff_t>(2, to_whole<std::ptrdiff_t>(length / arc));
    };
    const Dip wide = dip(deepest, whole(crossing(low, -1)), whole(crossing(low, +1)), arc, sigma, wrapped);
    constexpr double kAlike = 0.3;
    const bool is_chord = std::fabs(2.0 * out_.radius * wide.c[2] - 1.0) < kAlike;
    // the depth from the middle alone: whatever smoothed the samples has rounded the ends
    const auto third = whole(std::sqrt(-2.0 * out_.radius * bottom) / 2.0);
    const Dip used = dip(deepest, third, third, arc, sigma, wrapped);
    const bool inside = used.c[2] > 0.0 && std::fabs(used.bottom_at()) < arc * static_cast<double>(2 * third);
    const double depth = inside ? -used.bottom() : -bottom;
    out.depth = {depth, kRoundSigmas * std::hypot(std::sqrt(used.variance(0, 0)), base), {}};
    const double at = inside ? used.bottom_at() : 0.0;
    out.theta = std::remainder(theta_[wrapped(deepest)] + at / out_.radius, kFullTurn);
    if (is_chord) {
      out.length = {wide.length(), kRoundSigmas * wide.length_error(base), {}};
    } else {
      // Each end: out from the level to a low one, then along the line through both to where the round wheel begins.
      double length = 0.0, spread = 0.0;
      for (const std::ptrdiff_t way : {-1, +1}) {
        const double near = crossing(level, way), far = crossing(tolerance, way);
        const double on = (far - near) * tolerance / (level - tolerance);
        length += far + on;
        spread += noise * (far - near) / (level - tolerance) + 0.5 * on;
      }
      out.length = {length, kRoundSigmas * spread, {}};
    }
    out.chord_length = std::sqrt(8.0 * out_.radius * depth);
    out.rounded_length = std::sqrt(16.0 * out_.radius * depth);
    return out;
  }

  static constexpr double kSmoothArc = 4e-3;  ///< [m]
  std::span<const double> theta_, radius_;
  RoundGauge g_;
  RoundMeasures out_;
  std::vector<char> there_, round_;
  std::vector<double> deviation_;
};

}  // namespace

RoundMeasures measure_round(std::span<const double> theta, std::span<const double> radius, const RoundGauge& gauge) {
  return Revolution(theta, radius, gauge).measure();
}

}  // namespace treadmark::measures
