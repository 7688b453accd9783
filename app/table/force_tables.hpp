// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/files/content_cache.hpp"
#include "treadmark/io/settings/given_settings.hpp"
#include "treadmark/solvers/vehicle/contacts/force_table.hpp"

namespace treadmark::app {

/// How a table of forces is made: its axes, and where it is compared with the exact theory.
struct TableRequest {
  vehicle::ContactTableOptions axes{.lateral_range = 8e-3,
                                    .step = 0.5e-3,
                                    .element_size = 0.5e-3,
                                    .relative_loads = {0.3, 0.6, 1.0, 1.5, 2.5},
                                    .heavier = {},
                                    .roll = {10e-3, 6},
                                    .yaw = {20e-3, 2}};
  std::optional<double> load;  ///< vertical, about which the loads of the table lie [N]; none: that of the case
  bool exact_creep = true;     ///< creep forces of the exact theory's table, else Kalker's coefficients
  vehicle::CreepTableOptions creep;
  vehicle::TableCheckOptions check;
  std::vector<std::string> overrides;  ///< of the case
};

/// The settings of `treadmark table`. Immutable.
const io::KeyTable<TableRequest>& table_keys();
/// Errors: Error(configuration) for what are no keys and no values of them.
TableRequest table_request(const io::GivenSettings& given);

/// What a table is made of: enough to make it again without surfaces.
struct TableHead {
  double load = 0.0;                       ///< reference [N]
  double roll_most = 0.0, yaw_most = 0.0;  ///< [rad]
  int roll_intervals = 0, yaw_intervals = 0;
  double element_size = 0.0;  ///< of the problems solved for it [m]
  /// Where rail, wheelset and wheel are in the central position [m], [rad].
  double rail_y = 0.0, rail_z = 0.0, rail_roll = 0.0, wheelset_z = 0.0, wheel_y = 0.0, wheel_z = 0.0;
  int points = 0;  ///< of the comparison
  double speed = 0.0, creepage = 0.0;
  std::string creep_forces;  ///< "exact_table", "linear"
};

/// Contact under one load at one place, and one of its parts.
struct TableNode {
  double roll = 0.0, yaw = 0.0, y = 0.0, load = 0.0;
  vehicle::ContactUnderLoad contact;  ///< without its parts
  vehicle::ContactPart part = {};
};

/// A table with what it is made from.
struct MadeTable {
  std::string title;  ///< of the case file
  io::Case given;     ///< of which track, wheelset, material and friction count
  TableHead head;
  std::vector<TableNode> nodes;
  vehicle::ForceTable table;
};

/// Solves all nodes and compares the table with the exact theory. given: of a wheel on a rail. cache: where the table
/// of creep forces is kept. The same for any number of threads. Errors: those of vehicle::solve_contact_sheets,
/// CreepTable and check_table; Error(configuration) for a case that tables are not for, before anything takes long.
MadeTable make_table(const io::Case& given, const wheelrail::Geometry& geometry, const TableRequest& request,
                     const io::ContentCache* cache = nullptr, const Progress& progress = {});
/// Of the first case of a wheel on a rail in a file. Errors: those of readers, too.
MadeTable make_table(const std::filesystem::path& case_file, const TableRequest& request,
                     const io::ContentCache* cache = nullptr, const Progress& progress = {});

/// Errors: Error(configuration) for an extension that tables are not written with, and one that needs a part that this
/// build lacks.
void check_table_output(const std::filesystem::path& file);
/// By its extension: .h5 and .json hold everything, .csv the nodes. Errors: those of check_table_output and of
/// core/output_file.hpp.
void write_table(const std::filesystem::path& file, const MadeTable& made);
/// Whether a file is a table by its name: .h5 or .json.
bool is_table_file(const std::filesystem::path& file);
/// .h5 or .json. Opens no other file. Errors: Error(input_data) for what is no table, or a damaged one: the file says
/// the digest of what it holds.
MadeTable read_table(const std::filesystem::path& file);

/// For a terminal, and as JSON: what it covers, how far it is from the exact theory.
std::string table_text(const MadeTable& made);
std::string table_json(const MadeTable& made);

}  // namespace treadmark::app

namespace treadmark {
template <>
std::span<const Column<app::TableHead>> columns();
template <>
std::span<const Column<app::TableNode>> columns();
}  // namespace treadmark
