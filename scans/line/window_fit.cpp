// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/window_fit.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"

namespace treadmark::scans {
namespace {

constexpr int kWindowRounds = 6;
constexpr double kStillMotion = 1e-8;
constexpr double kLeastScale = 1e-7;  // [m]
// what is known of a motion without points: some 2 mm, some 20 mrad
constexpr double kShiftKnown = 2e-3, kTurnKnown = 20e-3;

}  // namespace

Pose moved(const Pose& frame, const FrameMotion& motion) {
  const Vec3 turn = motion.tail<3>();
  const double angle = turn.norm();
  const Mat3 rotation = angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, turn / angle)) : Mat3::Identity();
  return frame * Pose{Vec3(0.0, motion[0], motion[1]), rotation};
}

WindowFit fit_window(std::span<const Vec3> points, const Section& section, double reach, bool turns,
                     std::size_t fewest) {
  const Eigen::Index unknowns = turns ? 5 : 3;
  struct Residual {
    double d;
    FrameMotion change;
    double x;
  };
  std::vector<Residual> residuals;
  std::vector<double> sizes;
  WindowFit out;
  FrameMotion motion = FrameMotion::Zero();
  for (int round = 0; round < kWindowRounds; ++round) {
    const Pose frame = moved({}, motion);
    residuals.clear();
    sizes.clear();
    for (const Vec3& point : points) {
      const Vec3 p = frame.apply_inverse(point);
      const auto foot = section.foot({p.y(), -p.z()}, reach);
      if (!foot) continue;
      const Vec2 n2 = section.at(foot->s).normal;
      const Vec3 n(0.0, n2.x(), -n2.y()), turn = p.cross(n);
      Residual r{foot->distance, FrameMotion::Zero(), point.x()};
      r.change << n.y(), n.z(), turn.x(), turns ? turn.y() : 0.0, turns ? turn.z() : 0.0;
      residuals.push_back(r);
      sizes.push_back(std::fabs(r.d));
    }
    if (residuals.size() < fewest) return {};
    out.scale = std::max(kLeastScale, kMad * median_of(sizes));
    Eigen::Matrix<double, 5, 5> matrix = Eigen::Matrix<double, 5, 5>::Zero();
    FrameMotion rhs = FrameMotion::Zero();
    double weight = 0.0, along = 0.0;
    out.used = 0;
    for (const Residual& r : residuals) {
      const double x = r.d / (kTukey * out.scale);
      if (!(std::fabs(x) < 1.0)) continue;
      const double w = (1.0 - x * x) * (1.0 - x * x);
      matrix += w * r.change * r.change.transpose();
      rhs += w * r.d * r.change;
      weight += w;
      along += w * r.x;
      ++out.used;
    }
    if (out.used < fewest) return {};
    out.along = along / weight;
    // a step starts from the motion so far, which is what the little that is known besides pulls back
    const double square = out.scale * out.scale;
    FrameMotion known;
    known << 1.0 / (kShiftKnown * kShiftKnown), 1.0 / (kShiftKnown * kShiftKnown), 1.0 / (kTurnKnown * kTurnKnown),
        1.0 / (kTurnKnown * kTurnKnown), 1.0 / (kTurnKnown * kTurnKnown);
    matrix /= square;
    rhs /= square;
    rhs -= known.cwiseProduct(motion);
    matrix.diagonal() += known;
    out.information = matrix;
    FrameMotion step = FrameMotion::Zero();
    step.head(unknowns) = matrix.topLeftCorner(unknowns, unknowns).ldlt().solve(rhs.head(unknowns));
    motion += step;  // turns are small: their order does not matter here, and the next round starts from their sum
    out.motion = motion;
    if (step.cwiseAbs().maxCoeff() < kStillMotion) break;
    reach = std::max(std::min(reach, std::max(10.0 * out.scale, 3e-3)), 1e-3);
  }
  return out;
}

}  // namespace treadmark::scans
