// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/app/measured/told.hpp"

#include <nlohmann/json.hpp>

#include "treadmark/tests/app/program.hpp"

namespace treadmark::testing {

bool Told::doubted(const std::string& word) const {
  return status != 0 && (out.find(word) != std::string::npos || err.find(word) != std::string::npos);
}

Told told_by(const std::vector<std::string>& arguments) {
  const ProgramResult r = run_program(arguments);
  Told told;
  told.status = r.status;
  told.out = r.out;
  told.err = r.err;
  return told;
}

Told told_by_run(const std::filesystem::path& file, const std::vector<std::string>& keys) {
  std::vector<std::string> arguments{"run", file.string(), "--json", "-"};
  for (const std::string& key : keys) arguments.insert(arguments.end(), {"--set", key});
  Told told = told_by(arguments);
  if (told.refused() || told.out.empty()) return told;
  const nlohmann::json result = nlohmann::json::parse(told.out);
  for (const nlohmann::json& c : result["cases"]) {
    ToldCase& one = told.cases.emplace_back();
    one.status = c["status"];
    double most = -1.0;
    for (const nlohmann::json& patch : c["patches"]) {
      one.pmax_MPa = std::max(one.pmax_MPa, patch["pmax_MPa"].get<double>());
      if (patch["fn_N"].get<double>() <= most) continue;
      most = patch["fn_N"];
      one.y_tr_mm = patch["reference"]["y_tr_mm"];
      one.angle_rad = patch["reference"]["angle_rad"];
      one.noise_MPa = patch.contains("noise") ? patch["noise"]["pmax_MPa"].get<double>() : 0.0;
    }
  }
  return told;
}

}  // namespace treadmark::testing
