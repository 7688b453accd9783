// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/fmu/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "treadmark/app/version.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/sha256.hpp"

namespace treadmark::fmi {

Model::Model() {
  Variable time;
  time.name = "time";
  time.unit = "s";
  time.description = "simulation time";
  time.kind = Variable::Kind::time;
  variables_.add(std::move(time));
}

void Model::use_start_values() {
  values_.assign(variables_.scalars(), 0.0);
  for (const Variable& v : variables_.all()) std::fill_n(values_.begin() + v.reference, v.elements(), v.start);
}

void Model::reset() {
  use_start_values();
  reset_state();
}

std::vector<double> Model::derivative(std::span<const std::uint32_t>, std::span<const std::uint32_t>,
                                      std::span<const double>) {
  throw Error(ErrorKind::configuration, "this FMU has no directional derivatives");
}

double Model::end() const { return std::numeric_limits<double>::infinity(); }

double Model::usual_step() const {
  constexpr double kUsual = 1e-3;
  return std::min(kUsual, end());
}

void Model::save(ByteWriter& out) const {
  out.put(values_);
  save_state(out);
}

void Model::restore(ByteReader& in) {
  std::vector<double> values;
  in.get(values);
  if (values.size() != values_.size()) refuse_saved_state("it has another number of variables");
  restore_state(in);
  if (!in.at_end()) refuse_saved_state("it goes on after its end");
  values_ = std::move(values);
}

std::unique_ptr<Model> open_model(const std::filesystem::path& resources) {
  return io::is_simulation_file(resources / kCaseFile) ? open_vehicle(resources) : open_wheels(resources);
}

std::vector<std::string> read_overrides(const std::filesystem::path& resources) {
  std::vector<std::string> lines;
  const std::filesystem::path file = resources / kOverridesFile;
  if (!std::filesystem::exists(file)) return lines;
  std::istringstream text(io::read_text(file));
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

std::string token_of(const std::filesystem::path& resources) {
  std::vector<std::string> files;
  std::error_code failed;
  for (auto at = std::filesystem::recursive_directory_iterator(resources, failed);
       !failed && at != std::filesystem::recursive_directory_iterator(); at.increment(failed))
    if (at->is_regular_file())
      files.push_back(at->path().lexically_relative(resources).generic_string() + ' ' + io::sha256_file(at->path()));
  if (failed || files.empty())
    throw Error(ErrorKind::input_data, fmt::format("cannot read the resources in {}", resources.string()), {},
                "unpack the FMU again");
  ranges::sort(files);
  const std::string digest = io::sha256_hex(fmt::format("{}\n{}", app::version(), fmt::join(files, "\n")));
  return fmt::format("{{{}-{}-{}-{}-{}}}", digest.substr(0, 8), digest.substr(8, 4), digest.substr(12, 4),
                     digest.substr(16, 4), digest.substr(20, 12));
}

}  // namespace treadmark::fmi
