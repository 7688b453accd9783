// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/pages/read_report.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/app/bench/pages/bench_page.hpp"
#include "treadmark/app/cases/pages/run_overlay_page.hpp"
#include "treadmark/app/cases/pages/run_page.hpp"
#include "treadmark/app/compare/pages/compare_page.hpp"
#include "treadmark/app/design/pages/design_page.hpp"
#include "treadmark/app/evolve/pages/evolution_page.hpp"
#include "treadmark/app/import/pages/import_page.hpp"
#include "treadmark/app/pages/page_parts.hpp"
#include "treadmark/app/pages/plain_page.hpp"
#include "treadmark/app/simulation/pages/simulation_overlay_page.hpp"
#include "treadmark/app/simulation/pages/simulation_page.hpp"
#include "treadmark/app/simulation/pages/sweep_page.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/results/read_hdf5.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

namespace fs = std::filesystem;

std::string text_or_nothing(const fs::path& file) {
  std::error_code unknown;
  return fs::exists(file, unknown) ? io::profiles::read_text(file, "results", {}) : std::string();
}

Page run_in(const fs::path& folder) {
  return run_page(std::make_shared<io::RunResult>(io::read_hdf5(folder / "fields.h5")),
                  text_or_nothing(folder / "result.json"));
}

io::SimulationResult read_histories(const fs::path& store) {
  io::SimulationResult result = io::read_simulation(store);
  io::SnapshotSeries snapshots = io::read_snapshots(store);
  result.snapshots = std::move(snapshots.run);
  result.snapshot_times = std::move(snapshots.times);
  result.snapshot_scenes = std::move(snapshots.scenes);
  return result;
}

Page simulation_in(const fs::path& store) {
  auto result = std::make_shared<const io::SimulationResult>(read_histories(store));
  std::optional<AssessedRun> assessed;
  if (const fs::path file = store.parent_path() / "assessment.json"; fs::exists(file) && result->rows() > 1)
    assessed = assess_result(title_of({}, result->input_file), result, request_in(file));
  return simulation_page(result, {}, assessed ? &*assessed : nullptr);
}

struct KindRow;

struct Found {
  const KindRow* row = nullptr;
  fs::path folder;
  fs::path store() const;
};

Page overlaid_runs(const std::vector<Found>& found);
Page overlaid_simulations(const std::vector<Found>& found);
Page plain(const Found& found);

/// By which file a folder is known to hold results, and their pages. simulation.h5: of a simulation that ended, be it
/// by Ctrl-C; unfinished.h5: what a killed one left at its last checkpoint.
struct KindRow {
  const char *file, *words;
  Page (*page)(const Found&);
  Page (*overlaid)(const std::vector<Found>&) = nullptr;  ///< nullptr: they cannot be laid over each other
};
constexpr KindRow kKinds[] = {
    {"compare.json", "a comparison", [](const Found& f) { return compare_page(f.folder); }},
    {"bench.json", "a bench", [](const Found& f) { return bench_page(f.folder); }},
    {"report.json", "an import", [](const Found& f) { return import_page(f.folder); }},
    {io::kEvolutionIdentity, "an evolution", [](const Found& f) { return evolution_page(f.folder); }},
    {"design.json", "a design", [](const Found& f) { return design_page(f.folder); }},
    {"study.id", "a sweep", [](const Found& f) { return sweep_page(read_study_folder(f.folder)); }},
    {"simulation.h5", "a simulation", [](const Found& f) { return simulation_in(f.store()); }, overlaid_simulations},
    {"unfinished.h5", "a simulation", [](const Found& f) { return simulation_in(f.store()); }, overlaid_simulations},
    {"fields.h5", "a run", [](const Found& f) { return run_in(f.folder); }, overlaid_runs},
    {"cases.json", "a list of cases", plain},
    {"geometry.json", "the geometry of a wheelset on its track", plain},
    {"track.json", "how a track gives way", plain},
    {"stability.json", "the stability of a vehicle", plain},
    {"response.json", "the response of a vehicle", plain},
    {"assessment.json", "an assessment", plain}};

fs::path Found::store() const { return folder / row->file; }

Page plain(const Found& found) { return plain_page(found.folder, found.row->file, found.row->words); }

std::string known_results() {
  std::string text;
  for (const KindRow& row : kKinds) text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", row.file, row.words);
  return text;
}

/// What a folder holds, or the folder of a file.
Found find_results(const fs::path& given) {
  std::error_code unknown;  // what cannot be looked at counts as missing
  const fs::path folder =
      fs::is_regular_file(given, unknown) ? (given.has_parent_path() ? given.parent_path() : fs::path(".")) : given;
  if (!fs::is_directory(folder, unknown))
    throw MissingFile(ErrorKind::input_data, "there is no such folder", {given.string()},
                      advice_on_missing(given, "give a folder that a command wrote with -o"));
  const auto row = ranges::find_if(kKinds, [&](const KindRow& one) { return fs::exists(folder / one.file, unknown); });
  if (row == std::end(kKinds))
    throw Error(ErrorKind::input_data, "the folder holds no results", {folder.string()},
                "results are known by one of the files " + known_results());
  return {&*row, folder};
}

/// The last parts of the paths of folders, as many as tell them apart. Of the same folder twice: with a number.
std::vector<std::string> short_names(const std::vector<Found>& all) {
  std::vector<fs::path> rest, names(all.size());
  rest.reserve(all.size());
  for (const Found& one : all) {
    fs::path path = fs::weakly_canonical(one.folder);
    if (!path.has_filename()) path = path.parent_path();
    rest.push_back(std::move(path));
  }
  const auto distinct = [&] { return std::set<fs::path>(names.begin(), names.end()).size() == names.size(); };
  const auto grow = [&] {
    bool any = false;
    for (std::size_t k = 0; k < rest.size(); ++k) {
      if (!rest[k].has_filename()) continue;
      names[k] = names[k].empty() ? rest[k].filename() : rest[k].filename() / names[k];
      rest[k] = rest[k].parent_path();
      any = true;
    }
    return any;
  };
  const std::vector<fs::path> whole = rest;
  if (std::set<fs::path>(whole.begin(), whole.end()).size() == whole.size()) do
      if (!grow()) break;
    while (!distinct());
  else
    grow();
  std::vector<std::string> out;
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::string name = names[k].generic_string();
    if (ranges::count(names, names[k]) > 1)
      name +=
          fmt::format(" ({})", 1 + std::count(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(k), names[k]));
    out.push_back(std::move(name));
  }
  return out;
}

template <class Result>
std::vector<Overlaid<Result>> read_all(const std::vector<Found>& found, Result (*read)(const fs::path&)) {
  const std::vector<std::string> names = short_names(found);
  std::vector<Overlaid<Result>> out;
  out.reserve(found.size());
  for (std::size_t k = 0; k < found.size(); ++k) out.push_back({names[k], read(found[k].store())});
  return out;
}

Page overlaid_runs(const std::vector<Found>& found) { return run_overlay_page(read_all(found, io::read_hdf5)); }
Page overlaid_simulations(const std::vector<Found>& found) {
  return simulation_overlay_page(read_all(found, read_histories));
}

}  // namespace

Page read_report(const fs::path& given) {
  const Found found = find_results(given);
  return found.row->page(found);
}

Page read_overlay(const std::vector<fs::path>& given) {
  if (given.size() > kMostOverlaid)
    throw Error(ErrorKind::configuration, fmt::format("{} results are too many for a page", given.size()), {},
                fmt::format("give at most {}", kMostOverlaid));
  std::vector<Found> found;
  found.reserve(given.size());
  for (const fs::path& one : given) {
    std::error_code unknown;
    const bool file = fs::is_regular_file(one, unknown);
    found.push_back(find_results(one));
    const KindRow& row = *found.back().row;
    // A file under a name of its own beside others must not be taken for them.
    if (file && one.extension() == ".h5" && one.filename() != row.file)
      throw Error(ErrorKind::input_data, fmt::format("overlaid results are known by their folder or its {}", row.file),
                  {one.string()}, "put the file into a folder of its own under that name");
    if (row.overlaid == nullptr)
      throw Error(ErrorKind::input_data, fmt::format("the folder holds {}", row.words), {one.string()},
                  "runs (treadmark run) and simulations (treadmark simulate) can be overlaid");
    if (row.overlaid != found.front().row->overlaid)
      throw Error(
          ErrorKind::input_data,
          fmt::format("the folder holds {}, {} holds {}", row.words, given.front().string(), found.front().row->words),
          {one.string()}, "only results of one kind can be overlaid");
  }
  Page page = found.front().row->overlaid(found);
  std::set<fs::path> folders;
  for (const Found& one : found)
    if (!folders.insert(fs::weakly_canonical(one.folder)).second)
      page.sections.front().blocks.insert(
          page.sections.front().blocks.begin(),
          Banner{Banner::Kind::note, "The same folder more than once:", one.folder.string()});
  return page;
}

}  // namespace treadmark::app::pages
