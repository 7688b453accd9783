// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace treadmark::cli {

/// Kinds of values, as --help shows them, whose names are known.
inline constexpr const char *kProfileName = "PROFILE", *kBackendName = "BACKEND", *kSettingWord = "KEY=VALUE";

/// An option of the program or a verb as manual pages and completions show it.
struct OptionWords {
  std::vector<std::string> names;    ///< "-o", "--output"; empty: it stands by itself, without a name
  std::string value;                 ///< what it takes: "FILE"; empty: nothing
  std::string list;                  ///< of name_lists(): what it takes beside others; empty: none
  std::vector<std::string> choices;  ///< all that it takes; empty: anything
  std::string description;
  bool required = false, repeated = false;
};

/// In the order in which they were added.
std::vector<OptionWords> option_words(const CLI::App& app);

/// Names that options take: profiles, backends, keys of a kind of files. list: as a variable of shells is called.
struct NameList {
  std::string list;
  std::vector<std::string> names;
};
std::vector<NameList> name_lists();

/// The verbs that this build has.
std::vector<const CLI::App*> verbs_of(const CLI::App& program);

}  // namespace treadmark::cli
