// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/model/rows.hpp"
#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"
#include "treadmark/solvers/vehicle/contacts/creep_table.hpp"
#include "treadmark/solvers/vehicle/contacts/table_contact.hpp"

namespace treadmark::vehicle {

/// How far a number of a table is from the exact theory, at the points that were checked.
struct TableError {
  std::string number;            ///< "z", "normal_force", "fx", "fy", "spin_moment", "t_gamma"
  std::string over;              ///< what it is divided by; empty: z, in m
  double worst = 0.0;            ///< magnitude
  double rms = 0.0;              ///< root of the mean square
  double y = 0.0;                ///< where it was worst [m]
  double roll = 0.0, yaw = 0.0;  ///< [rad]
  double load = 0.0;             ///< vertical [N]
};

/// At which places a table is compared with the exact theory.
struct TableCheckOptions {
  int points = 200;
  int seed = 1;
  double speed = 20.0;     ///< [m/s]
  double creepage = 0.01;  ///< most, longitudinal and lateral; small ones are as frequent as great ones
};

/// What a comparison has found. Of points drawn evenly from all the table covers: with a confidence of 99 % no more
/// than `beyond` of all places have errors greater than the worst one (order statistics, Wilks 1941).
struct TableCheck {
  TableCheckOptions options;
  int compared = 0;    ///< points that both have an answer for
  int unsolved = 0;    ///< for which the exact theory has none
  int unanswered = 0;  ///< for which the table has none
  double beyond = 1.0;
  std::vector<TableError> errors;  ///< a row a number

  /// Errors: Error(configuration) for a number that is not compared.
  const TableError& of(const std::string& number) const;
};

/// One place that table and exact theory are asked for.
struct CheckedPoint {
  static constexpr std::size_t kNumbers = 6;
  double y = 0.0;                ///< of the wheel against the rail [m]
  double roll = 0.0, yaw = 0.0;  ///< [rad]
  double load = 0.0;             ///< vertical [N]
  bool solved = false;           ///< the exact theory has an answer
  bool answered = false;         ///< so has the table
  std::array<double, kNumbers> error{};
};

/// What the comparison at points has found: counts, the worst, the means. What is off by no finite number was not
/// solved: the table's own numbers are finite. Errors: Error(numerical) where no point could be compared.
TableCheck table_check_of(const TableCheckOptions& options, const std::vector<CheckedPoint>& points);

/// Errors: Error(configuration) for a check that does not hold all that table_check_of makes, as finite numbers.
void require_whole(const TableCheck& check);

/// Errors: Error(configuration) for options without meaning.
void require_sensible(const TableCheckOptions& options);

/// What a wheel on a rail is asked: how it moves, and its height or its vertical load.
struct WheelMotion {
  PairMotion motion;           ///< against the wheelset's central position and the rail at rest
  double vertical_load = 0.0;  ///< on the rail [N]; 0: the height is given
};

/// What it answers: forces with what belongs to them.
struct WheelForces {
  ContactReaction reaction;
  double t_gamma = 0.0;        ///< power of friction over speed [N]
  double contact_angle = 0.0;  ///< in track axes [rad]
  double z = 0.0;              ///< height of the wheelset, given or found [m]
};

/// Forces between one wheel and one rail from a table of contact (TableContact), within the limits of what it was
/// made from, and how far they are from the exact theory. Copies share the tables. Not thread-safe: one a thread.
class ForceTable {
 public:
  /// Errors: those of TableContact.
  ForceTable(std::shared_ptr<const ContactTable> contact, wheelrail::Side side,
             std::shared_ptr<const CreepTable> creep);

  /// Status::failed with a message outside of what the table covers: lateral place, roll, yaw, loads above the greatest
  /// one; for a wheel that slides and does not roll, and rates beyond all numbers. Without an answer, and where
  /// Status::not_converged says that no height gives the load, all numbers are NaN. Nothing is extrapolated; all forces
  /// run with the place without jumps. Errors: Error(configuration) for motions that are not finite and negative loads.
  WheelForces at(const WheelMotion& wanted);

  /// The same tables for a wheel of another side.
  ForceTable on(wheelrail::Side side) const { return {contact_, side, creep_}; }

  const ContactTable& contact() const { return *contact_; }
  const std::shared_ptr<const CreepTable>& creep() const { return creep_; }
  wheelrail::Side side() const { return side_; }
  const std::optional<TableCheck>& check() const { return check_; }
  void keep(TableCheck check) { check_ = std::move(check); }

 private:
  std::shared_ptr<const ContactTable> contact_;
  std::shared_ptr<const CreepTable> creep_;
  wheelrail::Side side_;
  TableContact element_;
  std::optional<TableCheck> check_;
};

/// Compares the table with the exact theory of a pair of the same bodies, at places that are drawn between its nodes.
/// exact: right-hand pair that the table is made for; its elements and material count, its state does not. The same
/// for any number of threads. Errors: Error(configuration) for options without meaning; Error(numerical) where no point
/// could be compared.
TableCheck check_table(const ForceTable& table, const wheelrail::Geometry& geometry, const wheelrail::Problem& exact,
                       const TableCheckOptions& options = {}, const Progress& progress = {});

}  // namespace treadmark::vehicle

namespace treadmark {
/// In this order programs in other languages give and take them; new ones stand at the end.
template <>
std::span<const Column<vehicle::WheelMotion>> columns();
template <>
std::span<const Column<vehicle::WheelForces>> columns();
template <>
std::span<const Column<vehicle::TableError>> columns();
template <>
std::span<const Column<vehicle::TableCheck>> columns();
}  // namespace treadmark
