// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/sample_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "treadmark/backends/sampling/lateral_nodes.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::app {
namespace {

constexpr int kAcross = 120;                                    // points of a station
constexpr double kMostPoints = 60000.0, kManyPoints = 30000.0;  // at most; as many as cost little
constexpr double kWindow = 60e-3;                               // about a contact [m]
constexpr int kCoarseRound = 180;                               // stations
constexpr double kDenseRound = 1e-3, kDenseAlong = 1.5e-3, kCoarseAlong = 20e-3, kPrismatic = 25e-3,
                 kBeyond = 150e-3;                    // [m]
constexpr double kCoarser = 1.15;                     // a step towards fewer points
constexpr double kDeep = 45e-3;                       // below the top of a rail: no wheel comes there [m]
constexpr double kFarthest = 0.3;                     // of surfaces without lateral ends [m]
constexpr double kCrossing = 5e-3, kRounding = 1e-9;  // deviations that are none [m]

bool is_closed(const UsedBody& b) { return b.body == Body::wheel || b.radius > 0.0; }
double outward(const UsedBody& b) { return b.body == Body::wheel ? 1.0 : -1.0; }

/// The plane in which the section of a station is a height over y.
Pose plane_of(const UsedBody& b, double u) {
  if (b.body == Body::wheel || !is_closed(b)) return natural_plane(b.body, u);
  Pose X;
  X.origin.z() = b.radius;
  X.rotation.col(0) = Vec3(std::cos(u), 0.0, std::sin(u));
  X.rotation.col(1) = Vec3::UnitY();
  X.rotation.col(2) = Vec3(-std::sin(u), 0.0, std::cos(u));
  return X;
}

/// Whether the surface itself knows the shape at a station.
bool has_station(const UsedBody& b, double u) {
  if (b.beyond == nullptr) return true;
  if (!is_closed(b)) return u >= b.low && u <= b.high;
  const double half = 0.5 * (b.high - b.low);
  return !(half < kPi) || std::fabs(wrap_angle(u - b.low - half)) <= half;
}

std::vector<double> round_stations(double radius, const std::vector<double>& contacts, double most) {
  for (double dense = kDenseRound;; dense *= kCoarser) {
    const int per_coarse = std::max(1, to_whole<int>(std::ceil(2.0 * kPi * radius / (kCoarseRound * dense))));
    const int n = kCoarseRound * per_coarse;
    std::vector<bool> wanted(static_cast<std::size_t>(n), false);
    const auto want = [&](int i) { wanted[static_cast<std::size_t>((i % n + n) % n)] = true; };
    for (int i = 0; i < n; i += per_coarse) want(i);
    const int reach = to_whole<int>(std::ceil(kWindow / radius * n / (2.0 * kPi)));
    for (const double contact : contacts) {
      const int middle = to_whole<int>(std::round((wrap_angle(contact) + kPi) * n / (2.0 * kPi)));
      for (int i = -std::min(reach, n / 2); i <= std::min(reach, n / 2); ++i) want(middle + i);
    }
    if (static_cast<double>(std::count(wanted.begin(), wanted.end(), true)) > most && per_coarse > 1) continue;
    std::vector<double> u;
    for (int i = 0; i < n; ++i)
      if (wanted[static_cast<std::size_t>(i)]) u.push_back(-kPi + 2.0 * kPi * i / n);
    return u;
  }
}

std::vector<double> even(double low, double high, double step) {
  const int n = std::max(1, to_whole<int>(std::ceil((high - low) / step)));
  std::vector<double> u;
  for (int i = 0; i <= n; ++i) u.push_back(i == n ? high : low + (high - low) * i / n);
  return u;
}

std::vector<double> rail_stations(bool constant, const std::vector<double>& contacts, double most, double many) {
  const auto [first, last] = ranges::minmax(contacts);
  const double low = first - kBeyond, high = last + kBeyond;
  if (constant) return even(low, high, std::max(kPrismatic, (high - low) / most));
  if ((high - low) / kDenseAlong < many) return even(low, high, kDenseAlong);
  for (double factor = 1.0;; factor *= kCoarser) {
    const std::vector<double> fine = even(low, high, factor * kDenseAlong);
    const auto per_coarse = to_whole<std::size_t>(kCoarseAlong / kDenseAlong);
    std::vector<bool> wanted(fine.size(), false);
    for (const double contact : contacts) {
      const auto begin = std::lower_bound(fine.begin(), fine.end(), contact - kWindow);
      const auto end = std::upper_bound(begin, fine.end(), contact + kWindow);
      std::fill(wanted.begin() + (begin - fine.begin()), wanted.begin() + (end - fine.begin()), true);
    }
    std::vector<double> u;
    for (std::size_t i = 0; i < fine.size(); ++i)
      if (wanted[i] || i % per_coarse == 0 || i + 1 == fine.size()) u.push_back(fine[i]);
    if (static_cast<double>(u.size()) <= most) return u;
  }
}

/// A few of the contacts, spread over all of them.
std::vector<double> some_of(std::vector<double> contacts) {
  constexpr std::size_t kFew = 5;
  std::sort(contacts.begin(), contacts.end());
  if (contacts.size() <= kFew) return contacts;
  std::vector<double> out;
  for (std::size_t i = 0; i < kFew; ++i) out.push_back(contacts[i * (contacts.size() - 1) / (kFew - 1)]);
  return out;
}

/// Lateral places in equal steps of arc length over the part that can be touched.
std::vector<double> nodes_across(const UsedBody& b, const std::vector<double>& contacts) {
  constexpr double kFirst = 2e-3;
  const bool roller = b.body == Body::rail && is_closed(b);
  const std::vector<double> stations = roller ? std::vector<double>{0.0} : some_of(contacts);
  std::vector<double> y = sampling::lateral_nodes(*b.surface, b.body, stations, kFirst, -kFarthest, kFarthest);
  std::vector<double> height(y.size(), -std::numeric_limits<double>::infinity()), h(y.size());
  for (const double u : stations) {
    section_heights(*b.surface, b.body, u, y, {h, {}, {}});
    for (std::size_t i = 0; i < y.size(); ++i) height[i] = std::fmax(height[i], outward(b) * h[i]);
  }
  // From the flange or gauge corner to the field side, without faces that stand far behind.
  const double top = b.body == Body::wheel ? b.radius : *std::max_element(height.begin(), height.end());
  const auto near = [&](std::size_t i) { return height[i] >= top - kDeep; };
  std::size_t first = 0, last = y.size() - 1;
  while (first < last && !near(first)) ++first;
  while (last > first && !near(last)) --last;
  if (last - first < 3) throw Error(ErrorKind::configuration, "the surface is too narrow to be sampled");
  const double spacing = kFirst * static_cast<double>(last - first) / (kAcross - 1);
  return sampling::lateral_nodes(*b.surface, b.body, stations, spacing, y[first], y[last]);
}

/// Middle of the values, each counting by its weight, interpolated between the two nearest; values may be NaN.
double weighted_median(std::vector<std::pair<double, double>>& value_weight) {
  std::erase_if(value_weight, [](const auto& v) { return std::isnan(v.first); });
  if (value_weight.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(value_weight.begin(), value_weight.end());
  const auto add = [](double sum, const auto& v) { return sum + v.second; };
  const double half = 0.5 * std::accumulate(value_weight.begin(), value_weight.end(), 0.0, add);
  double sum = 0.0, place = -1.0, value = value_weight.front().first;
  for (const auto& [next, weight] : value_weight) {
    const double next_place = sum + 0.5 * weight;
    if (next_place >= half) return place < 0.0 ? next : value + (next - value) * (half - place) / (next_place - place);
    sum += weight;
    place = next_place;
    value = next;
  }
  return value;
}

std::vector<double> weights_of(const std::vector<double>& u, bool closed) {
  const std::size_t n = u.size();
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i > 0 ? u[i] - u[i - 1] : closed ? u[0] + 2.0 * kPi - u[n - 1] : 0.0;
    const double after = i + 1 < n ? u[i + 1] - u[i] : closed ? u[0] + 2.0 * kPi - u[n - 1] : 0.0;
    out[i] = 0.5 * (before + after);
  }
  return out;
}

/// Deviations of heights h of stations u at nodes y; empty where they say nothing.
std::vector<double> deviations(const UsedBody& b, const std::vector<double>& u, const std::vector<double>& y,
                               const std::vector<double>& h) {
  if (b.constant || b.radius < 0.0) return {};
  const std::size_t ny = y.size();
  const std::vector<double> weights = weights_of(u, is_closed(b));
  std::vector<double> mean(ny), out(h.size());
  parallel_for(ny, [&](std::size_t k) {
    std::vector<std::pair<double, double>> column;
    column.reserve(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) column.emplace_back(h[i * ny + k], weights[i]);
    mean[k] = weighted_median(column);
  });
  double largest = 0.0;
  for (std::size_t k = 0; k < ny; ++k) {
    const std::size_t left = k > 0 && !std::isnan(mean[k - 1]) ? k - 1 : k,
                      right = k + 1 < ny && !std::isnan(mean[k + 1]) ? k + 1 : k;
    const double slope = right > left ? (mean[right] - mean[left]) / (y[right] - y[left]) : 0.0;
    const double factor = outward(b) / std::hypot(1.0, slope);
    for (std::size_t i = 0; i < u.size(); ++i) {
      out[i * ny + k] = factor * (h[i * ny + k] - mean[k]);
      largest = std::fmax(largest, std::fabs(out[i * ny + k]));
    }
  }
  if (largest < kRounding || (b.body == Body::rail && largest > kCrossing)) return {};
  return out;
}

double rounded(double value, int exponent) {
  return std::ldexp(std::nearbyint(std::ldexp(value, exponent)), -exponent) + 0.0;
}

bool is_empty(std::span<const double> heights) {
  return std::all_of(heights.begin(), heights.end(), [](double h) { return std::isnan(h); });
}

}  // namespace

double station_of(const UsedBody& b, const Vec3& p) {
  if (!is_closed(b)) return p.x();
  return b.body == Body::wheel ? std::atan2(p.x(), p.z()) : std::atan2(p.x(), b.radius - p.z());
}

io::SampledSurface sample_body(const UsedBody& b, const std::vector<double>& contacts) {
  const std::vector<double> y = nodes_across(b, contacts);
  const std::size_t ny = y.size();
  const double most = std::max(2.0, kMostPoints / static_cast<double>(ny)),
               many = kManyPoints / static_cast<double>(ny);
  std::vector<double> u =
      is_closed(b) ? round_stations(b.radius, contacts, most) : rail_stations(b.constant, contacts, most, many);
  std::vector<Vec2> points(ny);
  for (std::size_t k = 0; k < ny; ++k) points[k] = {0.0, y[k]};
  std::vector<double> h(u.size() * ny);
  parallel_for(u.size(), [&](std::size_t i) {
    const std::span<double> station = std::span(h).subspan(i * ny, ny);
    const Pose plane = plane_of(b, u[i]);
    if (has_station(b, u[i]))
      b.surface->heights_at(plane, points, {station, {}, {}});
    else
      std::fill(station.begin(), station.end(), std::numeric_limits<double>::quiet_NaN());
    if (b.beyond && is_empty(station)) b.beyond->heights_at(plane, points, {station, {}, {}});
  });
  if (!is_closed(b)) {  // a rail may end within the range
    std::size_t first = 0, last = u.size();
    while (first < last && is_empty(std::span(h).subspan(first * ny, ny))) ++first;
    while (last > first && is_empty(std::span(h).subspan((last - 1) * ny, ny))) --last;
    if (first == last) throw Error(ErrorKind::configuration, "there is no surface at the contacts");
    u = {u.begin() + static_cast<std::ptrdiff_t>(first), u.begin() + static_cast<std::ptrdiff_t>(last)};
    h = {h.begin() + static_cast<std::ptrdiff_t>(first * ny), h.begin() + static_cast<std::ptrdiff_t>(last * ny)};
  }

  constexpr int kPlaces = 30, kDeviations = 33;  // powers of 1/2 [m]
  io::SampledSurface out;
  out.body = body_name(b.body);
  out.nu = static_cast<int>(u.size());
  out.nv = static_cast<int>(ny);
  out.closed = is_closed(b);
  out.deviation = deviations(b, u, y, h);
  for (auto* list : {&out.x, &out.y, &out.z}) list->resize(h.size());
  constexpr std::size_t kStations = 16;  // of a task
  parallel_blocks(u.size(), kStations, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const Pose plane = plane_of(b, u[i]);
      for (std::size_t k = i * ny; k < (i + 1) * ny; ++k) {
        const Vec3 p = plane.apply({0.0, y[k - i * ny], h[k]});
        const bool missing = std::isnan(h[k]);
        out.x[k] = missing ? h[k] : rounded(p.x(), kPlaces);
        out.y[k] = missing ? h[k] : rounded(p.y(), kPlaces);
        out.z[k] = missing ? h[k] : rounded(p.z(), kPlaces);
        if (!out.deviation.empty()) out.deviation[k] = rounded(out.deviation[k], kDeviations);
      }
    }
  });
  out.u = std::move(u);
  return out;
}

}  // namespace treadmark::app
