// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/sections/find_sections.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/parallel_sort.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kFewestSections = 4, kFewestPoints = 8;
constexpr double kApart = 20.0;      // gaps between sections over those within
constexpr double kWidestStep = 6.0;  // between neighbours of a section, over the usual step
constexpr double kSamePlace = 0.05;  // of the usual step: sections with points at the same places across

/// The gap from which on stations belong to different sections; 0: they are in none.
double gap_between_sections(const std::vector<double>& station) {
  std::vector<double> gaps(station.size() - 1);
  for (std::size_t i = 0; i + 1 < station.size(); ++i) gaps[i] = station[i + 1] - station[i];
  std::sort(gaps.begin(), gaps.end(), std::greater<>());
  // the jump from gaps between sections to those within; a few wide gaps alone are holes
  const std::size_t most = std::min(gaps.size() - 1, station.size() / kFewestPoints);
  double best = kApart, out = 0.0;
  for (std::size_t k = kFewestSections - 2; k < most; ++k) {
    constexpr double kNothing = 1e-12;
    const double ratio = gaps[k] / std::max(gaps[k + 1], kNothing);
    if (ratio > best) {
      best = ratio;
      out = gaps[k];
    }
  }
  return out;
}

double run_through(const std::vector<std::uint32_t>& order, const std::vector<Natural>& at, double& longest) {
  double length = 0.0;
  longest = 0.0;
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    const double step = std::hypot(at[order[k + 1]].y - at[order[k]].y, at[order[k + 1]].v - at[order[k]].v);
    longest = std::max(longest, step);
    length += step;
  }
  return length;
}

/// From end to end: as the file has them if that is a way without jumps, else from the field or gauge end to the
/// nearest one not yet met.
bool put_in_order(std::vector<std::uint32_t>& section, const std::vector<Natural>& at) {
  std::sort(section.begin(), section.end());
  const auto smooth = [&](const std::vector<std::uint32_t>& order) {
    double longest = 0.0;
    const double length = run_through(order, at, longest);
    return longest <= kWidestStep * length / static_cast<double>(order.size() - 1);
  };
  double low_y = at[section.front()].y, high_y = low_y, low_v = at[section.front()].v, high_v = low_v, longest = 0.0;
  for (const std::uint32_t i : section) {
    low_y = std::min(low_y, at[i].y);
    high_y = std::max(high_y, at[i].y);
    low_v = std::min(low_v, at[i].v);
    high_v = std::max(high_v, at[i].v);
  }
  constexpr double kWinding = 3.0;        // length of a section at most, over how far its ends are apart
  constexpr std::size_t kFewToSort = 64;  // any order of these may be short
  if (section.size() >= kFewToSort &&
      run_through(section, at, longest) <= kWinding * std::hypot(high_y - low_y, high_v - low_v) && smooth(section))
    return true;
  std::vector<std::uint32_t> left = section, order;
  auto next =
      std::max_element(left.begin(), left.end(), [&](std::uint32_t a, std::uint32_t b) { return at[a].y < at[b].y; });
  while (true) {
    order.push_back(*next);
    *next = left.back();
    left.pop_back();
    if (left.empty()) break;
    const Natural& here = at[order.back()];
    next = std::min_element(left.begin(), left.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::hypot(at[a].y - here.y, at[a].v - here.v) < std::hypot(at[b].y - here.y, at[b].v - here.v);
    });
  }
  section = std::move(order);
  return smooth(section);
}

bool same_places(const MeasuredSections& found, const std::vector<Natural>& at) {
  const auto& first = found.points.front();
  std::vector<double> steps;
  for (std::size_t k = 0; k + 1 < first.size(); ++k) steps.push_back(std::fabs(at[first[k + 1]].y - at[first[k]].y));
  const double tolerance = kSamePlace * median_of(steps);
  for (const auto& section : found.points) {
    if (section.size() != first.size()) return false;
    for (std::size_t k = 0; k < first.size(); ++k)
      if (std::fabs(at[section[k]].y - at[first[k]].y) > tolerance) return false;
  }
  return true;
}

}  // namespace

std::optional<MeasuredSections> find_sections(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                              const Pose& X_CS, Body body, double radius) {
  const bool wheel = body == Body::wheel;
  const double scale = wheel ? radius : 1.0, turn = wheel ? 2.0 * std::numbers::pi * radius : 0.0;
  std::vector<Natural> at(points.size());
  constexpr std::size_t kBlock = 8192;
  parallel_blocks(points.size(), kBlock, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (!keep.empty() && keep[i] == 0) continue;
      at[i] = natural(body, X_CS.apply_inverse(points[i]));
      at[i].u *= scale;
    }
  });
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (keep.empty() || keep[i] != 0) order.push_back(static_cast<std::uint32_t>(i));
  if (order.size() < kFewestSections * kFewestPoints) return std::nullopt;
  parallel_sort(order, [&](std::uint32_t a, std::uint32_t b) { return at[a].u < at[b].u; });
  if (wheel) {
    // begin behind the widest gap, so that no section is cut at the half turn
    std::size_t begin = 0;
    double widest = at[order.front()].u + turn - at[order.back()].u;
    for (std::size_t k = 1; k < order.size(); ++k) {
      const double gap = at[order[k]].u - at[order[k - 1]].u;
      if (gap <= widest) continue;
      widest = gap;
      begin = k;
    }
    for (std::size_t k = 0; k < begin; ++k) at[order[k]].u += turn;
    std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(begin), order.end());
  }
  std::vector<double> station(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) station[k] = at[order[k]].u;
  const double apart = gap_between_sections(station);
  if (apart <= 0.0) return std::nullopt;

  MeasuredSections out;
  std::vector<double> width;
  for (std::size_t k = 0; k < order.size();) {
    std::size_t end = k + 1;
    while (end < order.size() && station[end] - station[end - 1] < apart) ++end;
    if (end - k < kFewestPoints) return std::nullopt;
    double mean = 0.0;
    for (std::size_t i = k; i < end; ++i) mean += station[i] - station[k];
    mean = station[k] + mean / static_cast<double>(end - k);
    out.spread = std::max({out.spread, mean - station[k], station[end - 1] - mean});
    out.u.push_back(mean);
    out.points.emplace_back(order.begin() + static_cast<std::ptrdiff_t>(k),
                            order.begin() + static_cast<std::ptrdiff_t>(end));
    k = end;
  }
  if (out.u.size() < kFewestSections) return std::nullopt;
  out.least_gap = out.u[1] - out.u[0];
  for (std::size_t k = 0; k + 1 < out.u.size(); ++k) {
    out.least_gap = std::min(out.least_gap, out.u[k + 1] - out.u[k]);
    out.widest_gap = std::max(out.widest_gap, out.u[k + 1] - out.u[k]);
  }
  if (kApart * out.spread > out.least_gap) return std::nullopt;
  for (auto& section : out.points) {
    if (!put_in_order(section, at)) return std::nullopt;
    const bool rising = at[section.back()].y > at[section.front()].y;
    if (rising == wheel) std::reverse(section.begin(), section.end());
  }
  out.regular = same_places(out, at);
  for (double& u : out.u) u /= scale;
  return out;
}

SliceSet sections_to_slices(const MeasuredSections& sections, std::span<const Vec3> points, const Pose& X_CS, Body body,
                            double nominal_radius, bool approximate_u, const std::string& name) {
  std::vector<std::size_t> order(sections.u.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto u_of = [&](std::size_t k) { return body == Body::wheel ? wrap_angle(sections.u[k]) : sections.u[k]; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return u_of(a) < u_of(b); });
  SliceSet out;
  out.body = body;
  out.name = name;
  out.approximate_u = approximate_u;
  for (const std::size_t k : order) {
    Profile profile;
    profile.body = body;
    profile.name = name;
    for (const std::uint32_t i : sections.points[k]) {
      const Natural n = natural(body, X_CS.apply_inverse(points[i]));
      profile.y.push_back(n.y);
      profile.z.push_back(body == Body::wheel ? n.v - nominal_radius : -n.v);
    }
    out.u.push_back(u_of(k));
    out.profiles.push_back(std::move(profile));
  }
  return out;
}

}  // namespace treadmark::scans
