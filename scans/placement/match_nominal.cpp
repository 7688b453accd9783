// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/match_nominal.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::scans {
namespace {

constexpr double kLeastOverlap = 0.5;
constexpr double kCoarseStep = 2e-3;  // of the lateral positions that are tried [m]
constexpr double kAlike = 4e-3;       // sections that differ more at their better half are of other things [m]

std::vector<Vec2> nodes_of(const Section& section) {
  constexpr double kStep = 0.5e-3;
  std::vector<Vec2> out;
  const auto steps = static_cast<std::size_t>(section.length() / kStep);
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

}  // namespace

Vec2 to_nominal(const SectionMatch& match, const Vec2& point) {
  return rolled(match.roll, {match.turned ? -point.x() : point.x(), point.y()}) + match.shift;
}

SectionMatch match_nominal(const Section& measured, const Section& nominal, Body body, bool keep_way) {
  const std::vector<Vec2> points = nodes_of(measured);
  struct Start {
    bool turned;
    double roll;
    Trial trial;
  };
  std::vector<Start> starts;
  constexpr double kMostRoll = 1.0471975511965976, kRollStep = 0.05;
  for (const bool turned : {false, true}) {
    if (turned && keep_way) continue;
    if (body == Body::wheel)
      starts.push_back({turned, 0.0, {}});
    else
      for (double roll = -kMostRoll; roll <= kMostRoll + 1e-9; roll += kRollStep) starts.push_back({turned, roll, {}});
  }
  parallel_for(starts.size(), [&](std::size_t k) {
    std::vector<Vec2> moved = points;
    for (Vec2& p : moved) p = rolled(starts[k].roll, {starts[k].turned ? -p.x() : p.x(), p.y()});
    starts[k].trial = try_shifts(moved, nominal);
  });
  // a little worse the other way round does not count: symmetric profiles keep the way that they have
  constexpr double kClearlyBetter = 0.8;
  const Start* best = &starts.front();
  for (const Start& s : starts)
    if (s.trial.score < (s.turned && !best->turned ? kClearlyBetter : 1.0) * best->trial.score) best = &s;
  if (!(best->trial.score < 1e299))
    throw Error(ErrorKind::input_data, "the scanned section and the nominal profile do not overlap", {},
                "choose another nominal profile, or none");

  SectionMatch out;
  out.turned = best->turned;
  out.roll = best->roll;
  out.shift = {best->trial.shift_y, best->trial.shift_v};
  const Eigen::Index unknowns = body == Body::wheel ? 2 : 3;
  double scale = 3e-3;
  constexpr double kFinest = 3e-6;
  double near = 0.0, agreeing = 0.0;
  for (int round = 0; round < 60; ++round) {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
    std::vector<double> sizes;
    near = agreeing = 0.0;
    const double reach = std::max(5e-3, 2.0 * kTukey * scale);
    for (const Vec2& p : points) {
      const Vec2 q = to_nominal(out, p);
      const auto foot = nominal.foot(q, reach);
      if (!foot) continue;
      near += 1.0;
      sizes.push_back(std::fabs(foot->distance));
      const double x = foot->distance / (kTukey * scale);
      if (!(std::fabs(x) < 1.0)) continue;
      agreeing += 1.0;
      const double w = (1.0 - x * x) * (1.0 - x * x);
      const Vec2 normal = nominal.at(foot->s).normal;
      const Vec2 arm = q - out.shift;
      // change of the distance by shifts and by a little more roll
      const Eigen::Vector3d j(normal.x(), normal.y(), normal.dot(Vec2(arm.y(), -arm.x())));
      matrix += w * j * j.transpose();
      rhs -= w * foot->distance * j;
    }
    if (sizes.size() < 10) break;
    Eigen::VectorXd step = Eigen::VectorXd::Zero(3);
    matrix += 1e-9 * matrix.trace() * Eigen::Matrix3d::Identity();
    step.head(unknowns) = matrix.topLeftCorner(unknowns, unknowns).ldlt().solve(rhs.head(unknowns));
    out.shift += step.head(2);
    if (unknowns == 3) out.roll += step[2];
    out.residual = kMad * median_of(sizes);
    scale = std::max({0.7 * scale < out.residual ? out.residual : 0.7 * scale, kFinest});
    if (round > 30 && step.norm() < 1e-10) break;
  }
  out.agreeing = agreeing / static_cast<double>(points.size());
  const double shorter = std::min(measured.length(), nominal.length());
  out.overlap = near * (measured.length() / static_cast<double>(points.size())) / shorter;
  out.beside = 1.0 - near / static_cast<double>(points.size());
  constexpr double kMostBeside = 0.3;
  if (out.beside > kMostBeside && near >= 10.0)
    throw Error(ErrorKind::input_data,
                fmt::format("{:.0f} % of the scanned section lie more than 5 mm beside the nominal profile",
                            100.0 * out.beside),
                {}, "is it the right object, body and unit? choose another nominal profile, or none");
  if (near < 10.0 || out.overlap < 0.4 || out.residual > kAlike)
    throw Error(ErrorKind::input_data,
                fmt::format("the scanned section does not look like the nominal profile: over {:.0f} % of it they lie "
                            "{:.1f} mm apart (robust deviation)",
                            100.0 * out.overlap, 1e3 * out.residual),
                {}, "is it the right object, body and unit? choose another nominal profile, or none");
  return out;
}

}  // namespace treadmark::scans
