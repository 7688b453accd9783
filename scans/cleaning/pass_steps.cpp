// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/pass_steps.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Eigenvalues>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::scans {
namespace {

constexpr double kCell = 4e-3;  // cells in which passes are compared [m]
constexpr std::size_t kFewestInCell = 5;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// The median distance of one pass in one cell.
struct Level {
  std::size_t pass;  // number in the list of passes
  double d;
  Vec6 change;  // of d by shift and turn about the middle of the pass
};

}  // namespace

PassSteps find_pass_steps(const BandPoints& points, const Band& band, std::span<const std::uint16_t> passes) {
  PassSteps out;
  if (passes.empty()) return out;
  const auto place_of = [&](std::size_t i) {
    const double u = (band.a_min + points.a[i]) / band.radius;
    const Section::Point at = band.section.at(points.s[i]);
    return from_natural(band.body, {u, at.position.x(), at.position.y()});
  };
  std::map<std::uint16_t, std::size_t> number;
  for (std::size_t i = 0; i < points.size(); ++i) number.emplace(passes[points.index[i]], 0);
  if (number.size() < 2) return out;
  for (auto& [pass, k] : number) {
    k = out.passes.size();
    out.passes.push_back({});
    out.passes.back().pass = pass;
  }
  std::vector<std::size_t> pass_of(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    pass_of[i] = number[passes[points.index[i]]];
    PassStep& pass = out.passes[pass_of[i]];
    ++pass.points;
    pass.middle_S += place_of(i);
  }
  for (PassStep& pass : out.passes) pass.middle_S /= static_cast<double>(pass.points);

  // cells of a few of the points' cells
  const auto stride_a = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(kCell / points.cell_a)));
  const auto stride_s = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(kCell / points.cell_s)));
  const std::size_t rows = (points.rows + stride_a - 1) / stride_a,
                    columns = (points.columns + stride_s - 1) / stride_s;
  std::vector<std::vector<Level>> levels(rows * columns);
  parallel_for(rows, [&](std::size_t row) {
    std::vector<std::vector<float>> d(out.passes.size());
    for (std::size_t column = 0; column < columns; ++column) {
      for (auto& list : d) list.clear();
      for (std::size_t r = row * stride_a; r < std::min(points.rows, (row + 1) * stride_a); ++r) {
        const std::size_t last = std::min(points.columns, (column + 1) * stride_s);
        for (std::size_t i = points.first(r, column * stride_s); i < points.begin[r * points.columns + last]; ++i)
          d[pass_of[i]].push_back(points.d[i]);
      }
      const auto seen =
          std::count_if(d.begin(), d.end(), [](const auto& list) { return list.size() >= kFewestInCell; });
      if (seen < 2) continue;
      const double a = points.cell_a * static_cast<double>(stride_a) * (static_cast<double>(row) + 0.5);
      const double s = points.cell_s * static_cast<double>(stride_s) * (static_cast<double>(column) + 0.5);
      const Section::Point at = band.section.at(s);
      const double u = (band.a_min + a) / band.radius;
      const Vec3 p = from_natural(band.body, {u, at.position.x(), at.position.y()}),
                 n = direction(band.body, u, at.normal);
      for (std::size_t k = 0; k < d.size(); ++k) {
        if (d[k].size() < kFewestInCell) continue;
        Level level{k, median_of(d[k]), {}};
        level.change << n, (p - out.passes[k].middle_S).cross(n);
        levels[row * columns + column].push_back(level);
      }
    }
  });

  const auto size = static_cast<Eigen::Index>(6 * out.passes.size());
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(size);
  const auto residuals = [&](const std::vector<Level>& cell, std::vector<double>& r) {
    double mean = 0.0;
    r.clear();
    for (const Level& level : cell) {
      r.push_back(level.d + level.change.dot(motion.segment<6>(static_cast<Eigen::Index>(6 * level.pass))));
      mean += r.back();
    }
    for (double& value : r) value -= mean / static_cast<double>(cell.size());
  };
  const auto rms = [&] {
    double square = 0.0, count = 0.0;
    std::vector<double> r;
    for (const auto& cell : levels) {
      if (cell.empty()) continue;
      residuals(cell, r);
      for (const double value : r) square += value * value;
      count += static_cast<double>(r.size() - 1);
    }
    return count > 0.0 ? std::sqrt(square / count) : 0.0;
  };
  out.before = rms();
  for (int round = 0; round < 8; ++round) {
    std::vector<float> sizes;
    std::vector<double> r;
    for (const auto& cell : levels) {
      if (cell.empty()) continue;
      residuals(cell, r);
      for (const double value : r) sizes.push_back(static_cast<float>(std::fabs(value)));
    }
    if (sizes.empty()) break;
    const double scale = std::max(kMad * median_of(sizes), 1e-8);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(size);
    for (const auto& cell : levels) {
      if (cell.empty()) continue;
      residuals(cell, r);
      const double share = 1.0 / static_cast<double>(cell.size());
      double w = 1.0;
      for (const double value : r) {
        const double x = value / (kTukey * scale);
        w = std::min(w, std::fabs(x) < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0);
      }
      // the cell's own level is eliminated: deviations from the mean of its passes
      for (std::size_t k = 0; k < cell.size(); ++k) {
        const auto at_k = static_cast<Eigen::Index>(6 * cell[k].pass);
        rhs.segment<6>(at_k) -= w * r[k] * cell[k].change;
        for (std::size_t m = 0; m < cell.size(); ++m)
          matrix.block<6, 6>(at_k, static_cast<Eigen::Index>(6 * cell[m].pass)) +=
              w * ((k == m ? 1.0 : 0.0) - share) * cell[k].change * cell[m].change.transpose();
      }
    }
    // 1 mm of shift and 1 mm at 0.1 m of turn weigh alike; what no overlap determines stays
    Eigen::VectorXd unit(size);
    for (Eigen::Index k = 0; k < size; ++k) unit[k] = k % 6 < 3 ? 1.0 : 10.0;
    const Eigen::MatrixXd scaled = unit.asDiagonal() * matrix * unit.asDiagonal();
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
    const Eigen::VectorXd turned = eigen.eigenvectors().transpose() * (unit.asDiagonal() * rhs);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(size);
    constexpr double kDetermined = 1e-4;
    for (Eigen::Index k = 0; k < size; ++k)
      if (eigen.eigenvalues()[k] > kDetermined * eigen.eigenvalues()[size - 1])
        step += eigen.eigenvectors().col(k) * (turned[k] / eigen.eigenvalues()[k]);
    step = unit.asDiagonal() * step;
    motion += step;
    if (step.norm() < 1e-9) break;
  }
  out.after = rms();
  for (std::size_t k = 0; k < out.passes.size(); ++k) {
    out.passes[k].shift_S = motion.segment<3>(static_cast<Eigen::Index>(6 * k));
    out.passes[k].turn_S = motion.segment<3>(static_cast<Eigen::Index>(6 * k + 3));
  }
  for (const auto& cell : levels)
    for (const Level& level : cell) ++out.passes[level.pass].shared;
  return out;
}

void apply(const PassSteps& steps, std::span<const std::uint16_t> passes, const Pose& X_CS, std::span<Vec3> points) {
  if (steps.passes.empty()) return;
  std::vector<Pose> motion(65536);
  for (const PassStep& pass : steps.passes) {
    const double angle = pass.turn_S.norm();
    const Mat3 turn = angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, pass.turn_S / angle)) : Mat3::Identity();
    // p' = middle + shift + turn (p - middle), all in the surface frame
    const Pose in_S{pass.middle_S + pass.shift_S - turn * pass.middle_S, turn};
    motion[pass.pass] = X_CS * in_S * X_CS.inverse();
  }
  constexpr std::size_t kBlock = 65536;
  parallel_for((points.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    for (std::size_t i = kBlock * block; i < std::min(points.size(), kBlock * (block + 1)); ++i)
      points[i] = motion[passes[i]].apply(points[i]);
  });
}

}  // namespace treadmark::scans
