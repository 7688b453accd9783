// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/lists/result_list.hpp"

namespace treadmark::cli {

/// What verbs that work through lists write; empty: not asked for.
struct ListFiles {
  std::string csv, hdf5, report;

  std::vector<std::string> all() const { return {csv, hdf5, report}; }
};

/// --hdf5 of a file.
void add_hdf5_file(CLI::App& verb, std::string& file);

/// Makes a list, with a progress line, whose finished rows are kept beside the first of the files; after Ctrl-C says so
/// and returns nothing.
std::optional<app::ResultList> make_list(
    const ListFiles& files, const CommonOptions& common,
    const std::function<app::ResultList(const std::filesystem::path& kept, const Progress& progress)>& make);

/// Writes the files, and the list on standard output unless shown is false or the table goes there; then deletes the
/// unfinished rows that were kept.
void write_list(const ListFiles& files, const app::ResultList& list, bool shown = true);

}  // namespace treadmark::cli
