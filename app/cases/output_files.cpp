// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/output_files.hpp"

#include <functional>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/never_cancelled.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/comparison_json.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/io/results/comparison_table.hpp"
#include "treadmark/io/results/contact_program/write_mat.hpp"
#include "treadmark/io/results/contact_program/write_subs.hpp"
#include "treadmark/io/results/derivative_table.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/io/results/write_vtk.hpp"
#include "treadmark/report/pictures/comparison_pictures.hpp"
#include "treadmark/report/pictures/pressure_svg.hpp"

namespace treadmark::app {

std::vector<std::filesystem::path> output_folders(const std::filesystem::path& folder,
                                                  const std::vector<std::string>& inputs) {
  if (inputs.size() == 1) return {folder};
  std::vector<std::filesystem::path> folders;
  std::map<std::string, std::string> taken;
  for (const std::string& input : inputs) {
    const std::string name = std::filesystem::path(input).stem().string();
    if (name.empty() || name == "." || name == "..")
      throw Error(ErrorKind::configuration, fmt::format("no folder can have the name of {}", input), {},
                  "rename the file");
    folders.push_back(folder / name);
    if (const auto [other, is_new] = taken.emplace(name, input); !is_new)
      throw Error(
          ErrorKind::configuration,
          fmt::format("the results of {} and {} would both go to {}", other->second, input, folders.back().string()),
          {}, "rename one of them, or give each a folder in a command of its own");
  }
  return folders;
}

namespace {

/// Writes fields.h5, or says in a note that this build leaves it out.
template <class Write>
std::vector<std::string> write_fields(const std::filesystem::path& folder, Write write) {
  if (has_part("hdf5")) {
    write(folder / "fields.h5");
    return {};
  }
  return {left_out_message("hdf5", "fields.h5") + ": " + left_out_advice("hdf5")};
}

/// What goes into files of its own, at most one of them by HDF5; nothing interrupts it.
void write_side_by_side(const std::vector<std::function<void()>>& parts) {
  const NeverCancelled whole;
  parallel_for(parts.size(), [&](std::size_t k) { parts[k](); });
}

/// Fields of an earlier run must not pass for those of one without any.
void remove_unmade(const std::filesystem::path& folder, const std::filesystem::path& made) {
  std::error_code ignored;
  if (!std::filesystem::exists(made / "fields.h5", ignored)) std::filesystem::remove(folder / "fields.h5", ignored);
}

constexpr const char* kDerivatives = "derivatives.csv";
constexpr const char* kOfLists[] = {"cases.csv", "cases.h5", "cases.json"};

/// Tables without cases.json are somebody's own.
bool holds_list(const std::filesystem::path& folder) {
  std::error_code unknown;
  return std::filesystem::exists(folder / "cases.json", unknown);
}

/// Text tables for other people's tools, of the cases that ask for them.
void write_text_tables(const std::filesystem::path& folder, const io::RunResult& result) {
  const std::string stem = std::filesystem::path(result.input_file).stem().string();
  for (const io::CaseResult& c : result.cases)
    for (std::size_t k = 0; k < c.patches.size(); ++k) {
      const io::PatchResult& patch = c.patches[k];
      const int letter = c.has_wheelset ? static_cast<int>(k) + 1 : 0;
      if (patch.element_table)
        io::write_mat(folder / io::case_file_name(stem, c.number, letter, "mat"), *patch.element_table, patch,
                      patch.all_elements);
      if (patch.subsurface_table && !patch.subsurface.empty())
        io::write_subs(folder / io::case_file_name(stem, c.number, letter, "subs"), patch.subsurface,
                       patch.full_tensor);
    }
}

/// What ParaView takes for time [deg or mm]: the first of these that grows from case to case.
std::vector<double> times_of(const io::RunResult& run) {
  using Case = io::CaseResult;
  constexpr double kDegrees = 180.0 / kPi;
  if (run.cases.size() < 2 || !ranges::all_of(run.cases, &Case::has_wheelset)) return {};
  for (const auto& [place, factor] : {std::pair{&Case::pitch, kDegrees},
                                      {&Case::s, kMilli},
                                      {&Case::y, kMilli},
                                      {&Case::yaw, kDegrees},
                                      {&Case::roll, kDegrees}}) {
    std::vector<double> times;
    times.reserve(run.cases.size());
    for (const Case& c : run.cases) times.push_back(io::rounded(factor * c.*place));
    if (ranges::is_sorted(times, std::less_equal<>())) return times;
  }
  return {};
}

}  // namespace

std::vector<std::string> result_files(const std::filesystem::path& folder, bool list) {
  std::vector<std::string> files;
  if (folder.empty()) return files;
  for (const char* name : {"result.json", "fields.h5", "pressure.svg", kDerivatives})
    files.push_back((folder / name).string());
  if (list || holds_list(folder))
    for (const char* name : kOfLists) files.push_back((folder / name).string());
  return files;
}

std::vector<std::string> write_result_folder(const std::filesystem::path& folder, const io::RunResult& result,
                                             bool bodies) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  const std::filesystem::path& made = output.path();
  const std::vector<double> times = times_of(result);
  std::vector<std::string> notes;
  write_side_by_side({
      [&] { notes = write_fields(made, [&](const auto& file) { io::write_hdf5(file, result); }); },
      [&] { io::write_vtk(made / "vtk", result, "result", times); },
      [&] {
        if (bodies) io::write_vtk_bodies(made / "vtk", result, "bodies", times);
      },
      [&] { write_file(made / "pressure.svg", pictures::pressure_svg(result)); },
      [&] { write_text_tables(made, result); },
      [&] { io::write_json(made / "result.json", result); },
  });
  remove_unmade(folder, output.path());
  std::error_code ignored;
  const std::string derivatives = io::derivatives_csv(result);
  // those of an earlier run; without results beside it the file is somebody's own
  if (derivatives.empty() && std::filesystem::exists(folder / "result.json", ignored))
    std::filesystem::remove(folder / kDerivatives, ignored);
  if (!derivatives.empty()) write_file(made / kDerivatives, derivatives);
  if (holds_list(folder))  // nor must tables of a list pass for those of this run
    for (const char* name : kOfLists) std::filesystem::remove(folder / name, ignored);
  output.move_into("result.json");
  return notes;
}

std::vector<std::string> write_comparison_folder(const std::filesystem::path& folder,
                                                 const io::Comparison& comparison) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  const std::filesystem::path& made = output.path();
  std::vector<std::string> notes;
  write_side_by_side({
      [&] { notes = write_fields(made, [&](const auto& file) { io::write_comparison_fields(file, comparison); }); },
      [&] { write_file(made / "pressures.svg", pictures::pressures_svg(comparison)); },
      [&] { write_file(made / "errors.svg", pictures::error_svg(comparison)); },
      [&] { write_file(made / "costs.svg", pictures::cost_svg(comparison)); },
      [&] { write_file(made / "table.txt", io::comparison_table(comparison)); },
      [&] { io::write_csv(made / "compare.csv", comparison); },
      [&] { io::write_json(made / "compare.json", comparison); },
  });
  remove_unmade(folder, output.path());
  output.move_into("compare.json");
  return notes;
}

}  // namespace treadmark::app
