// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
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
  /// Slopes such that the curve rises and falls only where the data do (Fritsch and Butland 1984). beside: a curve
  /// whose slope it takes over where it goes on from one of its ends.
  static ShapeCurve monotone(std::vector<double> x, std::vector<double> value, const ShapeCurve* beside = nullptr);

  Point at(double x) const { return at(x, piece_at(x_, x)); }
  /// Of curves through the same places the piece is looked for once.
  Point at(double x, std::size_t piece) const;

 private:
  std::vector<double> x_, value_, slope_;
};

/// Angles at which a table has sheets: rolls from -most to most, yaws from 0 to most, since a round wheel on a
/// prismatic rail knows no sign of it. No intervals: one sheet for angle 0, which serves what is small against 1.
struct TableAngles {
  static constexpr double kSmall = 0.2;  ///< [rad]
  double most = 0.0;                     ///< [rad]
  int intervals = 0;                     ///< of rolls none, or two and more

  /// To both sides [rad].
  double reach() const { return intervals == 0 ? kSmall : most; }
  bool covers(double angle) const { return std::abs(angle) <= reach(); }
};

/// Roll of the wheel against the rail, yaw of the wheelset [rad].
struct TableTurn {
  double roll = 0.0, yaw = 0.0;
};
/// Of all sheets of a table, all yaws of the first roll first. Errors: Error(configuration) for angles without meaning.
std::vector<TableTurn> table_turns(const TableAngles& roll, const TableAngles& yaw);

struct ContactTableOptions {
  double lateral_range = 12e-3;  ///< to both sides of the wheel's central position, before the table grows [m]
  double growth = 6e-3;          ///< of each stretch beyond; 0: the table does not grow [m]
  double step = 0.25e-3;         ///< [m]; finer where the contact angle changes fast
  double element_size = 0.5e-3;  ///< of the contact problems, dx = ds [m]; grows with what is pressed harder
  /// Loads over the reference load, increasing. One: a Hertzian spring. More: its stiffness follows the profiles from
  /// load to load, and like Hertz beyond the last one, or one above the reference that has no solution.
  std::vector<double> relative_loads = {0.3, 0.6, 1.0, 1.4, 2.0};
  std::vector<double> heavier = {3.5, 7.0, 10.0};  ///< what it grows by where a wheel is pressed harder than by these
  TableAngles roll = {};                           ///< of the wheel against the rail
  TableAngles yaw = {};                            ///< of the wheelset
};

/// What a wheel touches the rail with: a patch, or a part of one between two valleys of its pressure.
struct ContactPart {
  double share;             ///< of the normal force of the resultant; together they may exceed it
  double angle;             ///< of the contact [rad]
  double wheel_y, wheel_z;  ///< place on the undeformed wheel, from the wheel's profile origin [m]
  double area;              ///< of contact [m2]
  double log_aspect;        ///< ln(a/b) of the equivalent ellipse, a in the rolling direction
  int number = -1;          ///< in a table the same at neighbouring places and loads where it is one contact
};
constexpr std::size_t kMostParts = 3;

/// Contact under one load at one lateral displacement of the wheel against the rail; right-hand side, track axes.
struct ContactUnderLoad {
  double z = 0.0;                       ///< displacement of the wheel downwards [m]
  double elastic_energy = 0.0;          ///< [J]
  double slope = 0.0;                   ///< tangent of the contact angle [-]
  double wheel_y = 0.0, wheel_z = 0.0;  ///< contact place on the undeformed wheel, from the wheel's profile origin [m]
  std::vector<ContactPart> parts;       ///< one to kMostParts, the strongest first
};

/// All loads at one lateral displacement.
struct ContactTableColumn {
  double y = 0.0;  ///< [m]
  std::vector<ContactUnderLoad> under;
};
/// By increasing y.
using ContactTableColumns = std::vector<ContactTableColumn>;

/// What a table grows by on one side.
struct ColumnsBeyond {
  ContactTableColumns columns;  ///< less than two: it ends here
  /// Then: what the solver says where it found no contact, and where. Empty: wheel and rail part there.
  std::string unsolved = {};
};

/// How a contact grows from the load before to its own one.
struct LoadLevel {
  double load = 0.0;       ///< vertical [N]
  ShapeCurve compression;  ///< vertical approach since the level before [m]; first level: since Hertzian first touch
  std::vector<std::vector<ContactPart>> parts;  ///< at this load, by TableStretch::y
};

/// Contact at the displacements from y_min to y_max, at one roll and yaw.
struct TableStretch {
  double y_min = 0.0, y_max = 0.0;  ///< [m]
  std::vector<double> y;            ///< of the columns, from the first to the last of these [m]
  /// Height of the first level less its elastic energy over its load [m]. Its slope is the tangent of the contact
  /// angle there.
  ShapeCurve energy_height;
  ShapeCurve wheel_y, wheel_z;
  std::vector<LoadLevel> levels;
  ContactTableColumns columns;  ///< what it is made of
};

/// Contact of a round wheel and a prismatic rail under a few loads, against their lateral displacement y, on a sheet
/// for every roll and yaw, everything else at rest. Elastically several patches count as one contact that has their
/// load and energy and whose place is where their resultant acts; what slides are up to three contacts, each an ellipse
/// of its own. One table serves both rails, any number of wheels and threads. It grows by stretches where somebody asks
/// beyond those it has, the same ones whoever asks, and in whatever order.
class ContactTable {
 public:
  struct Loads {
    std::vector<double> first, heavier = {};  ///< vertical, increasing [N]
    std::size_t reference = 0;                ///< the one of the first whose contact places are taken
  };
  /// How its sheets grow; null: they do not.
  struct Growth {
    /// Outwards from y, on the side of its sign, which 0 has too.
    std::function<ColumnsBeyond(const TableTurn& turn, double from)> beyond;
    /// The same columns with the heavier loads added.
    std::function<ContactTableColumns(const TableTurn& turn, const ContactTableColumns& columns)> heavier;
  };

  /// sheets: columns of each of table_turns, with the contact under the first loads. problem: of which track, wheelset,
  /// material and friction count; nominal: its placement at rest. Errors: Error(configuration) for less than two
  /// columns, loads or compressions that do not increase, what is no finite number, other numbers of sheets, angles
  /// without meaning.
  ContactTable(std::vector<ContactTableColumns> sheets, Loads loads, wheelrail::Problem problem,
               const wheelrail::Placement& nominal, const TableAngles& roll = {}, const TableAngles& yaw = {},
               Growth growth = {});

  /// What it was made with. Thread-safe, as all that follows.
  const wheelrail::Problem& problem() const { return problem_; }
  const wheelrail::Placement& nominal() const { return nominal_; }
  const TableAngles& roll() const { return roll_; }
  const TableAngles& yaw() const { return yaw_; }
  /// Whether it has no end but those of the profiles, and of what can be solved.
  bool grows() const { return growth_.beyond != nullptr; }
  /// What it covers at every roll and yaw before it grows [m].
  double y_min() const { return y_min_; }
  double y_max() const { return y_max_; }
  double least_load() const { return loads_.first.front(); }  ///< of those solved [N]
  /// The greatest that it has, or grows to [N].
  double most_load() const { return loads_.heavier.empty() ? loads_.first.back() : loads_.heavier.back(); }
  static constexpr std::size_t kMostLevels = 8;

  /// Index of a sheet.
  std::size_t sheet(int roll, int yaw) const {
    const int number = roll * (yaw_.intervals + 1) + yaw;
    return static_cast<std::size_t>(number);
  }
  /// Of a sheet.
  const TableTurn& turn(std::size_t sheet) const { return sheets_[sheet].turn; }
  /// Round the central position.
  const TableStretch& central(std::size_t sheet = 0) const { return sheets_[sheet].central; }
  /// The stretch that y belongs to; null where the sheet ends. Takes long where it has to be made. Errors: those of
  /// making it.
  const TableStretch* at(double y, std::size_t sheet = 0) const {
    const TableStretch& middle = central(sheet);
    return y >= middle.y_min && y <= middle.y_max ? &middle : beyond(y, sheets_[sheet]);
  }
  /// Where at() of a table that grows has found no stretch: ColumnsBeyond::unsolved.
  std::string unsolved(double y, std::size_t sheet = 0) const;
  /// The same stretch of a sheet with the heavier loads; null where there are none. It takes as long.
  const TableStretch* heavier(const TableStretch& stretch, std::size_t sheet = 0) const;

 private:
  /// Stretches to one side, outwards, without and with the heavier loads.
  struct Wing {
    std::deque<TableStretch> made, heavier;
    bool ended = false;
    std::string unsolved = {};  ///< as in ColumnsBeyond
  };
  struct Sheet {
    TableTurn turn;
    TableStretch central;
    mutable std::optional<TableStretch> central_heavier = {};
    mutable Wing low = {}, high = {};
  };
  static Wing& wing_at(double y, const Sheet& sheet) { return y > 0.0 ? sheet.high : sheet.low; }
  const TableStretch* beyond(double y, const Sheet& sheet) const;

  Loads loads_;
  wheelrail::Problem problem_;
  wheelrail::Placement nominal_;
  TableAngles roll_, yaw_;
  Growth growth_;
  std::vector<Sheet> sheets_;
  double y_min_ = -std::numeric_limits<double>::infinity(), y_max_ = -y_min_;
  mutable std::mutex growing_;
};

/// What of a pair's problem a table is made for; tables for the same surfaces, load, options and the same of these
/// are the same.
wheelrail::Problem table_problem(wheelrail::Problem prototype, const ContactTableOptions& options = {});

/// Solves the contact at every lateral displacement of the range, at every roll and yaw, in parallel. A sheet covers
/// those round the central position that have a solution, and passes over single ones that have none (rough profiles);
/// beyond it grows until the wheel stands on the tip of its flange, one of the profiles ends, or several in a row have
/// none. prototype: material, friction, track and wheelset of a right-hand pair; states and irregularities do not
/// count. Errors: Error(configuration) for a left-hand prototype, bodies that are not round and prismatic, a curved
/// track, rollers, more than ContactTable::kMostLevels loads and options without meaning; Error(numerical) if the
/// bodies do not touch in the central position.
std::shared_ptr<const ContactTable> build_contact_table(const wheelrail::Geometry& geometry,
                                                        const wheelrail::Problem& prototype, double reference_load,
                                                        const ContactTableOptions& options = {});

/// Its parts: sheets, columns that they grow by and heavier loads take long, to make a table of them takes none of it.
std::vector<ContactTableColumns> solve_contact_sheets(const wheelrail::Geometry& geometry,
                                                      const wheelrail::Problem& prototype, double reference_load,
                                                      const ContactTableOptions& options = {},
                                                      const Progress& progress = {});
/// A stretch outwards from a place, on the side of its sign (-0.0: the low one). On this thread alone. Errors: those of
/// the pair.
ColumnsBeyond solve_columns_beyond(const wheelrail::Geometry& geometry, const wheelrail::Problem& prototype,
                                   double reference_load, const TableTurn& turn, double from,
                                   const ContactTableOptions& options = {});
/// The columns of such a turn with the heavier loads of the options added. On this thread alone.
ContactTableColumns solve_heavier(const wheelrail::Geometry& geometry, const wheelrail::Problem& prototype,
                                  double reference_load, const TableTurn& turn, ContactTableColumns columns,
                                  const ContactTableOptions& options = {});
/// growth: counts unless options.growth is 0. Errors: those of ContactTable.
std::shared_ptr<const ContactTable> contact_table_of(std::vector<ContactTableColumns> sheets,
                                                     const wheelrail::Geometry& geometry,
                                                     const wheelrail::Problem& prototype, double reference_load,
                                                     const ContactTableOptions& options = {},
                                                     ContactTable::Growth growth = {});

/// As bytes, without the numbers of parts.
void write_columns(const ContactTableColumns& columns, ByteWriter& out);
/// Errors: Error(input_data) for bytes that end too early, and for what is no finite number.
ContactTableColumns read_columns(ByteReader& in);

}  // namespace treadmark::vehicle
