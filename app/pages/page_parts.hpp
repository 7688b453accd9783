// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/model/origin.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Version, input and settings as facts.
report::Facts origin_facts(const Origin& origin);

/// Puts what was asked for behind the first section of a page, and what made it, origin_facts or these, at its end.
void add_origin(report::Page& page, const Origin& origin);
void add_origin(report::Page& page, const Origin& origin, report::Facts facts);

/// A number with the 12 digits of the result files, so that a page is the same from a result and from its files; NaN
/// where it is not finite.
double in_file(double value);

/// The title; without one "wheel-flat" of "some/where/wheel-flat.toml"; "result" of nothing.
std::string title_of(const std::string& title, const std::string& input_file);

/// "1 case", "3 cases".
std::string counted(std::size_t count, const std::string& word);

/// Seconds as people say them: "0.53 s", "2 min 5 s", "1 h 12 min".
std::string duration_text(double seconds);

/// Forces in N, or in kN where some are larger than 2 kN: factor and unit.
std::pair<double, std::string> force_unit(const std::vector<double>& newtons);

/// A result folder's files that a page can do without. What is not there is remembered, to be said on the page. Not
/// thread-safe.
class OptionalFiles {
 public:
  explicit OptionalFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path path(const std::string& file) const { return folder_ / file; }

  /// Whether a file is there. what: what the page lacks without it.
  bool has(const std::string& file, const std::string& what);

  /// A picture as a figure; nothing if it is not there.
  std::vector<report::Block> picture(const std::string& file, const std::string& id, const std::string& title,
                                     const std::string& note = {});

  /// The text of a file; empty if it is not there. Errors: Error(input_data) where it cannot be read.
  std::string text(const std::string& file, const std::string& what);

  /// A note about what was missing; nothing where all was there.
  std::vector<report::Block> note() const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> missing_;
};

/// Adds all of them.
void append(std::vector<report::Block>& to, std::vector<report::Block> blocks);

}  // namespace treadmark::app::pages
