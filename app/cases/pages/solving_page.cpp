// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/solving_page.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "treadmark/app/cases/pages/case_figures.hpp"
#include "treadmark/app/cases/pages/live_page.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/modules.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/settings/key_list.hpp"

namespace treadmark::app::pages {

namespace {

namespace fs = std::filesystem;

/// A file of the program for browsers, which scripts/web.sh makes.
std::string module_file(std::string_view name) {
  for (const fs::path& folder : module_folders())
    if (const fs::path file = folder / name; fs::exists(file))
      return io::profiles::read_text(file, "program for browsers", {});
  throw Error(ErrorKind::configuration, "this build has no program for browsers, which a page needs to solve", {},
              "make it with scripts/web.sh, or name its folder in TREADMARK_MODULES");
}

void choose_case(io::CaseFile& file, int number) {
  if (number < 1 || static_cast<std::size_t>(number) > file.cases.size())
    throw Error(ErrorKind::configuration, "there is no case of this number", {file.path.string()},
                "choose with --case");
  file.cases = {file.cases[static_cast<std::size_t>(number) - 1]};
  if (!std::holds_alternative<io::WheelRailCase>(file.cases.front().content))
    throw Error(ErrorKind::configuration, "the page is for a wheel on a rail", {file.path.string()},
                "of one patch, use treadmark run --report");
}

}  // namespace

report::Page solving_page(io::CaseFile file, int number, const Progress& progress) {
  require_part("report_scripts", "treadmark live");
  report::Solving solving;
  solving.module = module_file("treadmark-web.wasm");
  solving.loader = module_file("treadmark-web.js");
  choose_case(file, number);
  SurfaceStore store;
  io::RunResult result = run_cases(without_error_bars(file), store, progress);
  if (!result.complete) throw Cancelled();
  // What the views can show follows from what they show first.
  if (!has_fields(result))
    throw Error(ErrorKind::configuration, "the page has no contact to begin with: " + io::words(result.cases.front()),
                {file.path.string()}, "choose another place, for example --set wheelset.y_mm=0");
  add_surfaces(result, file, store);
  const fs::path folder = file.path.parent_path();
  solving.toml = io::case_file_text(file, folder);
  for (const auto& [name, hash] : result.geometry_sha256) {
    const fs::path content = io::profile_file(name);
    if (io::is_slices_file(content))
      throw Error(ErrorKind::configuration, "slices name files of their own, which the page does not take along",
                  {content.string()}, "use treadmark run --report");
    if (io::extension_of(content) == ".vdb")
      throw Error(ErrorKind::configuration, "the program for browsers has no OpenVDB, which VDB files need",
                  {content.string()},
                  "take offsets as .nvdb: treadmark convert; of level sets use treadmark run --report");
    solving.files[io::relative_to(content, folder).generic_string()] = io::profiles::read_text(content, "file", {});
  }
  return live_page(std::make_shared<io::RunResult>(std::move(result)), std::move(solving));
}

}  // namespace treadmark::app::pages
