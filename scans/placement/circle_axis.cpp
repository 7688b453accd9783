// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/circle_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/placement/voxels.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kFewest = 12;         // points of a strip
constexpr std::size_t kWantedInStrip = 60;  // on average, within the limits of the number of strips
constexpr std::size_t kFewestStrips = 8, kMostStrips = 32;
constexpr std::size_t kMostPoints = 4000;
constexpr double kFlattest = 20.0;     // radius over half the extent of the scan
constexpr double kMostScatter = 0.02;  // scatter of the radii over half the extent: beyond, it is no wheel

struct Basis {
  Vec3 e1, e2;
};
Basis basis_of(const Vec3& direction) {
  const Vec3 e1 = direction.cross(std::fabs(direction.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
  return {e1, direction.cross(e1)};
}

/// Points cut into even strips along a direction, between their 2nd and 98th percentile.
class Strips {
 public:
  static constexpr std::size_t kNone = ~std::size_t{0};

  Strips(std::span<const Vec3> points, const Vec3& direction, std::size_t count)
      : count_(count), along_(points.size()) {
    for (std::size_t i = 0; i < points.size(); ++i) along_[i] = points[i].dot(direction);
    std::vector<double> values = along_;
    const auto part = static_cast<std::ptrdiff_t>(values.size() / 50), last = std::ssize(values) - 1;
    std::nth_element(values.begin(), values.begin() + part, values.end());
    low_ = values[static_cast<std::size_t>(part)];
    std::nth_element(values.begin(), values.begin() + (last - part), values.end());
    width_ = (values[static_cast<std::size_t>(last - part)] - low_) / static_cast<double>(count_);
  }

  bool any() const { return width_ > 0.0; }
  std::size_t count() const { return count_; }
  std::size_t of(std::size_t i) const {
    const double place = (along_[i] - low_) / width_;
    return place >= 0.0 && place < static_cast<double>(count_) ? to_whole<std::size_t>(place) : kNone;
  }
  /// From the middle of the strip, in units of its width.
  double within(std::size_t i) const {
    const double place = (along_[i] - low_) / width_;
    return place - std::floor(place) - 0.5;
  }

 private:
  std::size_t count_;
  std::vector<double> along_;
  double low_ = 0.0, width_ = 0.0;
};

std::size_t strips_for(std::size_t points) { return std::clamp(points / kWantedInStrip, kFewestStrips, kMostStrips); }

struct Circles {
  double score = 1e300;
  Vec3 direction = Vec3::UnitY(), centre = Vec3::Zero();
  double scatter = 1e300;
};

/// The centre that the arcs of all strips have in common: q = |x|^2 less 2 c.x is the same in a strip, but for an even
/// growth across it. Points: about 0, within 1 of it.
Circles circles_across(std::span<const Vec3> points, const Vec3& direction) {
  Circles out;
  out.direction = direction;
  const Strips strips(points, direction, strips_for(points.size()));
  if (!strips.any()) return out;
  const Basis b = basis_of(direction);
  struct Row {
    std::size_t strip;
    double x, y, q, t, w;
  };
  std::vector<Row> rows;
  rows.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t strip = strips.of(i);
    if (strip == Strips::kNone) continue;
    const double x = points[i].dot(b.e1), y = points[i].dot(b.e2);
    rows.push_back({strip, x, y, x * x + y * y, strips.within(i), 1.0});
  }
  if (rows.size() < 10 * kFewest) return out;
  struct Sums {
    std::array<double, 3> g{};                          // of 1 1, 1 t, t t
    std::array<Vec3, 2> f{Vec3::Zero(), Vec3::Zero()};  // of 1 and t with (x, y, q)
    std::array<Vec3, 2> mean{Vec3::Zero(), Vec3::Zero()};
  };
  std::vector<Sums> sums(strips.count());
  std::vector<double> sizes(rows.size());
  double cx = 0.0, cy = 0.0;
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    for (Sums& s : sums) s = {};
    Mat3 matrix = Mat3::Zero();
    for (const Row& r : rows) {
      if (!(r.w > 0.0)) continue;
      const Vec3 f(r.x, r.y, r.q);
      Sums& s = sums[r.strip];
      s.g[0] += r.w;
      s.g[1] += r.w * r.t;
      s.g[2] += r.w * r.t * r.t;
      s.f[0] += r.w * f;
      s.f[1] += r.w * r.t * f;
      matrix += r.w * f * f.transpose();
    }
    for (Sums& s : sums) {
      const double determinant = s.g[0] * s.g[2] - s.g[1] * s.g[1];
      if (!(determinant > 1e-9 * s.g[0] * s.g[0])) {
        if (s.g[0] > 0.0) {
          s.mean[0] = s.f[0] / s.g[0];
          matrix -= s.f[0] * s.f[0].transpose() / s.g[0];
        }
        continue;
      }
      s.mean[0] = (s.g[2] * s.f[0] - s.g[1] * s.f[1]) / determinant;
      s.mean[1] = (s.g[0] * s.f[1] - s.g[1] * s.f[0]) / determinant;
      matrix -= s.f[0] * s.mean[0].transpose() + s.f[1] * s.mean[1].transpose();
    }
    const double xx = matrix(0, 0), xy = matrix(0, 1), yy = matrix(1, 1);
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-14 * xx * yy)) return out;
    cx = 0.5 * (yy * matrix(0, 2) - xy * matrix(1, 2)) / determinant;
    cy = 0.5 * (xx * matrix(1, 2) - xy * matrix(0, 2)) / determinant;
    if (std::hypot(cx, cy) > kFlattest) return out;
    const Vec3 left(-2.0 * cx, -2.0 * cy, 1.0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Row& r = rows[i];
      const Sums& s = sums[r.strip];
      const double off = left.dot(Vec3(r.x, r.y, r.q) - s.mean[0] - r.t * s.mean[1]);
      sizes[i] = std::fabs(off) / (2.0 * std::max(std::hypot(r.x - cx, r.y - cy), 0.1));
    }
    if (round + 1 == kRounds) break;
    std::vector<double> sorted = sizes;
    const double scale = std::max(kMad * median_of(sorted), 1e-7);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double x = sizes[i] / (kTukey * scale);
      rows[i].w = x < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0;
    }
  }
  // what is not far off counts, flanks too, which tell most of the direction
  constexpr double kCounted = 0.9;
  out.scatter = kMad * median_of(sizes);
  const auto last = sizes.begin() + to_whole<std::ptrdiff_t>(kCounted * static_cast<double>(sizes.size()));
  std::nth_element(sizes.begin(), last, sizes.end());
  double sum = 0.0;
  for (auto size = sizes.begin(); size != last; ++size) sum += *size;
  out.score = sum / static_cast<double>(last - sizes.begin());
  out.centre = b.e1 * cx + b.e2 * cy;
  return out;
}

/// Evenly over a half sphere (Vogel 1979).
std::vector<Vec3> half_sphere(std::size_t count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Vec3> out;
  for (std::size_t k = 0; k < count; ++k) {
    const double z = (static_cast<double>(k) + 0.5) / static_cast<double>(count), r = std::sqrt(1.0 - z * z);
    const double angle = golden * static_cast<double>(k);
    out.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return out;
}

/// Turns a direction by ever smaller steps to where the arcs fit best.
Circles climbed(std::span<const Vec3> points, Circles best, double step) {
  constexpr double kFinest = 2e-4;
  constexpr int kMostSteps = 200;
  for (int k = 0; k < kMostSteps && step > kFinest; ++k) {
    const Basis b = basis_of(best.direction);
    const Circles before = best;
    for (int way = 0; way < 8; ++way) {
      const double angle = 0.25 * std::numbers::pi * way;
      const Vec3 turned = before.direction + step * (std::cos(angle) * b.e1 + std::sin(angle) * b.e2);
      if (Circles next = circles_across(points, turned.normalized()); next.score < best.score) best = next;
    }
    if (!(best.score < before.score)) step *= 0.5;
  }
  return best;
}

}  // namespace

double radius_scatter(std::span<const Vec3> points, const Axis& axis, double extent) {
  const Strips strips(points, axis.direction, kMostStrips);
  std::vector<std::vector<Vec2>> inside(strips.count());  // place within the strip, radius
  if (strips.any())
    for (std::size_t i = 0; i < points.size(); ++i)
      if (const std::size_t strip = strips.of(i); strip != Strips::kNone)
        inside[strip].emplace_back(strips.within(i), (points[i] - axis.point).cross(axis.direction).norm());
  std::vector<double> scatters;
  for (const std::vector<Vec2>& strip : inside) {
    if (strip.size() < kFewest) continue;
    double t = 0.0, r = 0.0, tt = 0.0, tr = 0.0;
    for (const Vec2& p : strip) {
      t += p.x();
      r += p.y();
    }
    t /= static_cast<double>(strip.size());
    r /= static_cast<double>(strip.size());
    for (const Vec2& p : strip) {
      tt += (p.x() - t) * (p.x() - t);
      tr += (p.x() - t) * (p.y() - r);
    }
    const double slope = tt > 0.0 ? tr / tt : 0.0;
    std::vector<double> off;
    off.reserve(strip.size());
    for (const Vec2& p : strip) off.push_back(p.y() - slope * p.x());
    const double level = median_of(off);
    for (double& value : off) value = std::fabs(value - level);
    scatters.push_back(median_of(off));
  }
  return scatters.empty() ? extent : median_of(scatters);
}

std::optional<RoughAxis> circle_axis(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                     const SurfaceElements& elements) {
  // one point a cube, so that dense parts do not count more
  const Voxels voxels(points, elements.centre, elements.radius / 80.0, keep);
  std::vector<double> counts;
  for (std::size_t v = 0; v < voxels.count(); ++v) counts.push_back(static_cast<double>(voxels.points_of(v).size()));
  // nor outliers, which have nearly empty cubes of their own
  const double fewest = counts.empty() ? 0.0 : 0.2 * median_of(counts);
  std::vector<Vec3> thinned;  // in units of the extent, about its middle
  for (std::size_t v = 0; v < voxels.count(); ++v)
    if (static_cast<double>(voxels.points_of(v).size()) >= fewest)
      thinned.emplace_back((points[voxels.points_of(v).front()] - elements.centre) / elements.radius);
  std::erase_if(thinned, [&](const Vec3& p) { return p.norm() > 1.5; });
  if (thinned.size() < 10 * kFewest) return std::nullopt;
  const auto every = [&](std::size_t most) {
    std::vector<Vec3> out;
    const double stride = std::max(1.0, static_cast<double>(thinned.size()) / static_cast<double>(most));
    for (double k = 0.0; k < static_cast<double>(thinned.size()); k += stride)
      out.push_back(thinned[static_cast<std::size_t>(k)]);
    return out;
  };
  constexpr std::size_t kDirections = 600, kLookedAt = 1500, kStarts = 5;
  constexpr double kApart = 0.15, kFirstStep = 0.04;
  const std::vector<Vec3> some = every(kLookedAt), more = every(kMostPoints);
  const std::vector<Vec3> directions = half_sphere(kDirections);
  std::vector<Circles> trials(directions.size());
  parallel_for(directions.size(), [&](std::size_t k) { trials[k] = circles_across(some, directions[k]); });
  std::stable_sort(trials.begin(), trials.end(), [](const Circles& x, const Circles& y) { return x.score < y.score; });
  std::vector<Circles> starts;
  for (const Circles& trial : trials)
    if (trial.score < 1e299 && starts.size() < kStarts && ranges::none_of(starts, [&](const Circles& other) {
          return trial.direction.cross(other.direction).norm() < kApart;
        }))
      starts.push_back(trial);
  parallel_for(starts.size(), [&](std::size_t k) {
    starts[k] = climbed(some, starts[k], kFirstStep);
    starts[k] = climbed(more, circles_across(more, starts[k].direction), 0.25 * kFirstStep);
  });
  const auto best = ranges::min_element(starts, {}, &Circles::score);
  if (best == starts.end() || !(best->scatter < kMostScatter)) return std::nullopt;
  RoughAxis out;
  out.axis = {elements.centre + elements.radius * best->centre, best->direction};
  out.residual = elements.radius * best->scatter;
  out.inliers = 1.0;
  return out;
}

}  // namespace treadmark::scans
