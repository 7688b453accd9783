// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/fmu/resources.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::fmi {
namespace {

namespace fs = std::filesystem;

/// Copies what cases name, each file into a folder of its own below the resources.
class Packer {
 public:
  explicit Packer(fs::path folder) : folder_(std::move(folder)) {}

  /// Where the file lies now, relative to the folder.
  fs::path add(const fs::path& file) {
    const auto known = packed_.find(file);
    if (known != packed_.end()) return known->second;
    const fs::path place = next_folder() / file.filename();
    const fs::path source = io::profile_file(file);
    copy(source, place.parent_path() / source.filename());
    return packed_[file] = place;
  }

  /// The same of offsets, which NanoVDB evaluates where they lie: an FMU needs no OpenVDB for them.
  fs::path add_offsets(const fs::path& file) {
    const auto known = packed_.find(file);
    if (known != packed_.end()) return known->second;
    const fs::path place = (next_folder() / file.filename()).replace_extension(".nvdb");
    offset::write_vdb(folder_ / place, offset::read_vdb(file));
    return packed_[file] = place;
  }

  /// Makes the source name its packed files.
  void pack(io::SurfaceSource& source, Body body) {
    const auto refuse = [&](const char* why, const char* advice) {
      throw Error(ErrorKind::configuration, why, source.where, advice);
    };
    if (source.backend == "level-set" || std::holds_alternative<io::SolidsInput>(source.geometry))
      refuse("FMUs do not take OpenVDB with them, which level sets need",
             "choose another backend, or convert the surface to triangles or slices: treadmark convert");
    if (!source.offsets.file.empty())
      refuse("FMUs do not read tables of deviations",
             "put them into a file of offsets: treadmark convert SHAPE wheel.nvdb --offsets TABLE");
    for (io::SurfaceSource& part : source.parts) pack(part, body);
    auto* geometry = std::get_if<io::GeometryFile>(&source.geometry);
    if (geometry == nullptr || !source.parts.empty()) return;
    const fs::path original = geometry->file;
    if (io::is_cad_file(original))
      refuse("FMUs do not take OpenCASCADE with them, which files of CAD need",
             "convert the surface to splines, slices or triangles: treadmark convert");
    const fs::path packed = io::can_hold(original, io::kOffsetFile) ? add_offsets(original) : add(original);
    if (io::is_slices_file(original)) add_profiles(original, packed.parent_path(), body, geometry->options);
    geometry->file = folder_ / packed;
  }

  void pack(io::WheelRailCase& c) {
    pack(c.rail, Body::rail);
    pack(c.wheel, Body::wheel);
    if (c.influence.kind == InfluenceSettings::Kind::table) c.influence.file = folder_ / add(c.influence.file);
  }

 private:
  fs::path next_folder() const { return fs::path("files") / std::to_string(packed_.size() + 1); }
  void copy(const fs::path& from, const fs::path& to) const { write_file(folder_ / to, io::read_text(from)); }

  /// Those that a file of slices names, beside it.
  void add_profiles(const fs::path& slices, const fs::path& place, Body body, const io::ProfileOptions& options) const {
    io::parse_slices(io::read_text(slices), slices.string(), body, [&](std::string name, const SourcePosition& where) {
      ranges::replace(name, '\\', '/');
      const fs::path relative = fs::path(name).lexically_normal();
      if (relative.is_absolute() || relative.begin()->string() == "..")
        throw Error(ErrorKind::configuration, fmt::format("'{}' lies outside the folder of the slices", name), where,
                    "put the profiles beside the file of slices, or below it");
      const fs::path source = slices.parent_path() / relative;
      copy(io::profile_file(source), place / io::profile_file(relative));
      return io::read_profile(source, body, options, where);
    });
  }

  fs::path folder_;
  std::map<fs::path, fs::path> packed_;
};

const io::Case& chosen_case(const io::CaseFile& file, int number) {
  const auto found = ranges::find_if(file.cases, [number](const io::Case& c) {
    return number > 0 ? c.number == number : std::holds_alternative<io::WheelRailCase>(c.content);
  });
  if (found == file.cases.end())
    throw Error(ErrorKind::configuration,
                number > 0 ? fmt::format("there is no case {}", number) : "there is no case of a wheel on a rail",
                {file.path.string(), 1, 1});
  if (!std::holds_alternative<io::WheelRailCase>(found->content))
    throw Error(ErrorKind::configuration, "an FMU holds wheels on rails, this case is a single patch", found->where);
  return *found;
}

/// The cases of an FMU: each starts its own sequence.
std::vector<io::Case> cases_of(const io::CaseFile& file, const FmuContent& content) {
  std::vector<io::Case> cases{chosen_case(file, content.number)};
  if (content.wheelset) {
    const auto side = [](io::Case& c) -> Side& { return std::get<io::WheelRailCase>(c.content).side; };
    const Side there = side(cases.front()), wanted = there == Side::left ? Side::right : Side::left;
    const auto other = ranges::find_if(file.cases, [wanted](const io::Case& c) {
      const auto* given = std::get_if<io::WheelRailCase>(&c.content);
      return given != nullptr && given->side == wanted;
    });
    cases.push_back(other == file.cases.end() ? cases.front() : *other);
    side(cases.back()) = wanted;
    if (there == Side::right) std::swap(cases[0], cases[1]);
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].number = static_cast<int>(i) + 1;
    cases[i].sequence = static_cast<int>(i);
    cases[i].steps = 0;
    std::get<io::WheelRailCase>(cases[i].content).history = HistoryUse::start;
  }
  return cases;
}

std::string write_wheels(const FmuContent& content, const fs::path& folder) {
  io::CaseFile file = app::read_registered_case(content.input.string(), content.overrides);
  file.cases = cases_of(file, content);
  Packer packer(folder);
  for (io::Case& c : file.cases) packer.pack(std::get<io::WheelRailCase>(c.content));
  const std::string text = io::case_file_text(file, folder);
  write_file(folder / kCaseFile, text);
  return fmt::format("{}: {}", file.cases.size() == 2 ? "wheelset on its rails" : "wheel on a rail", file.title);
}

std::string write_vehicle(const FmuContent& content, const fs::path& folder) {
  if (content.wheelset || content.number > 0)
    throw Error(ErrorKind::configuration, "--wheelset and --case belong to case files, this is a simulation",
                {content.input.string(), 1, 1});
  io::SimulationFile file = io::read_simulation_file(content.input, content.overrides);
  // The file stays as it is: where its files lie now, overrides say.
  std::vector<std::string> lines = content.overrides;
  const auto say = [&](const std::string& key, const fs::path& place) {
    lines.push_back(fmt::format("{}={}", key, io::toml_text(place.generic_string())));
  };
  Packer packer(folder);
  say("simulation.vehicle", packer.add(file.vehicle_file.path));
  if (file.track_file) say("simulation.track", packer.add(file.track_file->path));
  for (std::size_t i = 0; i < file.train.size(); ++i)
    if (const fs::path& path = file.train[i].file.path; !path.empty())
      say(fmt::format("simulation.train.{}.vehicle", i), packer.add(path));
  const auto say_geometry = [&](const std::string& key, const io::SurfaceSource& source) {
    const auto* geometry = std::get_if<io::GeometryFile>(&source.geometry);
    if (geometry != nullptr && source.parts.empty()) say(key, geometry->file.lexically_relative(folder));
  };
  const auto say_source = [&](const std::string& key, io::SurfaceSource& source, Body body) {
    packer.pack(source, body);
    say_geometry(key + ".shape.file", source);
    for (std::size_t i = 0; i < source.parts.size(); ++i)
      say_geometry(fmt::format("{}.parts.{}.file", key, i), source.parts[i]);
  };
  if (!file.left_rail || !file.right_rail) say_source("rail", file.contact.rail, Body::rail);
  say_source("wheel", file.contact.wheel, Body::wheel);
  if (file.other_wheel) say_source("simulation.other_wheel", *file.other_wheel, Body::wheel);
  if (file.left_rail) say_source("simulation.left_rail", *file.left_rail, Body::rail);
  if (file.right_rail) say_source("simulation.right_rail", *file.right_rail, Body::rail);
  if (file.table_rail) say_source("simulation.table_rail", *file.table_rail, Body::rail);
  if (file.contact.influence.kind == InfluenceSettings::Kind::table)
    say("influence.file", packer.add(file.contact.influence.file));
  write_file(folder / kCaseFile, io::read_text(content.input));
  write_file(folder / kOverridesFile, fmt::format("{}\n", fmt::join(lines, "\n")));
  return "vehicle on its track: " + file.title;
}

}  // namespace

std::string write_resources(const FmuContent& content, const fs::path& folder) {
  if (io::is_study_file(content.input))
    throw Error(ErrorKind::configuration, "a study of several simulations is no FMU", {content.input.string(), 1, 1},
                "give one simulation");
  return io::is_simulation_file(content.input) ? write_vehicle(content, folder) : write_wheels(content, folder);
}

}  // namespace treadmark::fmi
