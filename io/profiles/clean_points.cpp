// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/clean_points.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::io::profiles {
namespace {

double turning_angle(const RawPoints& p, std::size_t i) {
  const double y1 = p.y[i] - p.y[i - 1], z1 = p.z[i] - p.z[i - 1];
  const double y2 = p.y[i + 1] - p.y[i], z2 = p.z[i + 1] - p.z[i];
  return std::atan2(y1 * z2 - z1 * y2, y1 * y2 + z1 * z2);
}

/// Direction of the first change of z seen from an end towards the interior: +1 grows, -1 falls, 0 none.
template <class Iterator>
int first_change(Iterator begin, Iterator end, double threshold) {
  for (Iterator z = begin; z != end; ++z)
    if (std::abs(*z - *begin) > threshold) return *z > *begin ? 1 : -1;
  return 0;
}

}  // namespace

void remove_near_points(RawPoints& p, double distance) {
  if (p.size() == 0) return;
  std::size_t kept = 1;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (std::hypot(p.y[i] - p.y[kept - 1], p.z[i] - p.z[kept - 1]) < distance) continue;
    p.y[kept] = p.y[i];
    p.z[kept] = p.z[i];
    p.line[kept++] = p.line[i];
  }
  p.truncate(kept);
}

void remove_zigzags(RawPoints& p, double threshold) {
  if (p.size() < 4) return;
  // Angles are those of the points as they stand: the write position stays behind the points still needed.
  const std::size_t n = p.size();
  std::size_t kept = 1;
  double angle = turning_angle(p, 1);
  for (std::size_t i = 1; i < n; ++i) {
    double next = i + 2 < n ? turning_angle(p, i + 1) : 0.0;
    const bool zigzag = std::abs(angle) > threshold && std::abs(next) > threshold;
    p.line[kept] = p.line[i];
    p.y[kept] = zigzag ? 0.5 * (p.y[i] + p.y[i + 1]) : p.y[i];
    p.z[kept] = zigzag ? 0.5 * (p.z[i] + p.z[i + 1]) : p.z[i];
    ++kept;
    if (zigzag) {
      next = i + 3 < n ? turning_angle(p, i + 2) : 0.0;
      ++i;
    }
    angle = next;
  }
  p.truncate(kept);
}

void delete_outside_y(RawPoints& p, double min, double max) {
  if (!(min < max)) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.y[i] < min || p.y[i] > max) continue;
    p.y[kept] = p.y[i];
    p.z[kept] = p.z[i];
    p.line[kept++] = p.line[i];
  }
  p.truncate(kept);
}

void clip_z(RawPoints& p, double min, double max) {
  if (!(min < max)) return;
  for (double& z : p.z) z = std::clamp(z, min, max);
}

bool z_points_up(const RawPoints& p, Body body) {
  const std::size_t n = p.size();
  if (n < 2) return false;
  const auto [lowest, highest] = std::minmax_element(p.z.begin(), p.z.end());

  if (body == Body::rail) {
    const double threshold = 1e-3 * (*highest - *lowest);
    const auto share = static_cast<std::ptrdiff_t>(std::max<std::size_t>(2, n / 10));
    int change = first_change(p.z.begin(), p.z.begin() + share, threshold);
    if (change == 0) change = first_change(p.z.rbegin(), p.z.rbegin() + share, threshold);
    return change > 0;
  }

  const auto at_an_end = [&](auto position) {
    const auto index = static_cast<std::size_t>(position - p.z.begin());
    const std::size_t share = std::max<std::size_t>(1, n / 20);
    return index < share || index >= n - share;
  };
  if (at_an_end(lowest)) return false;
  if (at_an_end(highest)) return true;
  const std::size_t middle = n / 2;
  const double dy = p.y.back() - p.y.front();
  const double t = dy != 0.0 ? (p.y[middle] - p.y.front()) / dy : 0.5;
  return p.z[middle] < p.z.front() + t * (p.z.back() - p.z.front());
}

bool order_is_wrong(const RawPoints& p, Body body) {
  const std::size_t n = p.size();
  if (n < 2) return false;
  const double wanted = body == Body::rail ? 1.0 : -1.0;
  // at noisy points the direction at one place says little, that from end to end much
  const auto [low, high] = std::minmax_element(p.y.begin(), p.y.end());
  const double change = p.y.back() - p.y.front();
  constexpr double kMostOfIt = 0.5;
  if (std::fabs(change) > kMostOfIt * (*high - *low)) return wanted * change < 0.0;
  const auto extreme =
      body == Body::rail ? std::min_element(p.z.begin(), p.z.end()) : std::max_element(p.z.begin(), p.z.end());
  const auto i = static_cast<std::size_t>(extreme - p.z.begin());
  const double before = i > 0 ? p.y[i] - p.y[i - 1] : 0.0;
  const double after = i + 1 < n ? p.y[i + 1] - p.y[i] : 0.0;
  if (before * after < 0.0) {
    // Both bodies keep their material on the same hand: the right order turns by a positive angle at the extreme.
    const double angle = turning_angle(p, i);
    if (angle != 0.0) return angle < 0.0;
  }
  const double direction = before + after;
  if (direction != 0.0 && before * after >= 0.0) return wanted * direction < 0.0;
  return wanted * change < 0.0;
}

double total_length(const RawPoints& p) {
  double length = 0.0;
  for (std::size_t i = 1; i < p.size(); ++i) length += std::hypot(p.y[i] - p.y[i - 1], p.z[i] - p.z[i - 1]);
  return length;
}

}  // namespace treadmark::io::profiles
