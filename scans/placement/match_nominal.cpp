// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/match_nominal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

constexpr double kLeastOverlap = 0.5;
constexpr double kCoarseStep = 2e-3;  // of the lateral positions that are tried [m]
constexpr double kAlike = 4e-3;       // sections that differ more at their better half are of other things [m]

std::vector<Vec2> nodes_of(const Section& section) {
  constexpr double kStep = 0.5e-3;
  std::vector<Vec2> out;
  const auto steps = to_whole<std::size_t>(section.length() / kStep);
  for (std::size_t k = 0; k <= steps; ++k) out.push_back(section.at(kStep * static_cast<double>(k)).position);
  return out;
}

/// The best lateral shift for a given roll and way, by the scatter of the heights' differences.
struct Trial {
  double score = 1e300, shift_v = 0.0, shift_y = 0.0;
};

Trial try_shifts(const std::vector<Vec2>& points, const Section& nominal) {
  double y_min = 1e300, y_max = -1e300;
  for (const Vec2& p : points) {
    y_min = std::min(y_min, p.x());
    y_max = std::max(y_max, p.x());
  }
  const double shorter = std::min(y_max - y_min, nominal.y_max() - nominal.y_min());
  Trial best;
  std::vector<double> apart, rest;
  for (double dy = nominal.y_min() - y_max; dy <= nominal.y_max() - y_min; dy += kCoarseStep) {
    const double overlap = std::min(y_max + dy, nominal.y_max()) - std::max(y_min + dy, nominal.y_min());
    if (overlap < kLeastOverlap * shorter) continue;
    apart.clear();
    for (const Vec2& p : points)
      if (const double y = p.x() + dy; y > nominal.y_min() && y < nominal.y_max())
        apart.push_back(nominal.v_at(y) - p.y());
    if (apart.size() < 10) continue;
    const double level = median_of(apart);
    rest = apart;
    for (double& a : rest) a = std::fabs(a - level);
    // the better half decides on a worn profile; the mean over the rest settles which of similar places is meant
    double mean = 0.0;
    for (const double r : rest) mean += std::min(r, 10e-3);
    const double score =
        (median_of(rest) + 0.3 * mean / static_cast<double>(rest.size())) * std::pow(shorter / overlap, 2);
    if (score < best.score) best = {score, level, dy};
  }
  return best;
}

Vec2 rolled(double roll, const Vec2& p) {
  return {std::cos(roll) * p.x() + std::sin(roll) * p.y(), -std::sin(roll) * p.x() + std::cos(roll) * p.y()};
}

constexpr double kFinest = 3e-6;

/// Gauss-Newton steps with Tukey's weights, as many at most; of the roll too where it is free.
struct Fitted {
  SectionMatch match;
  double near = 0.0, agreeing = 0.0;  ///< points
};

Fitted fitted(const std::vector<Vec2>& points, const Section& nominal, const SectionMatch& start, bool rolls,
              double scale, int rounds = 60) {
  Fitted out{start};
  SectionMatch& match = out.match;
  const Eigen::Index unknowns = rolls ? 3 : 2;
  constexpr int kFewest = 30;
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
    std::vector<double> sizes;
    out.near = out.agreeing = 0.0;
    const double reach = std::max(5e-3, 2.0 * kTukey * scale);
    for (const Vec2& p : points) {
      const Vec2 q = to_nominal(match, p);
      const auto foot = nominal.foot(q, reach);
      if (!foot) continue;
      out.near += 1.0;
      sizes.push_back(std::fabs(foot->distance));
      const double x = foot->distance / (kTukey * scale);
      if (!(std::fabs(x) < 1.0)) continue;
      out.agreeing += 1.0;
      const double w = (1.0 - x * x) * (1.0 - x * x);
      const Vec2 normal = nominal.at(foot->s).normal;
      const Vec2 arm = q - match.shift;
      // change of the distance by shifts and by a little more roll
      const Eigen::Vector3d j(normal.x(), normal.y(), normal.dot(Vec2(arm.y(), -arm.x())));
      matrix += w * j * j.transpose();
      rhs -= w * foot->distance * j;
    }
    if (sizes.size() < 10) break;
    Eigen::VectorXd step = Eigen::VectorXd::Zero(3);
    matrix += 1e-9 * matrix.trace() * Eigen::Matrix3d::Identity();
    step.head(unknowns) = matrix.topLeftCorner(unknowns, unknowns).ldlt().solve(rhs.head(unknowns));
    match.shift += step.head(2);
    if (rolls) match.roll += step[2];
    match.residual = kMad * median_of(sizes);
    scale = std::max({0.7 * scale < match.residual ? match.residual : 0.7 * scale, kFinest});
    if (round > kFewest && step.norm() < 1e-10) break;
  }
  return out;
}

/// How a wheel's section would be turned, were it free.
SectionMatch::Turn turn_of(const std::vector<Vec2>& points, const Section& nominal, const SectionMatch& match) {
  // about the middle of the section, for its v is the radius
  Vec2 middle = Vec2::Zero();
  for (const Vec2& p : points) middle += p;
  middle /= static_cast<double>(points.size());
  std::vector<Vec2> about = points;
  for (Vec2& p : about) p -= middle;
  SectionMatch start = match;
  start.shift += Vec2(match.turned ? -middle.x() : middle.x(), middle.y());
  const SectionMatch free = fitted(about, nominal, start, true, std::max(3.0 * match.residual, 0.1e-3)).match;
  constexpr double kReach = 5e-3, kAlong = 20e-3;
  double square = 0.0, lever = 0.0;
  for (const Vec2& p : about) {
    const auto foot = nominal.foot(to_nominal(free, p), kReach);
    const double d = foot ? foot->distance : kReach;
    square += d * d;
    lever += p.x() * p.x();
  }
  const auto count = static_cast<double>(points.size());
  const double parts = std::max(1.0, nominal.length() / kAlong);
  SectionMatch::Turn out;
  out.angle = free.roll;
  out.error = std::sqrt(std::max(square / count, kFinest * kFinest) / (lever / count * parts));
  const Vec2 back = rolled(-free.roll, -free.shift);
  out.datum = middle + Vec2(match.turned ? -back.x() : back.x(), back.y());
  return out;
}

/// Mean distance of a rail from the nominal section, but for what is worn off its gauge side.
double misfit(std::span<const Vec2> points, const Section& nominal, const SectionMatch& match) {
  constexpr double kReach = 15e-3, kMost = 2e-3, kGaugeSide = -0.25;
  double sum = 0.0, count = 0.0;
  for (const Vec2& p : points) {
    const auto foot = nominal.foot(to_nominal(match, p), kReach);
    if (!foot) continue;  // past its ends
    count += 1.0;
    const bool worn = foot->distance < 0.0 && nominal.at(foot->s).normal.x() < kGaugeSide;
    if (!worn) sum += std::min(std::fabs(foot->distance), kMost);
  }
  return count > 0.0 ? sum / count : kMost;
}

/// How far a section is from its mirror image about the nominal one's middle, where both are: rms.
double asymmetry_of(const std::vector<Vec2>& points, const SectionMatch& match) {
  std::vector<Vec2> across;
  for (const Vec2& p : points)
    if (const Vec2 q = to_nominal(match, p); across.empty() || q.x() > across.back().x() + 1e-6) across.push_back(q);
  if (match.turned) {
    across.clear();
    for (auto p = points.rbegin(); p != points.rend(); ++p)
      if (const Vec2 q = to_nominal(match, *p); across.empty() || q.x() > across.back().x() + 1e-6) across.push_back(q);
  }
  constexpr std::size_t kFewest = 4;
  if (across.size() < kFewest) return 0.0;
  const Section section(across);
  double square = 0.0, count = 0.0;
  for (const Vec2& p : across) {
    const auto foot = section.foot({-p.x(), p.y()}, 15e-3);
    if (!foot) continue;
    square += foot->distance * foot->distance;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(square / count) : 0.0;
}

/// How far below its top a rail was measured on either side, at y < 0 and at y > 0, but for a few points.
std::array<double, 2> depths_of(std::span<const Vec2> points, const SectionMatch& match) {
  std::array<std::vector<double>, 2> sides;
  double top = -1e300;
  for (const Vec2& p : points) {
    const Vec2 q = to_nominal(match, p);
    sides[q.x() < 0.0 ? 0 : 1].push_back(q.y());
    top = std::max(top, q.y());
  }
  std::array<double, 2> out{};
  for (const std::size_t side : {0u, 1u}) {
    std::vector<double>& v = sides[side];
    if (v.empty()) continue;
    const auto low = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 100);
    std::nth_element(v.begin(), low, v.end());
    out[side] = top - *low;
  }
  return out;
}

}  // namespace

Mat3 match_covariance(const Section& measured, const Section& nominal, Body body, const SectionMatch& match) {
  constexpr double kPart = 15e-3;
  constexpr std::size_t kFewestParts = 4;
  constexpr int kRounds = 12;  // from where all parts together lie
  const std::vector<Vec2> points = nodes_of(measured);
  const std::size_t parts = std::max(kFewestParts, to_whole<std::size_t>(measured.length() / kPart));
  std::vector<Vec3> found(parts);
  parallel_for(parts, [&](std::size_t part) {
    std::vector<Vec2> rest;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (i * parts / points.size() != part) rest.push_back(points[i]);
    const SectionMatch one =
        fitted(rest, nominal, match, body == Body::rail, std::max(2.0 * match.residual, kFinest), kRounds).match;
    found[part] = {one.shift.x(), one.shift.y(), one.roll};
  });
  Vec3 mean = Vec3::Zero();
  const auto count = static_cast<double>(parts);
  for (const Vec3& one : found) mean += one / count;
  Mat3 out = Mat3::Zero();
  for (const Vec3& one : found) out += (count - 1.0) / count * (one - mean) * (one - mean).transpose();
  return out;
}

Vec2 to_nominal(const SectionMatch& match, const Vec2& point) {
  return rolled(match.roll, {match.turned ? -point.x() : point.x(), point.y()}) + match.shift;
}

SectionMatch match_nominal(const Section& measured, const Section& nominal, Body body, bool keep_way,
                           std::span<const Vec2> heap) {
  const std::vector<Vec2> points = nodes_of(measured);
  const bool wheel = body == Body::wheel;
  struct Start {
    bool turned;
    double roll;
    Trial trial;
  };
  std::vector<Start> starts;
  constexpr double kMostRoll = 1.0471975511965976, kRollStep = 0.05;
  for (const bool turned : {false, true}) {
    if (turned && keep_way) continue;
    if (wheel)
      starts.push_back({turned, 0.0, {}});
    else
      for (double roll = -kMostRoll; roll <= kMostRoll + 1e-9; roll += kRollStep) starts.push_back({turned, roll, {}});
  }
  parallel_for(starts.size(), [&](std::size_t k) {
    std::vector<Vec2> moved = points;
    for (Vec2& p : moved) p = rolled(starts[k].roll, {starts[k].turned ? -p.x() : p.x(), p.y()});
    starts[k].trial = try_shifts(moved, nominal);
  });
  const auto best_of = [&](bool turned) {
    const Start* best = nullptr;
    for (const Start& s : starts)
      if (s.turned == turned && (best == nullptr || s.trial.score < best->trial.score)) best = &s;
    return best;
  };
  const auto match_from = [&](const Start& start) {
    SectionMatch out;
    out.turned = start.turned;
    out.roll = start.roll;
    out.shift = {start.trial.shift_y, start.trial.shift_v};
    constexpr double kFirstScale = 3e-3;
    return fitted(points, nominal, out, !wheel, kFirstScale);
  };
  const Start* here = best_of(false);
  const Start* other = best_of(true);
  const bool other_fits = other != nullptr && other->trial.score < 1e299;
  if (!(here->trial.score < 1e299) && !other_fits)
    throw Error(ErrorKind::input_data, "the scanned section and the nominal profile do not overlap", {},
                "choose another nominal profile, or none");
  Fitted best;
  if (wheel || !other_fits) {
    // a little worse the other way round does not count
    constexpr double kClearlyBetter = 0.8;
    best = match_from(other_fits && other->trial.score < kClearlyBetter * here->trial.score ? *other : *here);
  } else {
    // each way from its own best start and from the mirror image of the other's, so that none has the better luck
    std::vector<Vec2> seen;
    constexpr std::size_t kMostSeen = 4000;
    for (std::size_t i = 0; i < heap.size(); i += 1 + heap.size() / kMostSeen) seen.push_back(heap[i]);
    if (heap.empty()) seen = points;
    std::array<Fitted, 2> ways{match_from(*here), match_from(*other)};
    std::array<double, 2> apart{misfit(seen, nominal, ways[0].match), misfit(seen, nominal, ways[1].match)};
    const auto mirrored = [](SectionMatch match) {
      match.turned = !match.turned;
      match.roll = -match.roll;
      match.shift.x() = -match.shift.x();
      return match;
    };
    constexpr double kNearScale = 0.5e-3;
    const std::array<Fitted, 2> images{fitted(points, nominal, mirrored(ways[1].match), true, kNearScale),
                                       fitted(points, nominal, mirrored(ways[0].match), true, kNearScale)};
    for (const std::size_t way : {0u, 1u})
      if (const double image = misfit(seen, nominal, images[way].match); image < apart[way]) {
        ways[way] = images[way];
        apart[way] = image;
      }
    constexpr double kClearRatio = 1.5, kClear = 10e-6;
    const double least = std::min(apart[0], apart[1]), most = std::max(apart[0], apart[1]);
    bool clear = most > kClearRatio * least && most - least > kClear;
    bool turned = clear && apart[1] < apart[0];
    if (!clear) {
      // gauges are measured where one side alone may have been
      constexpr double kGauge = 14e-3;
      const auto [left, right] = depths_of(seen, ways[0].match);
      turned = left < kGauge && right >= kGauge;
      clear = (left < kGauge) != (right < kGauge);
    }
    best = ways[turned ? 1 : 0];
    best.match.ways = {apart[turned ? 1 : 0], apart[turned ? 0 : 1], asymmetry_of(points, best.match), clear};
  }

  SectionMatch& out = best.match;
  out.agreeing = best.agreeing / static_cast<double>(points.size());
  const double shorter = std::min(measured.length(), nominal.length());
  out.overlap = best.near * (measured.length() / static_cast<double>(points.size())) / shorter;
  out.beside = 1.0 - best.near / static_cast<double>(points.size());
  constexpr double kMostBeside = 0.3;
  if (out.beside > kMostBeside && best.near >= 10.0)
    throw Error(ErrorKind::input_data,
                fmt::format("{:.0f} % of the scanned section lie more than 5 mm beside the nominal profile",
                            100.0 * out.beside),
                {}, "is it the right object, body and unit? choose another nominal profile, or none");
  if (best.near < 10.0 || out.overlap < 0.4 || out.residual > kAlike)
    throw Error(ErrorKind::input_data,
                fmt::format("the scanned section does not look like the nominal profile: over {:.0f} % of it they lie "
                            "{:.1f} mm apart (robust deviation)",
                            100.0 * out.overlap, 1e3 * out.residual),
                {}, "is it the right object, body and unit? choose another nominal profile, or none");
  if (wheel) out.turn = turn_of(points, nominal, out);
  return out;
}

}  // namespace treadmark::scans
