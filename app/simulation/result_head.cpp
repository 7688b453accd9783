// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/simulation/result_head.hpp"

#include "treadmark/app/plugins/plugin.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::app {

namespace {

template <class File>
io::SimulationResult head_of(const File& file, const SimulationOptions& options) {
  io::SimulationResult result;
  result.version = version();
  result.git = git_revision();
  result.input_file = file.path.filename().string();
  result.input_sha256 = file.sha256;
  result.geometry_sha256 = input_hashes(file);
  result.title = file.title;
  result.settings = options.settings;
  result.swept = options.swept;
  return result;
}

}  // namespace

io::SimulationResult result_head(const io::SimulationFile& file, const SimulationOptions& options) {
  io::SimulationResult result = head_of(file, options);
  result.inputs = io::inputs_of(file);
  result.chosen = !file.history.channels.empty();
  return result;
}
io::SimulationResult result_head(const io::CaseFile& file, const SimulationOptions& options) {
  io::SimulationResult result = head_of(file, options);
  result.inputs = io::inputs_of(file.cases, file.path.parent_path());
  return result;
}

namespace {

class Hashes {
 public:
  void add(const std::filesystem::path& file, const SourcePosition& where) {
    if (ranges::find(seen_, file) != seen_.end()) return;
    try {
      hashes_.emplace_back(file.filename().string(), io::sha256_file(file));
    } catch (const Error& e) {
      if (where.file.empty()) throw;
      throw Error(e.kind(), file.string() + ": " + e.message(), where, e.advice());
    }
    seen_.push_back(file);
  }

  void add(const io::SurfaceSource& source) {
    for (const io::SurfaceSource& part : source.parts) add(part);
    const auto* geometry = std::get_if<io::GeometryFile>(&source.geometry);
    if (geometry != nullptr && source.parts.empty()) add(geometry->file, source.where);
    if (const auto* given = std::get_if<io::SolidsInput>(&source.geometry))
      for (const io::SolidInput& solid : given->solids) add(solid.file, source.where);
    if (!source.offsets.file.empty()) add(source.offsets.file, source.offsets.where);
  }

  void add(const io::InfluenceInput& influence) {
    if (influence.kind == io::InfluenceInput::Kind::table) add(influence.file, {});
  }

  void add(const io::WheelRailCase& c) {
    add(c.rail);
    add(c.wheel);
    add(c.influence);
  }

  void add(const io::NamedFile& file) { hashes_.emplace_back(file.path.filename().string(), file.sha256); }

  FileHashes take() {
    for (const auto& [file, hash] : loaded_plugins())
      hashes_.emplace_back(std::filesystem::path(file).filename().string(), hash);
    return std::move(hashes_);
  }

 private:
  std::vector<std::filesystem::path> seen_;
  FileHashes hashes_;
};

}  // namespace

FileHashes input_hashes(const io::SimulationFile& file) {
  Hashes hashes;
  hashes.add(file.contact);
  for (const auto* source : {&file.other_wheel, &file.left_rail, &file.right_rail, &file.table_rail})
    if (*source) hashes.add(**source);
  hashes.add(file.vehicle_file);
  for (const io::TrainPart& part : file.train)
    if (!part.file.path.empty()) hashes.add(part.file);
  if (file.track_file) hashes.add(*file.track_file);
  if (file.irregularity_file) hashes.add(*file.irregularity_file);
  return hashes.take();
}

FileHashes input_hashes(const io::CaseFile& file) {
  Hashes hashes;
  for (const io::Case& c : file.cases) {
    if (const auto* contact = std::get_if<io::WheelRailCase>(&c.content))
      hashes.add(*contact);
    else
      hashes.add(std::get<io::BasicCase>(c.content).influence);
  }
  return hashes.take();
}

}  // namespace treadmark::app
