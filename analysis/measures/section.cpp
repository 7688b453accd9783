// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/roots.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::measures {
namespace {

/// Unit tangent at the middle of three points, of the parabola over the chord length.
Vec2 parabola_tangent(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double h = (b - a).norm(), k = (c - b).norm();
  return ((b - a) * (k / h) + (c - b) * (h / k)).normalized();
}

}  // namespace

double Section::Place::angle() const { return std::atan2(tangent.y(), tangent.x()); }

Section::Section(const Profile& points, double noise) : body_(points.body) {
  Profile curve;
  curve.body = points.body;
  for (std::size_t i = 0; i < points.y.size(); ++i) {
    if (i > 0 && std::hypot(points.y[i] - curve.y.back(), points.z[i] - curve.z.back()) <= 1e-9) continue;
    curve.y.push_back(points.y[i]);
    curve.z.push_back(points.z[i]);
  }
  const std::size_t n = curve.y.size();
  constexpr std::size_t kFewest = 8;
  if (n < kFewest)
    throw Error(ErrorKind::input_data, "a section of so few points cannot be measured: " + std::to_string(n),
                {points.name, 0, 0});
  std::vector<double> errors;
  noise_ = std::max(0.0, noise);
  if (noise < 0.0) {
    curve = measured::smoothed_by_noise(std::move(curve));
    if (curve.scatter) errors = measured::deviations(*curve.scatter), noise_ = curve.scatter->white;
  }
  errors.resize(n, errors.empty() ? noise_ : 0.0);
  nodes_.resize(n);
  const bool backwards = curve.y.back() < curve.y.front();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = backwards ? n - 1 - i : i;
    nodes_[i] = {Vec2(curve.y[k], curve.z[k]), Vec2::UnitX(), errors[k]};
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t m = std::clamp<std::size_t>(i, 1, n - 2);
    Vec2& tangent = nodes_[i].tangent;
    tangent = parabola_tangent(nodes_[m - 1].p, nodes_[m].p, nodes_[m + 1].p);
    if (m == i) continue;  // the parabola's end
    const Vec2 chord = (i < m ? nodes_[m].p - nodes_[i].p : nodes_[i].p - nodes_[m].p).normalized();
    tangent = (2.0 * chord.dot(tangent) * chord - tangent).normalized();
  }
  find_extent();
}

void Section::find_extent() {
  y_min_ = z_min_ = std::numeric_limits<double>::infinity();
  y_max_ = z_max_ = -y_min_;
  for (const Node& n : nodes_) {
    y_min_ = std::min(y_min_, n.p.x());
    y_max_ = std::max(y_max_, n.p.x());
    z_min_ = std::min(z_min_, n.p.y());
    z_max_ = std::max(z_max_, n.p.y());
  }
}

Section::Place Section::at(std::size_t node, double t) const {
  if (node + 1 >= nodes_.size())
    return {nodes_.size() - 1, 0.0, nodes_.back().p, nodes_.back().tangent, nodes_.back().error};
  const Node &a = nodes_[node], &b = nodes_[node + 1];
  const double h = (b.p - a.p).norm(), u = 1.0 - t;
  Place place;
  place.node = node;
  place.t = t;
  place.p = (1.0 + 2.0 * t) * u * u * a.p + t * u * u * h * a.tangent + t * t * (3.0 - 2.0 * t) * b.p -
            t * t * u * h * b.tangent;
  const Vec2 d = 6.0 * t * u * (b.p - a.p) + h * (u * (1.0 - 3.0 * t) * a.tangent + t * (3.0 * t - 2.0) * b.tangent);
  place.tangent = d.norm() > 0.0 ? Vec2(d.normalized()) : a.tangent;
  place.error = u * a.error + t * b.error;
  return place;
}

std::vector<Section::Place> Section::crossings(const Vec2& normal, double offset) const {
  std::vector<Place> found;
  double before = normal.dot(nodes_.front().p) - offset;
  if (before == 0.0) found.push_back(at(0, 0.0));
  for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
    const double after = normal.dot(nodes_[i + 1].p) - offset;
    if (after == 0.0) {
      found.push_back(at(i + 1, 0.0));
    } else if ((before < 0.0) != (after < 0.0) && before != 0.0) {
      constexpr int kHalvings = 45;
      const auto side = [&](double t) { return (normal.dot(at(i, t).p) - offset < 0.0) == (before < 0.0); };
      found.push_back(at(i, bisect(0.0, 1.0, side, kHalvings).middle()));
    }
    before = after;
  }
  return found;
}

std::optional<Section::Place> Section::first_at_y(double y) const {
  const auto all = crossings(Vec2::UnitX(), y);
  if (all.empty()) return std::nullopt;
  return all.front();
}

double Section::z_at(double y) const {
  double z = kUnknown;
  for (const Place& place : crossings(Vec2::UnitX(), y))
    if (!(z == z) || (body_ == Body::rail ? place.p.y() < z : place.p.y() > z)) z = place.p.y();
  return z;
}

template <class Better>
std::vector<double> Section::over(int axis, double first, double step, std::size_t count, const Better& better) const {
  std::vector<double> out(count, kUnknown);
  for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
    const double a = nodes_[i].p[axis], b = nodes_[i + 1].p[axis];
    const double from = std::max(0.0, std::ceil((std::min(a, b) - first) / step)),
                 to = std::min(static_cast<double>(count) - 1.0, std::floor((std::max(a, b) - first) / step));
    for (double k = from; k <= to; k += 1.0) {
      const double wanted = first + step * k;
      double low = 0.0, high = 1.0, f_low = a - wanted, f_high = b - wanted, t = 0.0;
      for (int round = 0; round < 30; ++round) {  // regula falsi, Illinois
        t = f_high == f_low ? low : low - f_low * (high - low) / (f_high - f_low);
        const double f = at(i, t).p[axis] - wanted;
        if (std::fabs(f) < 1e-12) break;
        if ((f < 0.0) == (f_high < 0.0)) {
          high = t, f_high = f, f_low *= 0.5;
        } else {
          low = t, f_low = f, f_high *= 0.5;
        }
      }
      double& kept = out[static_cast<std::size_t>(k)];
      const double value = at(i, t).p[1 - axis];
      if (better(value, kept)) kept = value;
    }
  }
  return out;
}

std::vector<double> Section::z_over(double first, double step, std::size_t count) const {
  const bool rail = body_ == Body::rail;
  return over(0, first, step, count,
              [rail](double z, double kept) { return std::isnan(kept) || (rail ? z < kept : z > kept); });
}

std::vector<double> Section::y_over(double first, double step, std::size_t count, int side) const {
  return over(1, first, step, count,
              [side](double y, double kept) { return y * side > 0.0 && (std::isnan(kept) || y * side > kept * side); });
}

Section::Place Section::farthest(const Vec2& direction, std::size_t from, std::size_t to) const {
  std::size_t best = from;
  for (std::size_t i = from; i <= to && i < nodes_.size(); ++i)
    if (direction.dot(nodes_[i].p) > direction.dot(nodes_[best].p)) best = i;
  Place place = at(best, 0.0);
  for (const std::size_t start : {best == 0 ? best : best - 1, best}) {
    if (start < from || start + 1 > to || start + 1 >= nodes_.size()) continue;
    double low = 0.0, high = 1.0;  // golden section
    constexpr double kGolden = 0.6180339887498949;
    for (int step = 0; step < 50; ++step) {
      const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
      (direction.dot(at(start, a).p) > direction.dot(at(start, b).p) ? high : low) =
          direction.dot(at(start, a).p) > direction.dot(at(start, b).p) ? b : a;
    }
    const Place inner = at(start, 0.5 * (low + high));
    if (direction.dot(inner.p) > direction.dot(place.p)) place = inner;
  }
  return place;
}

void Section::move(double turn, const Vec2& shift) {
  const double c = std::cos(turn), s = std::sin(turn);
  for (Node& n : nodes_) {
    n.p = Vec2(c * n.p.x() - s * n.p.y(), s * n.p.x() + c * n.p.y()) + shift;
    n.tangent = Vec2(c * n.tangent.x() - s * n.tangent.y(), s * n.tangent.x() + c * n.tangent.y());
  }
  find_extent();
}

void Section::claim_error(double error) {
  claimed_ = error;
  for (Node& n : nodes_) n.error = error;
}

double Section::scatter(std::size_t count, double length) const {
  constexpr double kShared = 4e-3;  // [m] as long as the knots of fits that tell errors
  if (!claimed_) return noise_;
  return *claimed_ * std::sqrt(static_cast<double>(count) / std::max(1.0, length / kShared));
}

Section Section::mirrored() const {
  Section out = *this;
  std::reverse(out.nodes_.begin(), out.nodes_.end());
  for (Node& n : out.nodes_) {
    n.p.x() *= -1.0;
    n.tangent.y() *= -1.0;
  }
  out.find_extent();
  return out;
}

Profile section_points(const Surface& surface, Body body, double nominal_radius, double u, double step) {
  constexpr double kFarthest = 0.18;  // [m] half of the widest section
  constexpr double kTilt = std::numbers::pi / 3.0;
  const double steepest = std::tan(0.5 * kTilt);
  const Pose section = natural_plane(body, u);
  const double origin = body == Body::wheel ? nominal_radius : 0.0;
  struct Seen {
    Vec2 p;
    double angle;  // of the outline, from the field of view
  };
  std::vector<Seen> all;
  const auto n = to_whole<std::size_t>(2.0 * kFarthest / step) + 1;
  for (const double tilt : {-kTilt, 0.0, kTilt}) {
    const Pose view = section * Pose{Vec3(0.0, 0.0, origin), rotation_x(tilt)};
    std::vector<Vec2> across(n);
    for (std::size_t i = 0; i < n; ++i) across[i] = {0.0, -kFarthest + step * static_cast<double>(i)};
    std::vector<double> z(n), slope(n);
    HeightsOut out;
    out.z = z;
    out.dzdy = slope;
    surface.heights_at(view, across, out);
    const double c = std::cos(tilt), s = std::sin(tilt);
    for (std::size_t i = 0; i < n; ++i) {
      if (!(std::fabs(slope[i]) <= steepest) || std::isnan(z[i])) continue;
      const double y = across[i].y();
      all.push_back({Vec2(c * y - s * z[i], s * y + c * z[i]), tilt + std::atan(slope[i])});
    }
  }
  // Along a wheel's or rail's outline the three fields of view follow each other in parts: neighbours are joined by
  // walking from the one with the least y to the nearest that is left.
  Profile points;
  points.body = body;
  if (all.size() < 8) throw Error(ErrorKind::input_data, "there is no section to measure here");
  std::sort(all.begin(), all.end(), [](const Seen& a, const Seen& b) { return a.p.x() < b.p.x(); });
  // The start: among those near the least y the one farthest from the rest of the outline.
  std::size_t start = 0;
  for (std::size_t i = 0; i < all.size() && all[i].p.x() < all.front().p.x() + 0.5e-3; ++i)
    if (body == Body::rail ? all[i].p.y() > all[start].p.y() : all[i].p.y() < all[start].p.y()) start = i;
  std::vector<char> used(all.size(), 0);
  constexpr double kJump = 8e-3;  // [m] gaps up to this are walked over
  std::size_t at = start;
  while (true) {
    used[at] = 1;
    points.y.push_back(all[at].p.x());
    points.z.push_back(all[at].p.y());
    std::size_t next = all.size();
    double nearest = kJump;
    const auto look = [&](std::size_t i) {
      const double d = (all[i].p - all[at].p).norm();
      if (used[i] == 0 && d < nearest) nearest = d, next = i;
    };
    for (std::size_t i = at + 1; i < all.size() && all[i].p.x() - all[at].p.x() < nearest; ++i) look(i);
    for (std::size_t i = at; i > 0 && all[at].p.x() - all[i - 1].p.x() < nearest; --i) look(i - 1);
    if (next == all.size()) break;
    if (nearest < 0.2 * step) {  // where fields of view overlap
      used[next] = 1;
      continue;
    }
    at = next;
  }
  return points;
}

}  // namespace treadmark::measures
