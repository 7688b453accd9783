// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/modules.hpp"

#include <dlfcn.h>

#include <cstdlib>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {

namespace fs = std::filesystem;

std::vector<fs::path> module_folders() {
  if (const char* own = std::getenv("TREADMARK_MODULES"); own != nullptr && *own != '\0') return {own};
  std::vector<fs::path> folders;
  // What the working directory holds is nobody's module: programs are known by the name that they were called by.
  const auto add = [&](const fs::path& folder) {
    if (folder.is_absolute() && ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
  };
  std::error_code failed;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", failed); !failed)
    for (const char* libraries : {"lib", TREADMARK_LIBRARIES})
      add(program.parent_path().parent_path() / libraries / "treadmark");
  if (Dl_info here{}; dladdr(reinterpret_cast<const void*>(&module_folders), &here) != 0 && here.dli_fname != nullptr)
    add(fs::path(here.dli_fname).parent_path() / "treadmark");
  for (const char* place : {TREADMARK_BUILT_MODULES, TREADMARK_INSTALLED_MODULES}) add(place);
  return folders;
}

std::string module_advice(std::string_view part) {
  return "install the Debian package treadmark-" + std::string(part) + " of this version, or all of Treadmark again";
}

}  // namespace treadmark
