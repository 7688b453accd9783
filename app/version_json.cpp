// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <nlohmann/json.hpp>

#include "treadmark/app/version.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::app {

std::string version_json() {
  nlohmann::ordered_json out{{"version", version()}, {"git", git_revision()}, {"licence", licence()}};
  for (const Part& part : parts()) out["parts"][std::string(part.key)] = part.built;
  for (const LinkedLibrary& library : linked_libraries())
    out["libraries"].push_back({{"name", library.name},
                                {"version", library.version},
                                {"licence", library.licence},
                                {"linked", library.shared.empty() ? "headers" : "shared"}});
  return out.dump(2) + '\n';
}

}  // namespace treadmark::app
