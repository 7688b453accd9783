// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/virtual/station.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans::scanner {
namespace {

constexpr double kLeastPiece = 1e-8;   // [m] of y; what is still longer than wanted then is a jump, not a flank
constexpr double kEndAccuracy = 1e-8;  // [m] of y
constexpr std::size_t kLeastPieces = 256;
constexpr double kMostPieces = 1e7;

}  // namespace

void heights_along(const Surface& surface, Body body, double u, std::span<const double> y, const HeightsOut& out) {
  section_heights(surface, body, u, y, out);
  if (body == Body::wheel)
    for (double& r : out.z)
      if (r <= 0.0) r = std::numeric_limits<double>::quiet_NaN();
}

Vec3 normal_in_plane(Body body, double dzdx, double dzdy) {
  const double out = body == Body::wheel ? 1.0 : -1.0;
  if (std::isinf(dzdx)) return {-out * std::copysign(1.0, dzdx), 0.0, 0.0};
  if (std::isinf(dzdy)) return {0.0, -out * std::copysign(1.0, dzdy), 0.0};
  if (std::isnan(dzdx)) dzdx = 0.0;
  if (std::isnan(dzdy)) dzdy = 0.0;
  return Vec3(-out * dzdx, -out * dzdy, out).normalized();
}

Station::Station(const Surface& surface, Body body, double u, std::span<const double> raster, double longest) {
  add(surface, body, u, {raster.begin(), raster.end()});
  find_ends(surface, body, u);
  refine(surface, body, u, longest);
  arc_.assign(y_.size(), 0.0);
  for (std::size_t i = 1; i < y_.size(); ++i) {
    const double dy = y_[i] - y_[i - 1], l = std::hypot(dy, h_[i] - h_[i - 1]);
    arc_[i] = arc_[i - 1] + (std::isnan(l) ? 0.0 : l > longest && dy <= kLeastPiece ? dy : l);
  }
}

void Station::add(const Surface& surface, Body body, double u, std::vector<double> y) {
  if (y.empty()) return;
  std::vector<double> h(y.size());
  heights_along(surface, body, u, y, {h, {}, {}});
  if (y_.empty()) {
    y_ = std::move(y);
    h_ = std::move(h);
    return;
  }
  std::vector<double> all_y, all_h;
  all_y.reserve(y_.size() + y.size());
  all_h.reserve(y_.size() + y.size());
  for (std::size_t i = 0, j = 0; i < y_.size() || j < y.size();) {
    const bool old = j == y.size() || (i < y_.size() && y_[i] <= y[j]);
    const double next_y = old ? y_[i] : y[j], next_h = old ? h_[i++] : h[j++];
    if (!all_y.empty() && next_y == all_y.back()) continue;
    all_y.push_back(next_y);
    all_h.push_back(next_h);
  }
  y_ = std::move(all_y);
  h_ = std::move(all_h);
}

void Station::find_ends(const Surface& surface, Body body, double u) {
  std::vector<double> inside, outside;
  for (std::size_t i = 1; i < y_.size(); ++i)
    if (std::isnan(h_[i]) != std::isnan(h_[i - 1])) {
      const bool begins = std::isnan(h_[i - 1]);
      inside.push_back(y_[begins ? i : i - 1]);
      outside.push_back(y_[begins ? i - 1 : i]);
    }
  if (inside.empty()) return;
  double widest = 0.0;
  for (std::size_t i = 0; i < inside.size(); ++i) widest = std::max(widest, std::fabs(outside[i] - inside[i]));
  std::vector<double> middle(inside.size()), h(inside.size());
  for (; widest > kEndAccuracy; widest *= 0.5) {
    for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = 0.5 * (inside[i] + outside[i]);
    heights_along(surface, body, u, middle, {h, {}, {}});
    for (std::size_t i = 0; i < middle.size(); ++i) (std::isnan(h[i]) ? outside : inside)[i] = middle[i];
  }
  // both sides of an end, so that what lies beyond it counts as nothing
  inside.insert(inside.end(), outside.begin(), outside.end());
  std::sort(inside.begin(), inside.end());
  add(surface, body, u, std::move(inside));
}

void Station::refine(const Surface& surface, Body body, double u, double longest) {
  for (;;) {
    std::vector<double> extra;
    for (std::size_t i = 1; i < y_.size(); ++i)
      if (y_[i] - y_[i - 1] > kLeastPiece && std::hypot(y_[i] - y_[i - 1], h_[i] - h_[i - 1]) > longest)
        extra.push_back(0.5 * (y_[i] + y_[i - 1]));
    if (extra.empty()) return;
    add(surface, body, u, std::move(extra));
  }
}

double Station::y_at(double arc, std::size_t& piece) const {
  while (piece + 1 < arc_.size() && arc_[piece] < arc) ++piece;
  const double l = arc_[piece] - arc_[piece - 1];
  const double share = l > 0.0 ? std::clamp((arc - arc_[piece - 1]) / l, 0.0, 1.0) : 0.0;
  return y_[piece - 1] + share * (y_[piece] - y_[piece - 1]);
}

std::vector<double> raster(const Surface& surface, Body body, std::span<const double> stations, double low, double high,
                           double longest) {
  const double wanted = std::min((high - low) / longest, kMostPieces);
  const std::size_t n = std::max(kLeastPieces, to_whole<std::size_t>(std::ceil(wanted)));
  std::vector<double> y(n + 1);
  for (std::size_t i = 0; i <= n; ++i)
    y[i] = i == n ? high : low + (high - low) * static_cast<double>(i) / static_cast<double>(n);
  for (const double u : stations) y = Station(surface, body, u, y, longest).y();
  return y;
}

}  // namespace treadmark::scans::scanner
