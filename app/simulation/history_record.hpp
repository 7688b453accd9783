// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::app {

/// A column that holds a part of the motion of a wheel with full contact and its rail; together all of it.
struct MotionColumn {
  const char *name, *unit, *description;
  double& (*place)(vehicle::PairMotion&);
};
std::span<const MotionColumn> motion_columns();
/// What stands before the name of a wheel's column.
std::string column_prefix(const io::SimulationFile& file, std::size_t wheel);

/// What is written down of a simulation at every instant: time and place, forces of the wheels (of those with full
/// contact also what their patches are like), motions of all bodies, energies. The columns of the watched wheel have no
/// prefix.
class HistoryRecord {
 public:
  /// simulation: of the file's vehicle. Both must outlive this. Errors: those of check.
  HistoryRecord(const io::SimulationFile& file, const vehicle::Simulation& simulation);

  /// What its columns are, before there is a simulation; vehicle: its wheels may lack their contacts. Errors:
  /// Error(configuration) with the place of channels, also of those of spectra, that are none.
  static std::vector<io::HistoryColumn> columns_of(const io::SimulationFile& file,
                                                   const vehicle::VehicleOnTrack& vehicle);

  std::vector<io::HistoryColumn> columns() const;
  /// Appends the present instant.
  void append(std::vector<double>& values) const;

 private:
  struct Column {
    io::HistoryColumn head;
    std::function<double()> value;
  };
  HistoryRecord(const io::SimulationFile& file, const vehicle::VehicleOnTrack& vehicle,
                const vehicle::Simulation* simulation);
  void add(std::string name, std::string unit, std::string description, std::function<double()> value);
  void add_wheel(std::size_t wheel, const std::string& prefix, bool full);
  void add_bodies();
  void add_line(bool irregular);
  void add_choice(std::size_t wheel, const std::string& prefix);
  void add_energies();
  void add_elements();
  void add_running(std::size_t watched);
  void add_accelerations(const io::HistoryRequest& request);
  void keep_only(const io::HistoryRequest& request);

  const vehicle::VehicleOnTrack& vehicle_;
  const vehicle::Simulation* simulation_;  ///< null: only names of columns are asked for
  double wheel_y_;                         ///< from the middle of a wheelset to its tape circles [m]
  std::vector<Column> columns_;
};

/// A wheel whose contact is chosen goes over into the full contact, or back.
struct ContactChange {
  double time = 0.0;      ///< [s]
  std::size_t wheel = 0;  ///< index in VehicleOnTrack::wheels
  bool full = false;
};

/// Where vehicles run at another speed than their frames.
struct OtherSpeed {
  double place = 0.0;               ///< distance travelled [m]
  double mean = 0.0, wanted = 0.0;  ///< of all masses, of the frames [m/s]; 0: nowhere
  /// What is between them over the one that is wanted.
  double share() const { return wanted > 0.0 ? std::abs(mean - wanted) / wanted : 0.0; }
};

/// Numbers that sum up a simulation: largest and least forces of the watched wheel, where and when, energies and
/// counts. Every instant counts that is noted, whether it is written down or not. Not thread-safe.
class HistorySummary {
 public:
  /// simulation: of the file's vehicle; it must outlive this.
  HistorySummary(const io::SimulationFile& file, const vehicle::Simulation& simulation);

  /// Takes the present instant into account; the first one is the start.
  void note();
  /// SI; empty before the first instant.
  std::vector<io::NamedValue> values() const;
  /// What they are called.
  static std::vector<std::string> names(const io::SimulationFile& file);
  /// In the order of time.
  const std::vector<ContactChange>& changes() const { return changes_; }
  /// Where it is most, of vehicles that are free along the track.
  const OtherSpeed& other_speed() const { return other_speed_; }

  void save(ByteWriter& out) const;
  /// Errors: Error(input_data) where bytes end too early.
  void restore(ByteReader& in);

 private:
  struct Extreme {
    double value = 0.0, time = 0.0;  ///< SI, [s]
  };
  /// Of a wheel whose contact is chosen.
  struct Chosen {
    std::size_t wheel = 0;
    bool is_full = false;
    double way = 0.0, full = 0.0;          ///< in all, in full contact [m]
    double square = 0.0;                   ///< of errors of the table, over the way [m]
    double worst = 0.0, worst_wear = 0.0;  ///< errors where the table counts
  };
  void note_choices();
  void note_speed();
  struct Row;
  static std::vector<Row> rows(bool has_pressure);
  double turnover() const;

  const vehicle::Simulation& simulation_;
  std::size_t watched_;
  bool has_pressure_, begun_ = false;
  double at_rest_ = 0.0;       ///< vertical force [N]
  std::int64_t doubtful_ = 0;  ///< instants with a grave remark
  double at_ = 0.0;            ///< distance travelled [m]
  std::vector<Chosen> chosen_;
  std::vector<ContactChange> changes_;
  OtherSpeed other_speed_;
  Extreme highest_, lowest_, ty_max_, ty_min_, pmax_;
};

}  // namespace treadmark::app
