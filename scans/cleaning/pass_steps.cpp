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
  Vec6 change;      // of d by shift and turn about the middle of the pass
  double variance;  // of d, by the scatter of its points [m^2]

  Eigen::Index row() const { return static_cast<Eigen::Index>(6 * pass); }
};
using Cell = std::vector<Level>;

Vec3 place_on(const Band& band, double u, const Section::Point& at) {
  return from_natural(band.body, {u, at.position.x(), at.position.y()});
}

/// Of the median of normally distributed values.
double variance_of_median(std::span<const float> values, double median) {
  constexpr double kOfMeanSize = 0.5 * kPi;  // of both: squares of standard deviations over mean sizes, of medians
  double size = 0.0;
  for (const float value : values) size += std::fabs(static_cast<double>(value) - median);
  const auto count = static_cast<double>(values.size());
  return kOfMeanSize * kOfMeanSize * std::pow(size / count, 2) / count;
}

/// Lists the passes with their middles; returns of each point the number in the list.
std::vector<std::size_t> list_passes(const BandPoints& points, const Band& band, std::span<const std::uint16_t> passes,
                                     std::vector<PassStep>& list) {
  std::map<std::uint16_t, std::size_t> number;
  for (std::size_t i = 0; i < points.size(); ++i) number.emplace(passes[points.index[i]], 0);
  if (number.size() < 2) return {};
  for (auto& [pass, k] : number) {
    k = list.size();
    list.push_back({});
    list.back().pass = pass;
  }
  std::vector<std::size_t> pass_of(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    pass_of[i] = number[passes[points.index[i]]];
    PassStep& pass = list[pass_of[i]];
    ++pass.points;
    pass.middle_S += place_on(band, (band.a_min + points.a[i]) / band.radius, band.section.at(points.s[i]));
  }
  for (PassStep& pass : list) pass.middle_S /= static_cast<double>(pass.points);
  return pass_of;
}

/// Levels in the cells that two passes or more have seen; a cell is a few of the points' cells wide.
std::vector<Cell> find_levels(const BandPoints& points, const Band& band, std::span<const std::size_t> pass_of,
                              std::span<const PassStep> passes) {
  const auto stride_a = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(kCell / points.cell_a)));
  const auto stride_s = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(kCell / points.cell_s)));
  const std::size_t rows = (points.rows + stride_a - 1) / stride_a,
                    columns = (points.columns + stride_s - 1) / stride_s;
  std::vector<Cell> cells(rows * columns);
  parallel_for(rows, [&](std::size_t row) {
    std::vector<std::vector<float>> d(passes.size());
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
      const Vec3 p = place_on(band, u, at), n = direction(band.body, u, at.normal);
      for (std::size_t k = 0; k < d.size(); ++k) {
        if (d[k].size() < kFewestInCell) continue;
        Level level{k, median_of(d[k]), {}, 0.0};
        level.variance = variance_of_median(d[k], level.d);
        level.change << n, (p - passes[k].middle_S).cross(n);
        cells[row * columns + column].push_back(level);
      }
    }
  });
  std::erase_if(cells, [](const Cell& cell) { return cell.empty(); });
  return cells;
}

/// Motions of the passes under which their levels agree.
class MotionFit {
 public:
  MotionFit(std::span<const Cell> cells, std::size_t passes)
      : cells_(cells), motion_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * passes))) {}

  const Eigen::VectorXd& motion() const { return motion_; }

  double rms() const {
    double square = 0.0, count = 0.0;
    for (const Cell& cell : cells_) {
      const std::vector<double> r = residuals(cell);
      for (const double value : r) square += value * value;
      count += static_cast<double>(r.size() - 1);
    }
    return count > 0.0 ? std::sqrt(square / count) : 0.0;
  }
  /// What scatter of points makes of that.
  double expected_rms() const {
    double square = 0.0, count = 0.0;
    for (const Cell& cell : cells_) {
      const auto levels = static_cast<double>(cell.size());
      for (const Level& level : cell) square += (1.0 - 1.0 / levels) * level.variance;
      count += levels - 1.0;
    }
    return count > 0.0 ? std::sqrt(square / count) : 0.0;
  }

  void solve() {
    for (int round = 0; round < 8 && !cells_.empty(); ++round) {
      const Eigen::VectorXd step = determined_step();
      motion_ += step;
      if (step.norm() < 1e-9) break;
    }
  }

 private:
  /// Of a cell's levels, from their mean.
  std::vector<double> residuals(const Cell& cell) const {
    double mean = 0.0;
    std::vector<double> r;
    for (const Level& level : cell) {
      r.push_back(level.d + level.change.dot(motion_.segment<6>(level.row())));
      mean += r.back();
    }
    for (double& value : r) value -= mean / static_cast<double>(cell.size());
    return r;
  }

  double robust_scale() const {
    std::vector<float> sizes;
    for (const Cell& cell : cells_)
      for (const double value : residuals(cell)) sizes.push_back(static_cast<float>(std::fabs(value)));
    return std::max(kMad * median_of(sizes), 1e-8);
  }

  struct Equations {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd rhs;
  };
  Equations equations() const {
    const double scale = robust_scale();
    const Eigen::Index size = motion_.size();
    Equations out{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
    for (const Cell& cell : cells_) {
      const std::vector<double> r = residuals(cell);
      const double share = 1.0 / static_cast<double>(cell.size());
      double w = 1.0;
      for (const double value : r) {
        const double x = value / (kTukey * scale);
        w = std::min(w, std::fabs(x) < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0);
      }
      // the cell's own level is eliminated: deviations from the mean of its passes
      for (std::size_t k = 0; k < cell.size(); ++k) {
        out.rhs.segment<6>(cell[k].row()) -= w * r[k] * cell[k].change;
        for (std::size_t m = 0; m < cell.size(); ++m)
          out.matrix.block<6, 6>(cell[k].row(), cell[m].row()) +=
              w * ((k == m ? 1.0 : 0.0) - share) * cell[k].change * cell[m].change.transpose();
      }
    }
    return out;
  }

  /// What no overlap determines stays; 1 mm of shift and 1 mm at 0.1 m of turn weigh alike.
  Eigen::VectorXd determined_step() const {
    const auto [matrix, rhs] = equations();
    const Eigen::Index size = motion_.size();
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
    return unit.asDiagonal() * step;
  }

  std::span<const Cell> cells_;
  Eigen::VectorXd motion_;
};

}  // namespace

PassSteps find_pass_steps(const BandPoints& points, const Band& band, std::span<const std::uint16_t> passes) {
  PassSteps out;
  if (passes.empty()) return out;
  const std::vector<std::size_t> pass_of = list_passes(points, band, passes, out.passes);
  if (out.passes.empty()) return out;
  const std::vector<Cell> cells = find_levels(points, band, pass_of, out.passes);
  MotionFit fit(cells, out.passes.size());
  out.before = fit.rms();
  fit.solve();
  out.after = fit.rms();
  out.unexplained = std::sqrt(std::max(0.0, std::pow(out.after, 2) - std::pow(fit.expected_rms(), 2)));
  for (std::size_t k = 0; k < out.passes.size(); ++k) {
    out.passes[k].shift_S = fit.motion().segment<3>(static_cast<Eigen::Index>(6 * k));
    out.passes[k].turn_S = fit.motion().segment<3>(static_cast<Eigen::Index>(6 * k + 3));
  }
  for (const Cell& cell : cells)
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
