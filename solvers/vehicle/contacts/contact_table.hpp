// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::vehicle {

/// A smooth curve through points: quadratic pieces, two between neighbours, with continuous slope (Schumaker 1983).
/// Between two points whose slopes embrace the chord's the slope is monotone, so that kinks in the data make no
/// overshoot. Beyond the ends it runs on straight. Immutable: any number of threads.
class ShapeCurve {
 public:
  struct Point {
    double value = 0.0, slope = 0.0;
  };

  /// x: increasing, at least two. Errors: Error(configuration) for other sizes or order.
  ShapeCurve(std::vector<double> x, std::vector<double> value, std::vector<double> slope);
  /// Slopes such that the curve rises and falls only where the data do (Fritsch and Butland 1984).
  static ShapeCurve monotone(std::vector<double> x, std::vector<double> value);

  Point at(double x) const { return at(x, piece(x)); }
  /// Of curves through the same places x the piece is looked for once.
  std::size_t piece(double x) const { return piece_at(x_, x); }
  Point at(double x, std::size_t piece) const;

 private:
  std::vector<double> x_, value_, slope_;
};

/// Angles at which a table has sheets: rolls from -most to most, yaws from 0 to most, since a round wheel on a
/// prismatic rail knows no sign of it. No intervals: one sheet for angle 0, without a limit.
struct TableAngles {
  double most = 0.0;  ///< [rad]
  int intervals = 0;  ///< of rolls none, or two and more

  /// Of a node [rad].
  double at(int node, bool both_sides) const {
    if (intervals == 0) return 0.0;
    const double share = static_cast<double>(node) / intervals;
    return most * (both_sides ? 2.0 * share - 1.0 : share);
  }
  bool covers(double angle) const { return intervals == 0 || std::abs(angle) <= most; }
  friend bool operator==(const TableAngles&, const TableAngles&) = default;
};

struct ContactTableOptions {
  double lateral_range = 12e-3;  ///< of the wheel against the rail, to both sides of its central position [m]
  double step = 0.25e-3;         ///< [m]; finer where the contact angle changes fast
  double element_size = 0.5e-3;  ///< of the contact problems, dx = ds [m]
  /// Loads over the reference load, increasing. One: a Hertzian spring. More: its stiffness follows the profiles from
  /// load to load.
  std::vector<double> relative_loads = {0.3, 0.6, 1.0, 2.0};
  TableAngles roll = {};  ///< of the wheel against the rail
  TableAngles yaw = {};   ///< of the wheelset
};

/// Contact under one load at one lateral displacement of the wheel against the rail; right-hand side, track axes.
struct ContactUnderLoad {
  double z = 0.0;                       ///< displacement of the wheel downwards [m]
  double elastic_energy = 0.0;          ///< [J]
  double slope = 0.0;                   ///< tangent of the contact angle [-]
  double wheel_y = 0.0, wheel_z = 0.0;  ///< contact place on the undeformed wheel, from the wheel's profile origin [m]
  double area = 0.0;                    ///< of contact [m2]
  double aspect_ratio = 1.0;            ///< a/b of the equivalent ellipse, a in the rolling direction [-]
};

/// All loads at one lateral displacement.
struct ContactTableColumn {
  double y = 0.0;  ///< [m]
  std::vector<ContactUnderLoad> under;
};
/// By increasing y.
using ContactTableColumns = std::vector<ContactTableColumn>;

/// How a contact grows from the load before to its own one.
struct LoadLevel {
  double load = 0.0;       ///< vertical [N]
  ShapeCurve compression;  ///< vertical approach since the level before [m]; first level: since Hertzian first touch
  ShapeCurve area;         ///< of contact at this load [m2]
  ShapeCurve log_aspect_ratio;  ///< ln(a/b) at this load
};

/// Curves over the lateral displacement y at one roll and yaw.
struct ContactSheet {
  double roll = 0.0;                ///< [rad]
  double y_min = 0.0, y_max = 0.0;  ///< [m]
  /// Height of the first level less its elastic energy over its load [m]. Its slope is the tangent of the contact angle
  /// there.
  ShapeCurve energy_height;
  ShapeCurve wheel_y, wheel_z;
  std::vector<LoadLevel> levels;
};

/// Contact of a round wheel and a prismatic rail under a few loads, against their lateral displacement y, at one or
/// several rolls and yaws, everything else at rest. Several patches count as one contact that has their load and
/// energy: its place is where their resultant acts, its area their sum, its aspect ratio their mean by load. Immutable:
/// one table serves both rails, any number of wheels and threads.
class ContactTable {
 public:
  /// sheets: columns at every roll and yaw, all yaws of the first roll first, each with the contact under every load;
  /// reference_level: whose contact places are taken. problem: of which track, wheelset, material and friction count;
  /// nominal: its placement at rest. Errors: Error(configuration) for less than two columns, loads or compressions that
  /// do not increase, other numbers of sheets or angles without meaning.
  ContactTable(const std::vector<ContactTableColumns>& sheets, const TableAngles& roll, const TableAngles& yaw,
               const std::vector<double>& loads, std::size_t reference_level, wheelrail::Problem problem,
               const wheelrail::Placement& nominal);
  /// One sheet.
  ContactTable(const ContactTableColumns& columns, const std::vector<double>& loads, std::size_t reference_level,
               wheelrail::Problem problem, const wheelrail::Placement& nominal)
      : ContactTable(std::vector<ContactTableColumns>{columns}, {}, {}, loads, reference_level, std::move(problem),
                     nominal) {}

  /// What all sheets have in common, with room for the places between rolls.
  double y_min() const { return y_min_; }
  double y_max() const { return y_max_; }
  const TableAngles& roll() const { return roll_; }
  const TableAngles& yaw() const { return yaw_; }
  const wheelrail::Problem& problem() const { return problem_; }
  const wheelrail::Placement& nominal() const { return nominal_; }

  const std::vector<ContactSheet>& sheets() const { return sheets_; }
  const ContactSheet& sheet(int roll, int yaw) const {
    return sheets_[static_cast<std::size_t>(roll * (yaw_.intervals + 1) + yaw)];
  }
  static constexpr std::size_t kMostLevels = 8;

 private:
  double y_min_ = -std::numeric_limits<double>::infinity(), y_max_ = -y_min_;
  TableAngles roll_, yaw_;
  wheelrail::Problem problem_;
  wheelrail::Placement nominal_;
  std::vector<ContactSheet> sheets_;
};

/// What of a pair's problem a table is made for; tables for the same surfaces, load, options and the same of these are
/// the same.
wheelrail::Problem table_problem(wheelrail::Problem prototype, const ContactTableOptions& options = {});

/// Solves the contact at every lateral displacement of the range, at every roll and yaw, in parallel. A sheet covers
/// those round the central position that have a solution. prototype: material, friction, track and wheelset of a
/// right-hand pair; states and irregularities do not count. Errors: Error(configuration) for a left-hand prototype,
/// bodies that are not round and prismatic, a curved track, rollers and options without meaning; Error(numerical) if
/// the bodies do not touch in the central position.
std::shared_ptr<const ContactTable> build_contact_table(const wheelrail::Geometry& geometry,
                                                        const wheelrail::Problem& prototype, double reference_load,
                                                        const ContactTableOptions& options = {});

/// Its two halves: the first takes long, the second none of it. One set of columns for each sheet.
std::vector<ContactTableColumns> solve_contact_sheets(const wheelrail::Geometry& geometry,
                                                      const wheelrail::Problem& prototype, double reference_load,
                                                      const ContactTableOptions& options = {},
                                                      const Progress& progress = {});
std::shared_ptr<const ContactTable> contact_table_of(const std::vector<ContactTableColumns>& sheets,
                                                     const wheelrail::Geometry& geometry,
                                                     const wheelrail::Problem& prototype, double reference_load,
                                                     const ContactTableOptions& options = {});

void write_sheets(const std::vector<ContactTableColumns>& sheets, ByteWriter& out);
/// Errors: Error(input_data) for bytes that end too early.
std::vector<ContactTableColumns> read_sheets(ByteReader& in);

}  // namespace treadmark::vehicle
