// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/result_head.hpp"

#include "treadmark/app/simulation/input_files.hpp"
#include "treadmark/app/version.hpp"

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
  return head_of(file, options);
}
io::SimulationResult result_head(const io::CaseFile& file, const SimulationOptions& options) {
  return head_of(file, options);
}

}  // namespace treadmark::app
