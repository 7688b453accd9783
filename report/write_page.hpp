// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/report/page.hpp"

namespace treadmark::report {

struct PageOptions {
  bool live = true;                      ///< with the script, if this build has it; else static pictures
  std::size_t field_budget = 5'500'000;  ///< for contact fields [bytes]; see pack_frames
};

/// The page as one HTML document that refers to nothing outside itself. Every text is escaped, and by the page's
/// content-security policy no other script and no other style sheet than Treadmark's own take effect. The same page
/// gives the same bytes. Thread-safe. Errors: Error(configuration) for figures that refer to sets which are not there,
/// and fields that do not match their grid.
std::string to_html(const Page& page, const PageOptions& options = {});

/// Style sheet of the pages.
const std::string& page_style();

/// The script that makes views live; empty where Treadmark was built without Node.js.
const std::string& page_script();

/// The script that pages which solve have besides; empty where page_script is.
const std::string& solving_script();

}  // namespace treadmark::report
