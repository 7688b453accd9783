// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::cli {

Command add_import(CLI::App& verb) { return add_left_out(verb); }
Command add_scan(CLI::App& verb) { return add_left_out(verb); }

void check_import_file(const std::string& name, const std::vector<std::string>&) {
  left_out("scans", "import settings such as " + name);
}
std::string import_schema() { left_out("scans", "the schema of import settings"); }
std::string import_report_schema() { left_out("scans", "the schema of import reports"); }

}  // namespace treadmark::cli
