// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "treadmark/app/cases/output_files.hpp"
#include "treadmark/app/cases/position_picture.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/pages/check_page.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/surfaces/surface_check.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/foreign_kind.hpp"
#include "treadmark/report/pictures/section_picture.hpp"

namespace treadmark::cli {
namespace {

struct CheckOptions {
  std::vector<std::string> cases;
  std::vector<std::string> overrides;  ///< key=value
  std::string output_folder;           ///< of pictures; empty = none
  std::string report_file;             ///< HTML; empty = none
  std::string body;                    ///< of profiles: "wheel", "rail" or empty
};

std::string position_svg(const app::CaseGeometry& c) {
  const app::PositionSection section = app::position_section(std::get<io::WheelRailCase>(c.given->content), c.geometry);
  const auto curve = [](const std::vector<Vec2>& points) {
    pictures::Curve out;
    for (const Vec2& p : points) out.push_back({kMilli * p.x(), -kMilli * p.y()});
    return out;
  };
  const double gap = kMilli * section.least_gap;
  const std::string how = std::isnan(gap) ? "the wheel does not lie over the rail"
                          : gap > 0.0     ? fmt::format("{:.4g} mm apart", gap)
                          : gap < 0.0     ? fmt::format("{:.4g} mm in each other", -gap)
                                          : "touching";
  return pictures::section_svg(
      {fmt::format("Case {}: {}", c.given->number, how), curve(section.rail), curve(section.wheel), {}, ""});
}

/// What was understood of a profile, one fact a line.
void print_profile(const app::CheckedProfile& profile) {
  std::size_t width = 0;
  for (const auto& [name, value] : profile.judgement.facts) width = std::max(width, name.size());
  const auto line = [&](const std::string& name, const std::string& value) {
    print("  " + name + std::string(width + 2 - std::min(width, name.size()), ' ') + value + '\n');
  };
  std::cout << profile.name << '\n';
  for (const auto& [name, value] : profile.judgement.facts) line(name, value);
  for (const std::string& note : profile.judgement.notes) line("note", note);
  for (const io::ProfileRemark& remark : profile.judgement.remarks) line("warning", remark.name + ": " + remark.text);
}

using app::pages::CheckedInput;

void add_profile(const app::CheckedProfile& profile, CheckedInput& to) {
  print_profile(profile);
  to.profiles.emplace_back(profile.name, profile.judgement);
}

std::size_t doubts_of(const CheckedInput& input) {
  std::size_t count = input.doubts.size();
  for (const auto& [name, judgement] : input.profiles) count += judgement.remarks.size();
  return count;
}

void check_geometry_file(const CheckOptions& options, CheckedInput& input) {
  app::refuse_overrides(input.file, options.overrides);
  std::optional<Body> body;
  if (!options.body.empty()) body = options.body == "wheel" ? Body::wheel : Body::rail;
  add_profile(
      app::is_surface_file(input.file) ? app::check_surface(input.file, body) : app::check_profile(input.file, body),
      input);
}

/// pictures: the folder for them; empty: none.
void check_case_file(const CheckOptions& options, const std::filesystem::path& pictures, CheckedInput& input) {
  const io::CaseFile file = app::read_registered_case(input.file, options.overrides);
  const std::vector<app::CaseGeometry> cases = app::check_geometry(file);
  print_notes(file.notes, false);
  input.notes = file.notes;
  input.title = file.title;
  input.inputs = io::inputs_of(file.cases, file.path.parent_path());
  if (!pictures.empty() || !options.report_file.empty())
    for (const app::CaseGeometry& c : cases)
      input.positions.emplace_back(fmt::format("Case {}", c.given->number), position_svg(c));
  if (!pictures.empty()) {
    make_folder(pictures);
    for (std::size_t k = 0; k < cases.size(); ++k)
      write_file(pictures / fmt::format("position_{:04}.svg", cases[k].given->number), input.positions[k].second);
  }
  for (const std::string& doubt : app::value_doubts(file)) {
    print("  warning  " + doubt + '\n');
    input.doubts.push_back(doubt);
  }
  for (const app::CheckedProfile& profile : app::check_profiles(file)) add_profile(profile, input);
  for (const app::CheckedProfile& surface : app::check_surfaces(file)) add_profile(surface, input);
  const std::size_t doubts = doubts_of(input);
  input.outcome = fmt::format("{}{}, no errors{}", file.cases.size(), file.cases.size() == 1 ? " case" : " cases",
                              doubts == 0 ? "" : fmt::format(", {} warning{}", doubts, doubts == 1 ? "" : "s"));
  std::cout << input.file << ": " << input.outcome << '\n';
}

/// Files that are read and built, and no more.
struct PlainKind {
  io::FileKind kind;
  void (*check)(const std::string& name, const std::vector<std::string>& overrides);
};
constexpr PlainKind kPlainKinds[] = {
    {io::FileKind::study, check_study_file},     {io::FileKind::evolution, check_evolution_file},
    {io::FileKind::design, check_design_file},   {io::FileKind::simulation, check_simulation_file},
    {io::FileKind::vehicle, check_vehicle_file}, {io::FileKind::track, check_track_file},
    {io::FileKind::limits, check_limits_file},   {io::FileKind::import, check_import_file}};

bool is_geometry_file(const std::string& name) { return app::is_profile_file(name) || app::is_surface_file(name); }

/// Null for profiles, surfaces and cases.
const PlainKind* plain_kind_of(const std::string& name) {
  if (is_geometry_file(name)) return nullptr;
  const auto found = ranges::find(kPlainKinds, io::file_kind(name), &PlainKind::kind);
  return found == std::end(kPlainKinds) ? nullptr : &*found;
}

/// By the names of the case files.
std::map<std::string, std::filesystem::path> picture_folders(const CheckOptions& options) {
  if (options.output_folder.empty()) return {};
  std::vector<std::string> names;
  ranges::copy_if(options.cases, std::back_inserter(names),
                  [](const std::string& name) { return !is_geometry_file(name) && plain_kind_of(name) == nullptr; });
  const std::vector<std::filesystem::path> folders = app::output_folders(options.output_folder, names);
  std::map<std::string, std::filesystem::path> by_name;
  for (std::size_t k = 0; k < names.size(); ++k) by_name[names[k]] = folders[k];
  return by_name;
}

int check_command(const CheckOptions& options, const CommonOptions&) {
  std::map<std::string, std::filesystem::path> pictures = picture_folders(options);
  std::vector<CheckedInput> inputs;
  for (const std::string& name : options.cases) {
    CheckedInput& input = inputs.emplace_back();
    input.file = name;
    io::refuse_foreign_file(name);
    if (is_geometry_file(name))
      check_geometry_file(options, input);
    else if (const PlainKind* kind = plain_kind_of(name))
      kind->check(name, options.overrides);
    else
      check_case_file(options, pictures[name], input);
  }
  write_report_file(options.report_file, [&] { return app::pages::check_page(inputs); });
  return ranges::any_of(inputs, [](const CheckedInput& input) { return doubts_of(input) > 0; }) ? kFailed : kOk;
}

}  // namespace

Command add_check(CLI::App& verb) {
  auto options = std::make_shared<CheckOptions>();
  add_case_files(verb, options->cases, options->overrides);
  add_output(verb, "-o,--output", options->output_folder,
             "Folder for a picture of wheel over rail for each case, at its position: position_0001.svg; of "
             "several case files for one with the name of each",
             "FOLDER");
  add_report_file(verb, options->report_file);
  verb.add_option("--body", options->body, "Of profiles: wheel or rail, where the file does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  return command(options, check_command);
}

}  // namespace treadmark::cli
