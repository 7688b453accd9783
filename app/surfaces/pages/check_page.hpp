// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/profiles/judge_profile.hpp"
#include "treadmark/io/settings/key_words.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// What `check` understood of one file.
struct CheckedInput {
  std::string file;
  std::string title = {};                                              ///< of a case file; may be empty
  io::Inputs inputs = {};                                              ///< what it asks for
  std::string outcome;                                                 ///< "3 cases, no errors"; may be empty
  std::vector<std::string> notes;                                      ///< of the reader
  std::vector<std::string> doubts;                                     ///< about numbers of cases
  std::vector<std::pair<std::string, io::ProfileJudgement>> profiles;  ///< "wheel profile FILE" and what is seen of it
  std::vector<std::pair<std::string, std::string>> positions;          ///< "Case 1" and SVG of wheel over rail
};

/// Report of a check: doubts first, then each file with its profiles and positions.
report::Page check_page(const std::vector<CheckedInput>& inputs);

}  // namespace treadmark::app::pages
