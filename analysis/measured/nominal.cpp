// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/nominal.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include <Eigen/Dense>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measured {
namespace {

constexpr double kOutlineStep = 0.25e-3;  ///< [m]

struct Turned {
  double dy = 0.0, dz = 0.0, roll = 0.0;
};

struct RollFit {
  Turned place;
  double rms = kInfinity;
};

/// Points about a millimetre apart.
std::vector<Vec2> apart(const Profile& p) {
  constexpr double kApart = 1e-3;
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    const Vec2 q(p.y[i], p.z[i]);
    if (out.empty() || (q - out.back()).norm() >= kApart) out.push_back(q);
  }
  return out;
}

/// Middle and height of where a section begins to be looked at: the tip of a flange, the top of a head.
Vec2 mark_of(Body body, const std::vector<Vec2>& points) {
  const double sign = body == Body::wheel ? 1.0 : -1.0;
  double best = -kInfinity;
  for (const Vec2& p : points) best = std::max(best, sign * p.y());
  constexpr double kDeep = 12e-3;
  double low = kInfinity, high = -kInfinity, at = 0.0;
  for (const Vec2& p : points) {
    if (sign * p.y() == best) at = p.x();
    if (sign * p.y() > best - kDeep) low = std::min(low, p.x()), high = std::max(high, p.x());
  }
  return {body == Body::wheel ? at : 0.5 * (low + high), sign * best};
}

std::vector<Vec2> points_of(const NominalOutline& n) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < n.z.size(); ++i)
    if (!std::isnan(n.z[i])) out.emplace_back(n.first + n.step * static_cast<double>(i), n.z[i]);
  return out;
}

/// A point turned and then moved to (y, z) beside a nominal section, which has this height where its step begins.
struct Beside {
  Vec2 turned;
  double y, z, height, slope;
  double off;  ///< z from the outline
};

/// A function of points that places them; nothing of those beyond the outline.
auto placed(const NominalOutline& n, const Turned& place) {
  return [&n, place, c = std::cos(place.roll), s = std::sin(place.roll)](const Vec2& p) -> std::optional<Beside> {
    const Vec2 turned(c * p.x() - s * p.y(), s * p.x() + c * p.y());
    const double y = turned.x() + place.dy, z = turned.y() + place.dz, t = (y - n.first) / n.step;
    if (!(t >= 0.0) || t + 1.0 >= static_cast<double>(n.z.size())) return std::nullopt;
    const auto i = to_whole<std::size_t>(t);
    const double slope = (n.z[i + 1] - n.z[i]) / n.step;
    if (std::isnan(slope)) return std::nullopt;
    return Beside{turned, y, z, n.z[i], slope, z - n.z[i] - slope * (y - n.first - n.step * static_cast<double>(i))};
  };
}

/// Gauss-Newton on the better six tenths of the points.
RollFit fitted_to(const std::vector<Vec2>& points, const NominalOutline& n, Turned place, double most_roll) {
  constexpr int kSteps = 12;
  constexpr double kKept = 0.6, kInRange = 0.7;
  constexpr double kSettled = 1e-9;  // [m], [rad]
  RollFit out;
  struct Residual {
    double r, by_y, by_z, by_roll;
  };
  std::vector<Residual> rows;
  for (int step = 0; step <= kSteps; ++step) {
    rows.clear();
    const auto beside = placed(n, place);
    for (const Vec2& p : points)
      if (const auto at = beside(p)) {
        const double across = 1.0 / std::sqrt(1.0 + at->slope * at->slope);
        rows.push_back(
            {across * at->off, -across * at->slope, across, across * (at->turned.x() + at->slope * at->turned.y())});
      }
    if (static_cast<double>(rows.size()) < kInRange * static_cast<double>(points.size())) return out;
    const auto kept = to_whole<std::ptrdiff_t>(kKept * static_cast<double>(rows.size()));
    std::nth_element(rows.begin(), rows.begin() + kept, rows.end(),
                     [](const Residual& a, const Residual& b) { return std::fabs(a.r) < std::fabs(b.r); });
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double squares = 0.0;
    for (auto row = rows.begin(); row != rows.begin() + kept; ++row) {
      const Eigen::Vector3d g(row->by_y, row->by_z, row->by_roll);
      normal += g * g.transpose();
      right -= g * row->r;
      squares += row->r * row->r;
    }
    const double rms = std::sqrt(squares / static_cast<double>(kept));
    if (rms < out.rms) out = {place, rms};
    normal.diagonal() += Eigen::Vector3d(1e-9, 1e-9, 1e-12) * static_cast<double>(kept);
    const Eigen::Vector3d d = normal.ldlt().solve(right);
    if (!d.allFinite()) return out;
    const double roll = std::clamp(place.roll + d[2], -most_roll, most_roll);
    if (std::max({std::fabs(d[0]), std::fabs(d[1]), std::fabs(roll - place.roll)}) < kSettled) return out;
    place = {place.dy + d[0], place.dz + d[1], roll};
  }
  return out;
}

/// Rolled by this, with its mark then upon that of the nominal section: the top of a rolled head is another point of
/// it.
Turned start_at(const std::vector<Vec2>& points, Body body, const Vec2& nominal_mark, double roll) {
  const Eigen::Rotation2Dd by(roll);
  std::vector<Vec2> rolled;
  for (const Vec2& p : points) rolled.emplace_back(by * p);
  const Vec2 shift = nominal_mark - mark_of(body, rolled);
  return {shift.x(), shift.y(), roll};
}

/// Mean distance inside the nominal section on one flank (side -1: small y).
double lost_on(const std::vector<Vec2>& points, const NominalOutline& n, const Turned& place, double side) {
  constexpr double kFrom = 4e-3, kTo = 13e-3;
  double top = kInfinity, sum = 0.0, count = 0.0;
  for (const double z : n.z)
    if (z < top) top = z;
  const auto beside = placed(n, place);
  for (const Vec2& p : points) {
    const auto at = beside(p);
    if (!at || !(side * at->y > 0.0) || !(at->height - top > kFrom && at->height - top < kTo)) continue;
    sum += (at->z - at->height) / std::sqrt(1.0 + at->slope * at->slope);
    count += 1.0;
  }
  return count > 2.0 ? sum / count : kNaN;
}

/// Of the flange: a tread alone may be that of another cone.
double flange_rms(const std::vector<Vec2>& points, const NominalOutline& n, const Turned& place) {
  constexpr double kBelowTread = 8e-3;
  std::vector<double> squares;
  const auto beside = placed(n, place);
  for (const Vec2& p : points)
    if (const auto at = beside(p); at && at->z > kBelowTread)
      squares.push_back(at->off * at->off / (1.0 + at->slope * at->slope));
  const auto half = static_cast<std::ptrdiff_t>(squares.size() / 2);
  if (half < 3) return kInfinity;
  std::nth_element(squares.begin(), squares.begin() + half, squares.end());
  return std::sqrt(std::accumulate(squares.begin(), squares.begin() + half, 0.0) / static_cast<double>(half));
}

/// Of a section with two rims the points of the wider one, which is the head; none of any other section.
std::vector<Vec2> head_beside_groove(const std::vector<Vec2>& points) {
  constexpr double kRim = 3e-3;
  double top = kInfinity, bottom = -kInfinity;
  for (const Vec2& p : points) top = std::min(top, p.y()), bottom = std::max(bottom, p.y());
  const double half_deep = 0.5 * (bottom - top);  // the keeper of a rolled rail may lie deep
  std::vector<Vec2> head, run;
  int rims = 0;
  const auto width = [](const std::vector<Vec2>& r) { return r.empty() ? 0.0 : std::fabs(r.back().x() - r[0].x()); };
  const auto close = [&] {
    if (width(run) > kRim) ++rims;
    if (width(run) > width(head)) head = run;
    run.clear();
  };
  for (const Vec2& p : points)
    if (p.y() - top < half_deep)
      run.push_back(p);
    else
      close();
  close();
  return rims > 1 ? head : std::vector<Vec2>{};
}

std::optional<Lean> lean_of_points(std::vector<Vec2> points, Body body, std::span<const NominalOutline> nominals) {
  constexpr std::size_t kFewest = 20;
  constexpr int kStarts = 8;                         // to each side
  constexpr double kApart = 0.025, kMostRoll = 0.5;  // [rad]: flat heads and worn sides hold the fit where it is
  if (points.size() < kFewest) return std::nullopt;
  // about the mark: a roll about a far origin would shift the points out of reach of the fit
  const Vec2 middle = mark_of(body, points);
  for (Vec2& p : points) p -= middle;
  Lean out;
  out.residual = out.upright = kInfinity;
  for (const NominalOutline& n : nominals) {
    const std::vector<Vec2> outline = points_of(n);
    if (outline.empty()) continue;
    const Vec2 nominal_mark = mark_of(body, outline);
    out.upright = std::min(out.upright, fitted_to(points, n, start_at(points, body, nominal_mark, 0.0), kLevel).rms);
    for (int k = -kStarts; k <= kStarts; ++k)
      if (const RollFit fit = fitted_to(points, n, start_at(points, body, nominal_mark, k * kApart), kMostRoll);
          fit.rms < out.residual) {
        out.name = n.name, out.residual = fit.rms, out.roll = -fit.place.roll,
        out.shift_y = fit.place.dy - (std::cos(fit.place.roll) * middle.x() - std::sin(fit.place.roll) * middle.y());
        out.flange = flange_rms(points, n, fit.place);
        out.lost_low = lost_on(points, n, fit.place, -1.0), out.lost_high = lost_on(points, n, fit.place, 1.0);
      }
  }
  if (!(out.upright < kInfinity) && !(out.residual < kInfinity)) return std::nullopt;
  return out;
}

}  // namespace

NominalOutline nominal_outline(std::string name, Body body, std::span<const Vec2> outline) {
  NominalOutline out;
  out.name = std::move(name);
  out.step = kOutlineStep;
  if (outline.size() < 2) return out;
  const auto [low, high] =
      std::minmax_element(outline.begin(), outline.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  out.first = low->x();
  out.z.assign(to_whole<std::size_t>((high->x() - low->x()) / out.step) + 1, kNaN);
  const double sign = body == Body::wheel ? 1.0 : -1.0;
  for (std::size_t i = 1; i < outline.size(); ++i) {
    Vec2 a = outline[i - 1], b = outline[i];
    if (a.x() > b.x()) std::swap(a, b);
    if (!(b.x() > a.x())) continue;
    const double last = static_cast<double>(out.z.size()) - 1.0;
    for (double k = std::max(0.0, std::ceil((a.x() - out.first) / out.step));
         k <= std::min(last, std::floor((b.x() - out.first) / out.step)); ++k) {
      const double z = a.y() + (out.first + k * out.step - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
      double& kept = out.z[static_cast<std::size_t>(k)];
      if (std::isnan(kept) || sign * z > sign * kept) kept = z;
    }
  }
  if (body == Body::wheel) return out;
  constexpr std::size_t kDepths = 41;
  out.half.assign(kDepths, kNaN);
  for (std::size_t i = 1; i < outline.size(); ++i)
    for (std::size_t k = 0; k < kDepths; ++k) {
      const Vec2 &a = outline[i - 1], &b = outline[i];
      const double t = (kHalfStep * static_cast<double>(k) - a.y()) / (b.y() - a.y());
      if (t >= 0.0 && t <= 1.0) out.half[k] = std::fmax(out.half[k], std::fabs(a.x() + t * (b.x() - a.x())));
    }
  return out;
}

std::optional<Lean> lean_of(const Profile& profile, std::span<const NominalOutline> nominals) {
  constexpr double kFits = 0.05e-3;
  const std::vector<Vec2> points = apart(profile);
  std::optional<Lean> out = lean_of_points(points, profile.body, nominals);
  if (profile.body == Body::rail && !(out && out->residual < kFits))
    if (std::optional<Lean> head = lean_of_points(head_beside_groove(points), profile.body, nominals);
        head && (!out || head->residual < out->residual))
      return head;
  return out;
}

std::array<TreadFit, 4> tread_fits(const Profile& profile, std::span<const NominalOutline> nominals) {
  constexpr double kSteepest = 0.03, kInRange = 0.9;
  const std::vector<Vec2> points = apart(profile);
  std::array<TreadFit, 4> fits{{{{}, kInfinity, false, false},
                                {{}, kInfinity, true, false},
                                {{}, kInfinity, false, true},
                                {{}, kInfinity, true, true}}};
  for (TreadFit& fit : fits)
    for (const NominalOutline& nominal : nominals) {
      const auto beside = placed(nominal, {});
      std::vector<Vec2> off;  // over y
      for (const Vec2& p : points)
        if (const auto at = beside(Vec2(fit.mirror_y ? -p.x() : p.x(), fit.mirror_z ? -p.y() : p.y())))
          off.emplace_back(at->y, at->off);
      const auto count = static_cast<double>(off.size());
      if (off.size() < 3 || count < kInRange * static_cast<double>(points.size())) continue;
      Vec2 mean = Vec2::Zero();
      for (const Vec2& o : off) mean += o / count;
      double yy = 0.0, yr = 0.0, squares = 0.0;
      for (const Vec2& o : off) yy += std::pow(o.x() - mean.x(), 2), yr += (o.x() - mean.x()) * (o.y() - mean.y());
      const double slope = yy > 0.0 ? std::clamp(yr / yy, -kSteepest, kSteepest) : 0.0;
      for (const Vec2& o : off) squares += std::pow(o.y() - mean.y() - slope * (o.x() - mean.x()), 2);
      if (const double rms = std::sqrt(squares / count); rms < fit.rms) fit.name = nominal.name, fit.rms = rms;
    }
  return fits;
}

}  // namespace treadmark::measured
