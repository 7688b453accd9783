// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/spline/slices/slice_net.hpp"

#include <limits>
#include <string>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::spline {

SliceNet::SliceNet(std::vector<double> span_starts, double u_end, bool closed, int positions, Across across)
    : starts_(std::move(span_starts)),
      closed_(closed),
      across_(across),
      positions_(positions),
      stride_((static_cast<std::size_t>(positions) + 3) / 4 * 4 + 4) {
  cubics_.assign(starts_.size() * 8 * stride_, std::numeric_limits<double>::quiet_NaN());
  starts_.push_back(u_end);
}

SliceNet::LineValue SliceNet::line_at(const Place& place, int line_number) const {
  const LineCubic c = line(place.span, line_number);
  const NetPair* p = c.power;
  const double t = place.t;
  return {p[0] + t * (p[1] + t * (p[2] + t * p[3])), p[1] + t * (2.0 * p[2] + (3.0 * t) * p[3]),
          2.0 * p[2] + (6.0 * t) * p[3]};
}

// At a break the other line does not count, even where it is missing.
NetValue SliceNet::straight_at(const Place& place, int cell, double f) const {
  const LineValue a = line_at(place, cell + 1), b = line_at(place, cell + 2);
  const NetPair by_v = b.value - a.value;
  if (f == 0.0) return {a.value, a.by_u, by_v};
  if (f == 1.0) return {b.value, b.by_u, by_v};
  return {a.value + f * by_v, a.by_u + f * (b.by_u - a.by_u), by_v};
}

NetSecond SliceNet::second_at(const Place& place, int cell, double f) const {
  if (straight()) {
    const LineValue a = line_at(place, cell + 1), b = line_at(place, cell + 2);
    return {a.by_uu + f * (b.by_uu - a.by_uu), b.by_u - a.by_u, {}};
  }
  const double t = place.t, g = 1.0 - f;
  const double basis[4] = {g * g * g / 6.0, 2.0 / 3.0 - f * f * (1.0 - 0.5 * f), 2.0 / 3.0 - g * g * (1.0 - 0.5 * g),
                           f * f * f / 6.0};
  const double basis_v[4] = {-0.5 * g * g, f * (1.5 * f - 2.0), g * (2.0 - 1.5 * g), 0.5 * f * f};
  const double basis_vv[4] = {g, 3.0 * f - 2.0, 3.0 * g - 2.0, f};
  NetSecond sum;
  for (int k = 0; k < 4; ++k) {
    const LineCubic c = line(place.span, cell + k);
    const NetPair* p = c.power;
    sum.by_uu = sum.by_uu + basis[k] * (2.0 * p[2] + (6.0 * t) * p[3]);
    sum.by_uv = sum.by_uv + basis_v[k] * (p[1] + t * (2.0 * p[2] + (3.0 * t) * p[3]));
    sum.by_vv = sum.by_vv + basis_vv[k] * (p[0] + t * (p[1] + t * (p[2] + t * p[3])));
  }
  return sum;
}

SliceNet::Number SliceNet::number(std::size_t k) const {
  const auto count = static_cast<std::size_t>(lines());
  const int at = static_cast<int>(k / 2 / count), knot = at + (held_first_ ? 1 : 0);
  return {at, static_cast<int>(k / 2 % count), k % 2 == 1, starts_[static_cast<std::size_t>(knot)]};
}

SliceNet SliceNet::with_number(std::size_t k, double amount) const {
  SliceNet out = *this;
  const Number n = number(k);
  const auto add = [&](int span, const std::array<double, 4>& powers) {
    LineCubic cubic = out.line(span, n.line);
    for (std::size_t m = 0; m < powers.size(); ++m) cubic.power[m].w += amount * powers[m];
    out.set_line(span, n.line, cubic);
  };
  for (int span = 0; span < spans(); ++span) {
    if (held(span)) {
      if (!n.slope && station_beside(span) == n.station) add(span, {1.0, 0.0, 0.0, 0.0});
      continue;
    }
    const double h = span_end(span) - span_start(span), hh = h * h;
    if (station(span, false) == n.station)
      add(span, n.slope ? std::array{0.0, 1.0, -2.0 / h, 1.0 / hh} : std::array{1.0, 0.0, -3.0 / hh, 2.0 / (hh * h)});
    if (station(span, true) == n.station)
      add(span, n.slope ? std::array{0.0, 0.0, -1.0 / h, 1.0 / hh} : std::array{0.0, 0.0, 3.0 / hh, -2.0 / (hh * h)});
  }
  return out;
}

bool SliceNet::hull(int span, int cell, double u0, double u1, Interval& y, Interval& w) const {
  y = w = Interval::none();
  // The constant ends go on beyond their span.
  u0 = std::clamp(u0, span_start(span), span_end(span));
  const double h = std::clamp(u1, u0, span_end(span)) - u0, t = u0 - span_start(span);
  const auto include = [&](const NetPair& point) {
    if (!(point.y == point.y) || !(point.w == point.w)) return false;
    y.include({point.y, point.y});
    w.include({point.w, point.w});
    return true;
  };
  // In v the B-spline hull is loose by the sag of the control polygon, so go over to Bezier points in both directions.
  NetPair bezier_u[4][4];
  for (int k = straight() ? 1 : 0; k < (straight() ? 3 : 4); ++k) {
    const LineCubic c = line(span, cell + k);
    const NetPair* p = c.power;
    const NetPair c0 = p[0] + t * (p[1] + t * (p[2] + t * p[3]));
    const NetPair c1 = h * (p[1] + t * (2.0 * p[2] + (3.0 * t) * p[3]));
    const NetPair c2 = (h * h) * (p[2] + (3.0 * t) * p[3]), c3 = (h * h * h) * p[3];
    bezier_u[k][0] = c0;
    bezier_u[k][1] = c0 + (1.0 / 3.0) * c1;
    bezier_u[k][2] = c0 + (1.0 / 3.0) * (2.0 * c1 + c2);
    bezier_u[k][3] = c0 + c1 + c2 + c3;
  }
  for (int i = 0; i < 4; ++i) {
    if (straight()) {
      if (!include(bezier_u[1][i]) || !include(bezier_u[2][i])) return false;
      continue;
    }
    const NetPair c[4] = {bezier_u[0][i], bezier_u[1][i], bezier_u[2][i], bezier_u[3][i]};
    const NetPair points[4] = {(1.0 / 6.0) * (c[0] + 4.0 * c[1] + c[2]), (1.0 / 3.0) * (2.0 * c[1] + c[2]),
                               (1.0 / 3.0) * (c[1] + 2.0 * c[2]), (1.0 / 6.0) * (c[1] + 4.0 * c[2] + c[3])};
    for (const NetPair& point : points)
      if (!include(point)) return false;
  }
  return true;
}

std::vector<SliceSet> split_at_kinks(const SliceSet& slices) {
  if (slices.kinks.empty()) return {slices};
  const int last = slices.features.empty() ? 0 : static_cast<int>(slices.features.front().size()) - 1;
  std::vector<SliceSet> parts;
  int from = 0;
  const auto add_until = [&](int to) {
    SliceSet part = slices;
    part.kinks.clear();
    for (auto& row : part.features) {
      if (static_cast<int>(row.size()) != last + 1)
        throw Error(ErrorKind::input_data, "the slices of '" + slices.name + "' have different numbers of features");
      row = {row.begin() + from, row.begin() + to + 1};
    }
    parts.push_back(std::move(part));
    from = to;
  };
  for (const int kink : slices.kinks) {
    if (kink <= from || kink >= last)
      throw Error(ErrorKind::input_data, "the kinks of '" + slices.name + "' must be increasing inner features, " +
                                             std::to_string(kink) + " is not");
    add_until(kink);
  }
  add_until(last);
  return parts;
}

}  // namespace treadmark::spline
