// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "treadmark/model/flexible_track.hpp"
#include "treadmark/solvers/vehicle/banded_symmetric.hpp"
#include "treadmark/solvers/vehicle/beam_element.hpp"

namespace treadmark::vehicle {

/// One rail of a flexible track in equations of motion, M q'' + C q' + K q = f: beam elements, and a coordinate more
/// for each sleeper. All matrices are symmetric with a narrow band, as coordinates are numbered along the rail.
/// Immutable; safe to use from several threads.
class RailOnSeats {
 public:
  /// Errors: Error(configuration) for a track that makes no sense.
  explicit RailOnSeats(const FlexibleTrack& track);

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

  /// What a place of the rail moves by: deflection = sum of values[i] q[first[i]], and what is deflected there beyond.
  struct Place {
    std::array<int, 4> coordinate{};
    BeamVector value = BeamVector::Zero(), slope = BeamVector::Zero();  ///< slope: of the deflection there [1/m]
    double own_compliance = 0.0;                                        ///< [m/N]
    double own_compliance_slope = 0.0;                                  ///< [1/N]
  };
  /// x [m], between begin() and end().
  Place place(double x) const;

  /// Deflection under a force of 1 N at the same place, one for each of the places, frequency [Hz] >= 0. Positive
  /// imaginary parts would be motion ahead of the force. Errors: Error(numerical) where nothing holds the rail or an
  /// undamped one resonates.
  std::vector<std::complex<double>> receptance(std::span<const double> x, double frequency) const;
  std::complex<double> receptance(double x, double frequency) const;
  /// Deflections at places along the rail under a force of 1 N at rest [m/N].
  std::vector<double> deflection(double force_at, std::span<const double> x) const;

 private:
  struct Node {
    double x = 0.0;
    int first = 0;  ///< coordinate of its deflection; that of its rotation follows
  };
  std::size_t element_at(double x) const;
  double part_of(std::size_t element, double x) const;

  std::vector<Node> nodes_;
  std::vector<BeamElement> elements_;
  BandedSymmetric<double> mass_, damping_, stiffness_;
  double middle_ = 0.0, middle_bay_ = 0.0;
};

}  // namespace treadmark::vehicle
