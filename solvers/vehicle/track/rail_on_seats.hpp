// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/model/vehicle/flexible_track.hpp"
#include "treadmark/solvers/vehicle/track/banded_symmetric.hpp"
#include "treadmark/solvers/vehicle/track/rail_element.hpp"

namespace treadmark::vehicle {

/// One rail of a flexible track in equations of motion of one plane, M q'' + C q' + K q = f: elements, and a coordinate
/// more for each sleeper. All matrices are symmetric with a narrow band, as coordinates are numbered along the rail.
/// Immutable; safe to use from several threads.
class RailOnSeats {
 public:
  /// No length, nearly: differences stay numbers.
  static constexpr double kAtAPoint = 1e-6;

  /// spread: length over which a moment twists the rail, and its roll there is the mean [m]; at most 0.9 of the
  /// shortest element is used. A force's own place keeps the compliance of a moment at a point at rest. Errors:
  /// Error(configuration) for a track that makes no sense.
  explicit RailOnSeats(const FlexibleTrack& track, RailPlane plane = RailPlane::vertical, double spread = kAtAPoint);

  /// How many of the last coordinates a bay more would be.
  static int bay_coordinates(RailPlane plane, int bay_elements) { return node_coordinates(plane) * bay_elements + 1; }

  int size() const { return stiffness_.size(); }
  const BandedSymmetric<double>& mass() const { return mass_; }
  const BandedSymmetric<double>& damping() const { return damping_; }
  const BandedSymmetric<double>& stiffness() const { return stiffness_; }

  /// Ends of the rail [m].
  double begin() const { return nodes_.front().x; }
  double end() const { return nodes_.back().x; }
  /// Middle of the bay, or half bay, in the middle of the track [m], and length of that bay.
  double middle() const { return middle_; }
  double middle_bay() const { return middle_bay_; }

  /// What the top moves by at a place of the rail: motions = sum of the rows value[i] q[coordinate[i]], and what forces
  /// there move it by beyond.
  struct Place {
    std::array<int, 9> coordinate{};  ///< as many as value has rows
    RailShape value;
    RailGive own_compliance, own_slope;  ///< own_slope: of it along the rail [1/m]
    /// Of a motion by a column of coordinates.
    template <class Coordinates>
    double along(Eigen::Index motion, const Coordinates& q) const {
      double sum = 0.0;
      for (Eigen::Index i = 0; i < value.rows(); ++i)
        sum += value(i, motion) * q[coordinate[static_cast<std::size_t>(i)]];
      return sum;
    }
    /// Adds a force on a motion to those of coordinates.
    template <class Coordinates, class Force>
    void spread(Eigen::Index motion, const Force& force, Coordinates& f) const {
      for (Eigen::Index i = 0; i < value.rows(); ++i)
        f[coordinate[static_cast<std::size_t>(i)]] += force * value(i, motion);
    }
  };
  /// x [m], between begin() and end().
  Place place(double x) const;

  /// Motions of the top under unit forces on them at the same place, one matrix for each of the places, frequency [Hz]
  /// >= 0. Positive imaginary parts would be motion ahead of the force. Errors: Error(numerical) where nothing holds
  /// the rail or an undamped one resonates.
  std::vector<Eigen::MatrixXcd> receptances(std::span<const double> x, double frequency) const;
  /// Of the first motion alone: deflection of the top under a force of 1 N at it.
  std::vector<std::complex<double>> receptance(std::span<const double> x, double frequency) const;
  std::complex<double> receptance(double x, double frequency) const;
  /// Of the first motion at places along the rail under a force of 1 N on it at rest [m/N].
  std::vector<double> deflection(double force_at, std::span<const double> x) const;

 private:
  struct Node {
    double x = 0.0;
    int first = 0;  ///< coordinate of its deflection; the others follow
  };
  /// Of the coordinates of an element.
  int coordinate(std::size_t element, int i) const;
  std::size_t element_at(double x) const;
  double part_of(std::size_t element, double x) const;
  RailGive own_compliance(double x) const;
  double own_roll(double x) const;
  template <class Visit>
  void each_below(double x, Visit&& visit) const;

  RailPlane plane_;
  std::vector<Node> nodes_;
  std::vector<RailElement> elements_;
  BandedSymmetric<double> mass_, damping_, stiffness_;
  std::optional<RailSideways> sideways_;
  double spread_;  ///< [m]
  double middle_ = 0.0, middle_bay_ = 0.0;
};

}  // namespace treadmark::vehicle
