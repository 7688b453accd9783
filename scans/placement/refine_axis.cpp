// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/refine_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kBlock = 8192;
constexpr int kMostRounds = 25;

/// d = distance from the section along its normal, j = change of d by the four (wheel) or two (rail) motions.
struct Residual {
  double d = 0.0;
  std::array<double, 4> j{};
  double s = -1.0;  ///< < 0: not near the section
};

std::vector<Vec2> across(std::span<const Vec3> points, Body body, const Pose& X_CS) {
  std::vector<Vec2> out(points.size());
  parallel_blocks(points.size(), kBlock, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const Natural n = natural(body, X_CS.apply_inverse(points[i]));
      out[i] = {n.y, n.v};
    }
  });
  return out;
}

}  // namespace

RefinedAxis refine_axis(std::span<const Vec3> points, Body body, const Pose& start) {
  RefinedAxis out;
  out.X_CS = start;
  const bool wheel = body == Body::wheel;
  const Eigen::Index unknowns = wheel ? 4 : 2;
  double reach = 20e-3;  // the rough axis smears the section
  Section section = outline(across(points, body, out.X_CS));
  constexpr double kKnots = 4e-3, kStrip = 2e-3, kNearest = 1e-3;
  Eigen::Matrix4d information = Eigen::Matrix4d::Identity();
  double shifting = 0.0, turning = 0.0;  // sizes of the last few steps, unless settled
  for (int round = 0; round < kMostRounds; ++round) {
    out.iterations = round + 1;
    if (round > 0 && round < 4) section = outline(across(points, body, out.X_CS));  // the first steps are large
    out.fit = fit_section(section, across(points, body, out.X_CS), reach, kKnots, round < 4 ? 2 : 1);
    section = out.fit.section;
    std::vector<Residual> residuals(points.size());
    parallel_blocks(points.size(), kBlock, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        const Vec3 p = out.X_CS.apply_inverse(points[i]);
        const Natural n = natural(body, p);
        const auto foot = section.foot({n.y, n.v}, reach);
        if (!foot) continue;
        const Vec3 normal = direction(body, n.u, section.at(foot->s).normal);
        const Vec3 turn = p.cross(normal);
        residuals[i] = {
            foot->distance,
            wheel ? std::array{normal.x(), normal.z(), turn.x(), turn.z()} : std::array{turn.y(), turn.z(), 0.0, 0.0},
            foot->s};
      }
    });
    // weights
    std::vector<double> sizes;
    sizes.reserve(residuals.size());
    for (const Residual& r : residuals)
      if (r.s >= 0.0) sizes.push_back(std::fabs(r.d));
    if (sizes.empty()) break;
    const double scale = std::max(kMad * median_of(sizes), 1e-7);
    // what is the same all along a strip of the section is the section's matter: its weighted mean is taken out
    const auto strips = static_cast<std::size_t>(section.length() / kStrip) + 1;
    struct Sum {
      double w = 0.0, d = 0.0;
      std::array<double, 4> j{};
    };
    const std::size_t blocks = (residuals.size() + kBlock - 1) / kBlock;  // summed one by one, then in their order
    std::vector<std::vector<Sum>> strip_sums(blocks);
    std::vector<double> weight(residuals.size(), 0.0);
    std::vector<std::array<std::size_t, 2>> counts(blocks, {0, 0});  // near, used
    parallel_blocks(residuals.size(), kBlock, [&](std::size_t from, std::size_t to) {
      std::vector<Sum> own(strips);
      auto& [near, used] = counts[from / kBlock];
      for (std::size_t i = from; i < to; ++i) {
        const Residual& r = residuals[i];
        if (r.s < 0.0) continue;
        ++near;
        const double x = r.d / (kTukey * scale);
        if (!(std::fabs(x) < 1.0)) continue;
        weight[i] = (1.0 - x * x) * (1.0 - x * x);
        ++used;
        Sum& sum = own[static_cast<std::size_t>(r.s / kStrip)];
        sum.w += weight[i];
        sum.d += weight[i] * r.d;
        for (std::size_t k = 0; k < 4; ++k) sum.j[k] += weight[i] * r.j[k];
      }
      strip_sums[from / kBlock] = std::move(own);
    });
    std::vector<Sum> mean(strips);
    double used = 0.0, near = 0.0;
    for (std::size_t block = 0; block < blocks; ++block) {
      near += static_cast<double>(counts[block][0]);
      used += static_cast<double>(counts[block][1]);
      for (std::size_t s = 0; s < strips; ++s) {
        mean[s].w += strip_sums[block][s].w;
        mean[s].d += strip_sums[block][s].d;
        for (std::size_t k = 0; k < 4; ++k) mean[s].j[k] += strip_sums[block][s].j[k];
      }
    }
    out.undamaged = used / near;
    struct Equations {
      Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero(), plain = Eigen::Matrix4d::Zero();
      Eigen::Vector4d rhs = Eigen::Vector4d::Zero();
      double square = 0.0, slope = 0.0;
    };
    std::vector<Equations> equations(blocks);
    parallel_blocks(residuals.size(), kBlock, [&](std::size_t from, std::size_t to) {
      Equations own;
      for (std::size_t i = from; i < to; ++i) {
        if (!(weight[i] > 0.0)) continue;
        const Sum& sum = mean[static_cast<std::size_t>(residuals[i].s / kStrip)];
        Eigen::Vector4d j;
        for (std::size_t k = 0; k < 4; ++k) j[static_cast<Eigen::Index>(k)] = residuals[i].j[k] - sum.j[k] / sum.w;
        const double d = residuals[i].d - sum.d / sum.w;
        own.matrix += weight[i] * j * j.transpose();
        own.rhs += weight[i] * d * j;
        own.plain += j * j.transpose();
        own.square += weight[i] * weight[i] * d * d;
        const double x = residuals[i].d / (kTukey * scale);
        own.slope += (1.0 - x * x) * (1.0 - 5.0 * x * x);
      }
      equations[from / kBlock] = own;
    });
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero(), plain = matrix;
    Eigen::Vector4d rhs = Eigen::Vector4d::Zero();
    double square = 0.0, slope = 0.0;
    for (const Equations& own : equations) {
      matrix += own.matrix;
      plain += own.plain;
      rhs += own.rhs;
      square += own.square;
      slope += own.slope;
    }
    // covariance of an M-estimate (Huber 1981): n sum(psi^2) / sum(psi')^2 times the inverse of the plain normal matrix
    information = plain * (slope * slope) / std::max(used * square, 1e-30);
    // motions that the scan says nothing about stay as they are
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix.topLeftCorner(unknowns, unknowns));
    Eigen::VectorXd step = Eigen::VectorXd::Zero(4);
    for (Eigen::Index k = 0; k < unknowns; ++k)
      if (eigen.eigenvalues()[k] > 1e-12 * eigen.eigenvalues()[unknowns - 1])
        step.head(unknowns) +=
            eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).dot(rhs.head(unknowns)) / eigen.eigenvalues()[k];
    const Vec3 shift = wheel ? Vec3(step[0], 0.0, step[1]) : Vec3::Zero();
    const Vec3 turn = wheel ? Vec3(step[2], 0.0, step[3]) : Vec3(0.0, step[0], step[1]);
    const double angle = turn.norm();
    const Mat3 rotation = angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, turn / angle)) : Mat3::Identity();
    out.X_CS = out.X_CS * Pose{shift, rotation};
    reach = std::max(kNearest, std::min(reach, std::max(8.0 * scale, 5e-3)));
    const bool settled = round > 4 && shift.norm() < 1e-8 && angle < 1e-8;
    shifting = settled ? 0.0 : std::max(0.5 * shifting, shift.norm());
    turning = settled ? 0.0 : std::max(0.5 * turning, angle);
    if (settled) break;
  }
  // what still moves, as on short arcs, may be as far from its end as it would get in as many rounds again
  shifting *= out.iterations;
  turning *= out.iterations;
  const Eigen::MatrixXd covariance =
      information.topLeftCorner(unknowns, unknowns).ldlt().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  if (wheel) {
    out.position_error = std::hypot(std::sqrt(std::max(covariance(0, 0) + covariance(1, 1), 0.0)), shifting);
    out.direction_error = std::hypot(std::sqrt(std::max(covariance(2, 2) + covariance(3, 3), 0.0)), turning);
  } else {
    out.direction_error = std::hypot(std::sqrt(std::max(covariance.trace(), 0.0)), turning);
  }
  out.fit = fit_section(section, across(points, body, out.X_CS), 5e-3, 2e-3);
  return out;
}

}  // namespace treadmark::scans
