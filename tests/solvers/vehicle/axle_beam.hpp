// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/vehicle/flexible_axle.hpp"
#include "treadmark/solvers/vehicle/track/beam_element.hpp"

namespace treadmark::testing {

/// Oracle of flexible wheelsets: a steel axle of round sections by finite elements, with rigid discs, at rest.
class AxleBeam {
 public:
  struct Section {
    double from, to, diameter;  ///< [m]
  };
  struct Disc {
    double y, mass, diametral, polar;  ///< [m], [kg], [kg m2]
  };

  AxleBeam(const std::vector<Section>& sections, const std::vector<Disc>& discs, double density, double element,
           double shear_coefficient = 6.0 * (1.0 + kPoisson) / (7.0 + 6.0 * kPoisson)) {
    std::set<double> cuts;
    for (const Section& s : sections) cuts.insert({s.from, s.to});
    for (const Disc& d : discs) cuts.insert(d.y);
    for (auto at = cuts.begin(); std::next(at) != cuts.end(); ++at) {
      const double length = *std::next(at) - *at;
      const int count = std::max(1, static_cast<int>(std::lround(length / element)));
      for (int i = 0; i < count; ++i) y_.push_back(*at + length * i / count);
    }
    y_.push_back(*cuts.rbegin());
    const auto n = static_cast<Eigen::Index>(y_.size());
    mass_ = stiffness_ = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    polar_ = twist_ = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double l = y_[at + 1] - y_[at], middle = 0.5 * (y_[at] + y_[at + 1]);
      const auto section =
          ranges::find_if(sections, [&](const Section& s) { return s.from < middle && middle < s.to; });
      const double d2 = section->diameter * section->diameter, area = std::numbers::pi / 4.0 * d2, i2 = area * d2 / 16;
      const vehicle::BeamElement beam({kYoung * i2, shear_coefficient * kShear * area, density * area, density * i2, 0},
                                      l);
      stiffness_.block<4, 4>(2 * i, 2 * i) += beam.stiffness();
      mass_.block<4, 4>(2 * i, 2 * i) += beam.mass();
      Eigen::Matrix2d k, m;
      k << 1, -1, -1, 1;
      m << 2, 1, 1, 2;
      twist_.block<2, 2>(i, i) += kShear * 2.0 * i2 / l * k;
      polar_.block<2, 2>(i, i) += density * 2.0 * i2 * l / 6.0 * m;
    }
    for (const Disc& d : discs) {
      const Eigen::Index i = node(d.y);
      mass_(2 * i, 2 * i) += d.mass;
      mass_(2 * i + 1, 2 * i + 1) += d.diametral;
      polar_(i, i) += d.polar;
    }
  }

  /// Elastic modes: bending in one plane, torsion, without rigid motions, by frequency; shapes with unit modal mass.
  struct Modes {
    std::vector<double> omega;
    Eigen::MatrixXd shape;
  };
  Modes bending() const { return solve(stiffness_, mass_, 2); }
  Modes torsion() const { return solve(twist_, polar_, 1); }

  /// The first modes as a vehicle file has them. Bending is scaled to a displacement of 1 in its largest place, torsion
  /// to a rotation of 1 of the right wheel.
  FlexibleAxle axle(double wheel_distance, double wheel_polar, const std::vector<double>& places, int bending_count,
                    int torsion_count, double damping_ratio) const {
    FlexibleAxle out{"test", wheel_distance, wheel_polar, places, {}, {}, {}};
    const Modes b = bending(), t = torsion();
    for (int i = 0; i < bending_count; ++i) {
      const double omega = b.omega[static_cast<std::size_t>(i)];
      BendingMode mode;
      double largest = 0.0;
      for (const double y : places)
        if (const double w = b.shape(2 * node(y), i); std::abs(w) > std::abs(largest) * (1.0 + 1e-9)) largest = w;
      for (const double y : places) {
        mode.shape.push_back(b.shape(2 * node(y), i) / largest);
        mode.slope.push_back(b.shape(2 * node(y) + 1, i) / largest);
      }
      mode.mass = 1.0 / (largest * largest);
      mode.stiffness = mode.mass * omega * omega;
      mode.damping = 2.0 * damping_ratio * mode.mass * omega;
      out.bending.push_back(mode);
    }
    for (int i = 0; i < torsion_count; ++i) {
      const double omega = t.omega[static_cast<std::size_t>(i)];
      const double left = t.shape(node(-0.5 * wheel_distance), i), right = t.shape(node(0.5 * wheel_distance), i);
      const double inertia = 1.0 / (right * right);
      out.torsion.push_back(
          {inertia, inertia * omega * omega, 2.0 * damping_ratio * inertia * omega, {left / right, 1.0}, {}});
    }
    return out;
  }

  /// Deflections and rotations under forces F at y = +-box, downwards, on wheels whose centres do not move.
  Eigen::VectorXd loaded(double force, double box, double wheel) const {
    Eigen::MatrixXd k = stiffness_;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(k.rows());
    f[2 * node(-box)] = f[2 * node(box)] = force;
    constexpr double kRigid = 1e15;
    for (const double y : {-wheel, wheel}) k(2 * node(y), 2 * node(y)) += kRigid;
    return k.ldlt().solve(f);
  }

  Eigen::Index node(double y) const {
    const auto nearest = ranges::min_element(y_, {}, [&](double at) { return std::abs(at - y); });
    return nearest - y_.begin();
  }
  double total_mass() const { return rigid(mass_, 0); }
  /// About a horizontal diameter through its middle.
  double transverse_inertia() const { return rigid(mass_, 1); }
  double polar_inertia() const { return polar_.sum(); }

  static constexpr double kYoung = 2.1e11, kPoisson = 0.3, kShear = kYoung / (2.0 * (1.0 + kPoisson));

 private:
  static Modes solve(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m, Eigen::Index rigid_motions) {
    // From the largest of 1/(omega^2 + shift): exact also where there is next to no mass.
    constexpr double kShift = 1e4;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(m, k + kShift * m);
    Modes modes;
    const Eigen::Index last = k.rows() - 1 - rigid_motions, count = std::min<Eigen::Index>(6, last + 1);
    modes.shape.resize(k.rows(), count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const double value = solver.eigenvalues()[last - i];
      modes.omega.push_back(std::sqrt(1.0 / value - kShift));
      modes.shape.col(i) = solver.eigenvectors().col(last - i) / std::sqrt(value);
    }
    return modes;
  }
  double rigid(const Eigen::MatrixXd& m, int turn) const {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(m.rows());
    for (std::size_t i = 0; i < y_.size(); ++i) {
      motion[2 * static_cast<Eigen::Index>(i)] = turn ? y_[i] : 1.0;
      motion[2 * static_cast<Eigen::Index>(i) + 1] = turn;
    }
    return motion.dot(m * motion);
  }

  std::vector<double> y_;
  Eigen::MatrixXd mass_, stiffness_, polar_, twist_;
};

/// The wheelset of examples/vehicles/manchester-flexible.toml (docs/flexible-wheelset.md): a solid axle, and wheels and
/// boxes with what is left of the rigid wheelset's 1813 kg, 1120 and 112 kg m2.
inline AxleBeam manchester_axle(double* wheel_polar = nullptr, double element = 0.01) {
  const std::vector<AxleBeam::Section> sections{
      {-1.10, -0.84, 0.13}, {-0.84, -0.66, 0.185}, {-0.66, 0.66, 0.16}, {0.66, 0.84, 0.185}, {0.84, 1.10, 0.13}};
  constexpr double kDensity = 7850.0, kWheel = 0.75, kBox = 1.0;
  const auto with = [&](double wheel, double box, double polar) {
    std::vector<AxleBeam::Disc> discs;
    for (const double side : {-1.0, 1.0}) {
      discs.push_back({side * kWheel, wheel, 0.5 * polar, polar});
      discs.push_back({side * kBox, box, 0.0, 0.0});
    }
    return AxleBeam(sections, discs, kDensity, element);
  };
  const AxleBeam bare = with(0.0, 0.0, 0.0);
  const double polar = 0.5 * (112.0 - bare.polar_inertia());
  const double mass = 0.5 * (1813.0 - bare.total_mass()), inertia = 0.5 * (1120.0 - bare.transverse_inertia() - polar);
  // mass = wheel + box, inertia = wheel 0.75^2 + box
  const double wheel = (mass * kBox * kBox - inertia) / (kBox * kBox - kWheel * kWheel);
  if (wheel_polar) *wheel_polar = polar;
  return with(wheel, mass - wheel, polar);
}

}  // namespace treadmark::testing
