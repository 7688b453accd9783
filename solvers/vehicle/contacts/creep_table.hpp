// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/vehicle/contacts/creep_law.hpp"

namespace treadmark::vehicle {

/// Nodes of a table of creep forces, and the elements of the problems solved at them.
struct CreepTableOptions {
  int intervals = 12;       ///< from no creepage to an infinite one, along each of its axes
  int ratio_intervals = 8;  ///< of the logarithm of a/b
  double greatest_ratio =
      16.0;              ///< a/b from 1/this to this; beyond, forces are those of the ellipse of equal area there
  int nx = 24, ny = 16;  ///< elements over the axes of the ellipse; a second solution has twice the first number
};

/// Forces and moment of creepages, normalised: c = sqrt(ab), creepages (xi, eta, c phi) G c^2/(mu F_n), forces over
/// mu F_n, the moment over mu F_n c.
struct NormalisedCreep {
  std::array<double, 3> force{};                 ///< F_x, F_y, M_n
  std::array<std::array<double, 3>, 2> slope{};  ///< of F_x, F_y by the creepages
};

/// Steady creep forces of the exact theory (Kalker 1979, 1990) over Hertzian ellipses of equal bodies, by longitudinal,
/// lateral creepage, spin and ratio of the semi-axes, as in Kalker's tables for simulations (1996). Between the nodes
/// they run with continuous slopes by all four. Its axes are those of the ball onto which all creepages are mapped
/// smoothly, infinite ones onto its surface, where everything slides: no creepage lies outside, and directions are
/// resolved evenly however large a creepage is. One table is for one Poisson's ratio; mu, load, size and shear modulus
/// do not count. Immutable: any number of threads.
class CreepTable {
 public:
  /// values, slopes (without creepage): as build_creep_table finds them. Errors: Error(configuration) for options
  /// without meaning; Error(input_data) for other numbers of values or ones that are not finite.
  CreepTable(double poisson, const CreepTableOptions& options, std::vector<double> values, std::vector<double> slopes);

  double poisson() const { return poisson_; }
  const CreepTableOptions& options() const { return options_; }
  const std::vector<double>& values() const { return values_; }
  const std::vector<double>& slopes() const { return slopes_; }
  /// ratio: a/b. |F| <= 1.
  NormalisedCreep at(double ratio, const std::array<double, 3>& creepage) const;

  void save(ByteWriter& out) const;
  /// Errors: Error(input_data) for bytes that are not those of a table.
  static std::shared_ptr<const CreepTable> read(ByteReader& in);

 private:
  std::size_t node(int ratio, int k, int j, int i) const;

  double poisson_;
  CreepTableOptions options_;
  std::vector<double> values_, slopes_;  ///< as found
  std::vector<double> nodes_;            ///< with one more beyond each end of every axis
  std::vector<double> corrections_;      ///< of slopes without creepage
};

/// Solves all nodes, in parallel; the same table for any number of threads. report: (finished, all) parts, one call at
/// a time. Errors: Error(configuration) for options without meaning or Poisson's ratio outside 0 ... 0.5;
/// Error(numerical) where a node has no solution.
std::shared_ptr<const CreepTable> build_creep_table(
    double poisson, const CreepTableOptions& options = {},
    const std::function<void(std::size_t finished, std::size_t all)>& report = {});

/// As solved for the table, by elements: the two solutions extrapolated to vanishing ones. What the nodes are made of,
/// and what they are compared with.
std::array<double, 3> solved_creep(double poisson, double ratio, const std::array<double, 3>& creepage, int nx, int ny);

/// Forces from the table instead of creep_force() of the linear theory. Power is what the creepages put in; the damping
/// is the table's slope, never negative. Errors: Error(configuration) unless a, b > 0.
CreepForce creep_force(const CreepTable& table, const CreepContact& contact, const CombinedMaterial& material,
                       const wheelrail::ContactKinematics& creepage);

/// Errors: Error(configuration) for bodies that the table is not for: elastic constants that differ much (|K| > 0.01),
/// interface layers, viscoelasticity.
void require_tabulated(const Material& material);

}  // namespace treadmark::vehicle
