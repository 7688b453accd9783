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
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kBlock = 8192;
constexpr int kMostRounds = 25;

constexpr std::size_t kMotions = 4, kColumns = 6;

/// d = distance from the section along its normal, j = change of d by the four (wheel) or two (rail) motions, and
/// in the last two columns what of those is the same at all stations.
struct Residual {
  double d = 0.0;
  std::array<double, kColumns> j{};
  double s = -1.0;  ///< < 0: not near the section
};

struct Knots {
  Knots(double length, double spacing)
      : intervals(to_whole<std::size_t>(std::max(2.0, std::round(length / spacing)))),
        apart(length / static_cast<double>(intervals)) {}

  std::size_t intervals;
  double apart;

  struct Place {
    std::size_t interval;
    std::array<double, 4> basis;
  };
  Place at(double s) const {
    const std::size_t k = std::min(intervals - 1, to_whole<std::size_t>(s / apart));
    return {k, cubic_basis(s / apart - static_cast<double>(k))};
  }
};

/// Normal equations of a spline along the section and of the motions.
struct NormalSums {
  explicit NormalSums(std::size_t intervals)
      : banded(intervals + 3), mixed(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(intervals + 3), kColumns)) {
    section_rhs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(intervals + 3));
  }

  std::vector<std::array<double, 4>> banded;  ///< row f, column f + k
  Eigen::MatrixXd mixed;
  Eigen::VectorXd section_rhs;
  Eigen::Matrix<double, kColumns, kColumns> motions = Eigen::Matrix<double, kColumns, kColumns>::Zero();
  Eigen::Vector<double, kColumns> motions_rhs = Eigen::Vector<double, kColumns>::Zero();
  double near = 0.0, used = 0.0, weight = 0.0, square = 0.0, slope = 0.0;

  /// x: the distance over Tukey's limit, below 1.
  void add(const Residual& r, double x, const Knots& knots) {
    const double w = (1.0 - x * x) * (1.0 - x * x);
    const Knots::Place place = knots.at(r.s);
    const Eigen::Map<const Eigen::Vector<double, kColumns>> j(r.j.data());
    for (std::size_t i = 0; i < 4; ++i) {
      const double wb = w * place.basis[i];
      const auto row = static_cast<Eigen::Index>(place.interval + i);
      for (std::size_t k = i; k < 4; ++k) banded[place.interval + i][k - i] += wb * place.basis[k];
      mixed.row(row) += wb * j.transpose();
      section_rhs[row] += wb * r.d;
    }
    motions += w * j * j.transpose();
    motions_rhs += w * r.d * j;
    used += 1.0;
    weight += w;
    square += w * w * r.d * r.d;
    slope += (1.0 - x * x) * (1.0 - 5.0 * x * x);
  }

  NormalSums& operator+=(const NormalSums& other) {
    for (std::size_t f = 0; f < banded.size(); ++f)
      for (std::size_t k = 0; k < 4; ++k) banded[f][k] += other.banded[f][k];
    mixed += other.mixed;
    section_rhs += other.section_rhs;
    motions += other.motions;
    motions_rhs += other.motions_rhs;
    near += other.near;
    used += other.used;
    weight += other.weight;
    square += other.square;
    slope += other.slope;
    return *this;
  }

  /// With a little stiffness, for strips without points.
  Eigen::MatrixXd section_matrix() const {
    const auto size = static_cast<Eigen::Index>(banded.size());
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index f = 0; f < size; ++f)
      for (Eigen::Index k = 0; k < std::min<Eigen::Index>(4, size - f); ++k)
        out(f, f + k) = out(f + k, f) = banded[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)];
    constexpr double kStiffness = 1e-6;
    const double stiffness = kStiffness * out.trace() / static_cast<double>(size);
    for (Eigen::Index k = 1; k + 1 < size; ++k) {
      const Eigen::Vector3d bend(1.0, -2.0, 1.0);
      out.block<3, 3>(k - 1, k - 1) += stiffness * bend * bend.transpose();
    }
    return out;
  }
};

struct Equations {
  Eigen::Matrix4d matrix;
  Eigen::Vector4d rhs;
};
/// Equations of the motions alone. follows: what of the columns the spline takes up.
Equations of_motions(const NormalSums& sum, const Eigen::MatrixXd& follows) {
  const Eigen::MatrixXd all = sum.motions - sum.mixed.transpose() * follows;
  const Eigen::VectorXd rhs = sum.motions_rhs - follows.transpose() * sum.section_rhs;
  constexpr Eigen::Index kMotion = kMotions, kSame = kColumns - kMotions;
  // little is left of what is the same at all stations: nothing where the spline takes it up to rounding errors
  const Eigen::Matrix2d same = all.bottomRightCorner<kSame, kSame>();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(same);
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
  for (Eigen::Index k = 0; k < kSame; ++k)
    if (eigen.eigenvalues()[k] > 1e-12 * sum.weight)
      inverse += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / eigen.eigenvalues()[k];
  const Eigen::Matrix<double, kMotion, kSame> gain = all.topRightCorner<kMotion, kSame>() * inverse;
  return {all.topLeftCorner<kMotion, kMotion>() - gain * all.bottomLeftCorner<kSame, kMotion>(),
          rhs.head<kMotion>() - gain * rhs.tail<kSame>()};
}

Pose moved(const Pose& X_CS, Body body, const Eigen::Vector4d& step) {
  const bool wheel = body == Body::wheel;
  const Vec3 shift = wheel ? Vec3(step[0], 0.0, step[1]) : Vec3::Zero();
  const Vec3 turn = wheel ? Vec3(step[2], 0.0, step[3]) : Vec3(0.0, step[0], step[1]);
  const double angle = turn.norm();
  const Mat3 rotation = angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, turn / angle)) : Mat3::Identity();
  return X_CS * Pose{shift, rotation};
}

/// follows: what of the motions a spline of distances along the section takes up. The section moves the other way; as
/// far as it does so rigidly, its shift in v at y = 0 and its turn.
Eigen::Matrix<double, 2, 4> moves_of(const Section& section, const Knots& knots, const Eigen::MatrixXd& follows) {
  constexpr double kStep = 0.5e-3;
  const double middle = section.v_at(0.5 * (section.y_min() + section.y_max()));
  Mat3 matrix = Mat3::Zero();
  Eigen::Matrix<double, 3, 4> rhs = Eigen::Matrix<double, 3, 4>::Zero();
  for (double s = 0.5 * kStep; s < section.length(); s += kStep) {
    const Section::Point at = section.at(s);
    const Vec3 rigid(at.normal.x(), at.normal.y(),
                     at.position.x() * at.normal.y() - (at.position.y() - middle) * at.normal.x());
    const Knots::Place place = knots.at(s);
    Eigen::RowVector4d distance = Eigen::RowVector4d::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      distance -= place.basis[i] * follows.row(static_cast<Eigen::Index>(place.interval + i)).head<kMotions>();
    matrix += rigid * rigid.transpose();
    rhs += rigid * distance;
  }
  const Eigen::Matrix<double, 3, 4> rigid = matrix.ldlt().solve(rhs);
  return rigid.bottomRows<2>();
}

/// Standard errors by the covariance.
void set_errors(RefinedAxis& refined, Body body) {
  const auto root = [&](Eigen::Index i) {
    return std::sqrt(std::max(refined.covariance(i, i) + refined.covariance(i + 1, i + 1), 0.0));
  };
  refined.position_error = body == Body::wheel ? root(0) : 0.0;
  refined.direction_error = body == Body::wheel ? root(2) : root(0);
}

}  // namespace

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

namespace {

constexpr double kKnots = 4e-3;

/// Moves the axis and the section by turns until both stand still.
class AxisFit {
 public:
  AxisFit(std::span<const Vec3> points, Body body, const Pose& start) : points_(points), body_(body) {
    out_.X_CS = start;
    section_ = outline(across(points, body, start));
  }

  RefinedAxis fitted() {
    for (int round = 0; round < kMostRounds && !still_; ++round) {
      out_.iterations = round + 1;
      fit_section_of(round);
      find_residuals();
      if (!find_scale()) break;
      move(sums(), round);
      constexpr double kNearest = 1e-3;
      reach_ = std::max(kNearest, std::min(reach_, std::max(8.0 * scale_, 5e-3)));
    }
    find_covariance();
    if (wheel_) out_.section_moves = moves_of(section_, {section_.length(), kKnots}, follows_);
    out_.fit = fit_section(section_, across(points_, body_, out_.X_CS), 5e-3, 2e-3);
    return std::move(out_);
  }

 private:
  void fit_section_of(int round) {
    const bool large_steps = round < 4;
    const std::vector<Vec2> heap = across(points_, body_, out_.X_CS);
    if (round > 0 && large_steps) section_ = outline(heap);
    out_.fit = fit_section(section_, heap, reach_, kKnots, large_steps ? 2 : 1);
    section_ = out_.fit.section;
  }

  void find_residuals() {
    residuals_.assign(points_.size(), {});
    parallel_blocks(points_.size(), kBlock, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        const Vec3 p = out_.X_CS.apply_inverse(points_[i]);
        const Natural n = natural(body_, p);
        const auto foot = section_.foot({n.y, n.v}, reach_);
        if (!foot) continue;
        const Section::Point at = section_.at(foot->s);
        const Vec3 normal = direction(body_, n.u, at.normal);
        const Vec3 turn = p.cross(normal);
        const double lever = wheel_ ? at.position.x() * at.normal.y() - at.position.y() * at.normal.x() : at.normal.x();
        residuals_[i] = {foot->distance,
                         wheel_ ? std::array{normal.x(), normal.z(), turn.x(), turn.z(), at.normal.y(), lever}
                                : std::array{turn.y(), turn.z(), 0.0, 0.0, at.normal.y(), lever},
                         foot->s};
      }
    });
  }

  bool find_scale() {
    std::vector<double> sizes;
    sizes.reserve(residuals_.size());
    for (const Residual& r : residuals_)
      if (r.s >= 0.0) sizes.push_back(std::fabs(r.d));
    if (sizes.empty()) return false;
    scale_ = std::max(kMad * median_of(sizes), 1e-7);
    return true;
  }

  /// What is the same all along the wheel or rail is the section's matter: a spline along the section is fitted to
  /// distances and their changes alike, and what the section's normal makes of these besides. Else how the normal turns
  /// between two knots, with what the spline misses of the section there, would pass for what a short arc says of the
  /// axis.
  NormalSums sums() const {
    const Knots knots(section_.length(), kKnots);
    const std::size_t blocks = (residuals_.size() + kBlock - 1) / kBlock;  // summed one by one, then in their order
    std::vector<NormalSums> block_sums(blocks, NormalSums(knots.intervals));
    parallel_blocks(residuals_.size(), kBlock, [&](std::size_t from, std::size_t to) {
      NormalSums& own = block_sums[from / kBlock];
      for (std::size_t i = from; i < to; ++i) {
        if (residuals_[i].s < 0.0) continue;
        own.near += 1.0;
        const double x = residuals_[i].d / (kTukey * scale_);
        if (std::fabs(x) < 1.0) own.add(residuals_[i], x, knots);
      }
    });
    NormalSums out(knots.intervals);
    for (const NormalSums& own : block_sums) out += own;
    return out;
  }

  void move(const NormalSums& sum, int round) {
    out_.undamaged = sum.used / sum.near;
    const Eigen::LDLT<Eigen::MatrixXd> section_of(sum.section_matrix());
    follows_ = section_of.solve(sum.mixed);
    const auto [matrix, rhs] = of_motions(sum, follows_);
    // covariance of an M-estimate (Huber 1981): n sum(psi^2) / sum(psi')^2 times the inverse of the plain normal matrix
    information_ = matrix * (sum.used / sum.weight) * (sum.slope * sum.slope) / std::max(sum.used * sum.square, 1e-30);
    // motions that the scan says nothing about stay as they are
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix.topLeftCorner(unknowns_, unknowns_));
    Eigen::VectorXd step = Eigen::VectorXd::Zero(4);
    for (Eigen::Index k = 0; k < unknowns_; ++k)
      if (eigen.eigenvalues()[k] > 1e-12 * eigen.eigenvalues()[unknowns_ - 1])
        step.head(unknowns_) +=
            eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).dot(rhs.head(unknowns_)) / eigen.eigenvalues()[k];
    out_.X_CS = moved(out_.X_CS, body_, step);
    constexpr double kMemory = 0.7;
    last_ = step;
    moving_ = kMemory * moving_ + (1.0 - kMemory) * last_;
    still_ = round > 4 && step.cwiseAbs().maxCoeff() < 1e-8;
    if (still_) moving_.setZero();
  }

  /// What still moves one way may be as far from its end as it would get in some rounds more; what goes to and fro, as
  /// points at the ends of the section come and go, is there.
  void find_covariance() {
    constexpr double kRoundsMore = 10.0;
    const Eigen::Vector4d off = kRoundsMore * moving_.cwiseAbs() + last_.cwiseAbs();
    out_.covariance.topLeftCorner(unknowns_, unknowns_) =
        information_.topLeftCorner(unknowns_, unknowns_).ldlt().solve(Eigen::MatrixXd::Identity(unknowns_, unknowns_));
    out_.covariance.diagonal() += off.cwiseAbs2();
    set_errors(out_, body_);
  }

  std::span<const Vec3> points_;
  Body body_;
  bool wheel_ = body_ == Body::wheel, still_ = false;
  Eigen::Index unknowns_ = wheel_ ? 4 : 2;
  Section section_;
  double reach_ = 20e-3;  ///< the rough axis smears the section
  double scale_ = 0.0;
  std::vector<Residual> residuals_;
  Eigen::Matrix4d information_ = Eigen::Matrix4d::Identity();
  Eigen::Vector4d moving_ = Eigen::Vector4d::Zero(), last_ = moving_;  ///< mean of the last few steps, and the last one
  Eigen::MatrixXd follows_;                                            ///< coefficients along the section by motions
  RefinedAxis out_;
};

}  // namespace

RefinedAxis refine_axis(std::span<const Vec3> points, Body body, const Pose& start) {
  return AxisFit(points, body, start).fitted();
}

void use_known(RefinedAxis& refined, const KnownOfSection& known, std::span<const Vec3> points) {
  Eigen::Vector4d step = Eigen::Vector4d::Zero();
  Eigen::Matrix4d& covariance = refined.covariance;
  for (Eigen::Index k = 0; k < 2; ++k) {  // one after the other is the same as together
    if (!std::isfinite(known.error[k])) continue;
    Eigen::Vector4d h = refined.section_moves.row(k);
    if (k == 0) h += known.y * refined.section_moves.row(1).transpose();
    const Eigen::Vector4d spread = covariance * h;
    const Eigen::Vector4d gain = spread / (h.dot(spread) + known.error[k] * known.error[k]);
    step += gain * (known.lacking[k] - h.dot(step));
    covariance -= gain * spread.transpose();
  }
  refined.X_CS = moved(refined.X_CS, Body::wheel, step);
  const std::vector<Vec2> section = across(points, Body::wheel, refined.X_CS);
  refined.fit = fit_section(outline(section), section, 5e-3, 2e-3);
  set_errors(refined, Body::wheel);
}

}  // namespace treadmark::scans
