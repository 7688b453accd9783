// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/app/cases/pages/case_figures.hpp"
#include "treadmark/app/cases/pages/live_page.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/page_file.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/modules.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/settings/key_list.hpp"
#include "treadmark/report/write_page.hpp"

namespace treadmark::cli {
namespace {

namespace fs = std::filesystem;

struct LiveOptions {
  std::string case_file;               ///< empty: the case of treadmark new
  std::vector<std::string> overrides;  ///< key=value
  int number = 1;
  std::string output_file = "live.html";
  bool stay = false;  ///< open no browser
};

/// A file of the program for browsers, which scripts/web.sh makes.
std::string module_file(std::string_view name) {
  for (const fs::path& folder : module_folders())
    if (const fs::path file = folder / name; fs::exists(file))
      return io::profiles::read_text(file, "program for browsers", {});
  throw Error(ErrorKind::configuration, "this build has no program for browsers, which a page needs to solve", {},
              "make it with scripts/web.sh, or name its folder in TREADMARK_MODULES");
}

io::CaseFile chosen_case(const LiveOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (options.case_file.empty()) overrides.insert(overrides.begin(), "wheelset.y_mm=0");  // one of its places
  io::CaseFile file = options.case_file.empty() ? io::parse_case_text(text_of_new_case(), "case.toml", overrides)
                                                : io::read_any_case(options.case_file, overrides);
  if (options.number < 1 || static_cast<std::size_t>(options.number) > file.cases.size())
    throw Error(ErrorKind::configuration, "there is no case of this number", {options.case_file}, "choose with --case");
  file.cases = {file.cases[static_cast<std::size_t>(options.number) - 1]};
  if (!std::holds_alternative<io::WheelRailCase>(file.cases.front().content))
    throw Error(ErrorKind::configuration, "the page is for a wheel on a rail", {options.case_file},
                "of one patch, use treadmark run --report");
  return file;
}

int live_command(const LiveOptions& options, const CommonOptions& common) {
  require_part("report_scripts", "treadmark live");
  report::Solving solving;
  solving.module = module_file("treadmark-web.wasm");
  solving.loader = module_file("treadmark-web.js");
  const io::CaseFile file = chosen_case(options);
  print_notes(file.notes, common.quiet);
  app::SurfaceStore store;
  io::RunResult result =
      with_progress(common.quiet, [&](const Progress& progress) { return app::run_cases(file, store, progress); });
  if (!result.complete) throw Cancelled();
  // What the views can show follows from what they show first.
  if (!app::pages::has_fields(result))
    throw Error(ErrorKind::configuration, "the page has no contact to begin with: " + io::words(result.cases.front()),
                {options.case_file}, "choose another place, for example --set wheelset.y_mm=0");
  app::add_surfaces(result, file, store);
  const fs::path folder = file.path.parent_path();
  solving.toml = io::case_file_text(file, folder);
  for (const auto& [name, hash] : result.geometry_sha256) {
    const fs::path content = io::profile_file(name);
    if (io::is_slices_file(content))
      throw Error(ErrorKind::configuration, "slices name files of their own, which the page does not take along",
                  {content.string()}, "use treadmark run --report");
    solving.files[io::relative_to(content, folder).generic_string()] = io::profiles::read_text(content, "file", {});
  }
  const auto page = app::pages::live_page(std::make_shared<io::RunResult>(std::move(result)), std::move(solving));
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
