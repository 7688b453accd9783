// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/cases/pages/solving_page.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/page_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/report/write_page.hpp"

namespace treadmark::cli {
namespace {

struct LiveOptions {
  std::string case_file;               ///< empty: the case of treadmark new
  std::vector<std::string> overrides;  ///< key=value
  int number = 1;
  std::string output_file = "live.html";
  bool stay = false;  ///< open no browser
};

io::CaseFile given_case(const LiveOptions& options) {
  if (!options.case_file.empty()) return io::read_any_case(options.case_file, options.overrides);
  std::vector<std::string> overrides = options.overrides;
  overrides.insert(overrides.begin(), "wheelset.y_mm=0");  // one of its places
  return io::parse_case_text(text_of_new_case(), "case.toml", overrides);
}

int live_command(const LiveOptions& options, const CommonOptions& common) {
  require_part("report_scripts", "treadmark live");
  io::CaseFile file = given_case(options);
  print_notes(file.notes, common.quiet);
  const report::Page page = with_progress(common.quiet, [&](const Progress& progress) {
    return app::pages::solving_page(std::move(file), options.number, progress);
  });
  write_page(options.output_file, report::to_html(page));
  std::cout << options.output_file << '\n';
  if (!options.stay) open_page(options.output_file);
  return kOk;
}

}  // namespace

Command add_live(CLI::App& verb) {
  auto options = std::make_shared<LiveOptions>();
  verb.add_option("CASE", options->case_file, "The case to start from; without it that of treadmark new case");
  add_overrides(verb, options->overrides);
  verb.add_option("--case", options->number, "Number of the case, of a file with several")->type_name("N");
  verb.add_option("-o,--output", options->output_file, "The page, default live.html")
      ->check(is_output(true))
      ->type_name("FILE.html")
      ->each([](const std::string& name) { check_page_name(name); });
  verb.add_flag("--no-open", options->stay, "Do not open it in the browser");
  return command(options, live_command);
}

}  // namespace treadmark::cli
