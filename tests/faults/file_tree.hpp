// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace treadmark::testing {

/// Content by path below a folder, of regular files.
using FileTree = std::map<std::string, std::string>;

FileTree tree_of(const std::filesystem::path& folder);

/// Makes a folder hold these files and nothing else.
void restore(const std::filesystem::path& folder, const FileTree& tree);

/// Whether a file or a folder on its path is hidden: on its way to its name, or left by somebody who died on it.
bool is_hidden(const std::string& path);
FileTree visible(const FileTree& tree);

/// The first visible file that does not end as its kind does.
std::string first_half_written(const FileTree& tree);

/// Contents that a file had, by path.
using Versions = std::map<std::string, std::set<std::string>>;

/// What is wrong with a folder in which `before` was being replaced by `after`: a visible file that is none of the two
/// and no whole version that stood there between them, one that is gone, an index whose slices are not its own, the
/// last file of a result folder beside others that are not of its making. Empty where all are old or new.
std::string neither_old_nor_new(const FileTree& now, const FileTree& before, const FileTree& after,
                                const Versions& between = {});

}  // namespace treadmark::testing
