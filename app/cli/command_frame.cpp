// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/command_frame.hpp"

#include <iostream>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/atomic_file.hpp"

namespace treadmark::cli {

void add_case_files(CLI::App& verb, std::vector<std::string>& cases, std::vector<std::string>& overrides) {
  verb.add_option("CASE", cases, "Treadmark case (.toml) or CONTACT input file (.inp)")->required();
  add_overrides(verb, overrides);
}

void add_overrides(CLI::App& verb, std::vector<std::string>& overrides) {
  verb.add_option("--set", overrides, "Override a key of every case, for example --set wheelset.y_mm=3")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_report_file(CLI::App& verb, std::string& file) {
  verb.add_option("--report", file, "Write a report here that opens in any browser, offline")->type_name("FILE.html");
}

void print_notes(const std::vector<std::string>& notes, bool quiet) {
  if (quiet) return;
  for (const std::string& note : notes) std::cerr << "note: " << note << '\n';
}

void print_results(const std::string& json_file, const std::function<std::string()>& json,
                   const std::function<std::string()>& text) {
  std::cout << (json_file == "-" ? json() : text());
}

void write_json_file(const std::string& json_file, const std::function<std::string()>& json) {
  if (!json_file.empty() && json_file != "-") io::write_text_file(json_file, json());
}

void check_output() {
  std::cout.flush();
  if (!std::cout) throw Error(ErrorKind::numerical, "the results could not be written to standard output");
}

}  // namespace treadmark::cli
