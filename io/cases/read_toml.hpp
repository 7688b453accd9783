// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::io {

class CaseRows;

/// A file whose cases may be rows of a table.
struct ListedCases {
  CaseFile file;                         ///< with the first row alone where there is a table
  std::shared_ptr<const CaseRows> rows;  ///< null: none
};

/// Reads a Treadmark case file (TOML, docs/case-file.md). Tables at the top hold what is common to all cases, every
/// [[cases]] entry overrides some keys; a list where one value is expected makes one case for each of its values.
/// overrides: "key.path=value" (TOML value or bare word), applied to every case after everything else.
/// Geometry files are resolved against the folder of the case file but not opened.
/// Throws Error (configuration) with file:line:column: broken TOML, unknown keys (with a suggestion), wrong types,
/// values out of range, incomplete or unsupported cases. Safe to call from several threads.
CaseFile read_case_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same for text that is already in memory; name serves for messages and for resolving geometry files.
CaseFile parse_case_text(std::string_view text, const std::filesystem::path& name,
                         std::span<const std::string> overrides = {});

/// The same for tables that have been parsed already (and perhaps changed); sha256 stays empty.
CaseFile case_file_of(const CaseTable& document, const std::filesystem::path& name,
                      std::span<const std::string> overrides = {});

/// The same, but the rows of a table (cases_file) stay in their file.
ListedCases listed_cases_of(const CaseTable& document, const std::filesystem::path& name,
                            std::span<const std::string> overrides = {});
/// As parse_case_text, but the rows of a table (cases_file) stay in their file.
ListedCases parse_listed_cases(std::string_view text, const std::filesystem::path& name,
                               std::span<const std::string> overrides = {});
/// With all rows. Errors: Error(configuration) for more of them than a CaseFile may have.
CaseFile all_cases(ListedCases listed);

/// Where the case says where a wheel's file has the back of the flange, the file is not moved.
void take_as_told(Case& c);

/// Applies one "key.path=value" to a case from any kind of file; the case is checked again. Relative paths count from
/// the folder of the file that the case came from. Keys of list elements are written with their number from 0:
/// "wheel.flats.0.depth_mm=1.2". Throws Error (configuration) and leaves the case as it was.
void apply_override(Case& target, std::string_view assignment);
/// Several of them to every case of a file; the cases are checked when all have been applied.
void apply_overrides(CaseFile& target, std::span<const std::string> overrides);

/// Cases of a case file that follow each other in time (case.steps).

/// The rolling step that case.time_step_s means.
void settle_rolling_step(Case& c);

/// Moves rail and wheelset of a case from where they are in the case before it, by its velocities; a shift by its
/// displacements. given: whether the file gives the position with this key itself, which then stays. Basic cases have
/// no position. Errors: Error(configuration) if neither a velocity nor a time step tells how far.
void move_on(Case& next, const Case& previous, const std::function<bool(std::string_view)>& given);

}  // namespace treadmark::io
