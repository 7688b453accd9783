// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/backends/offset/openvdb/sheet_library.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/modules.hpp"

namespace treadmark::offset {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFileName = "libtreadmark_openvdb.so";

/// Where the library may lie; a bare name: on the run path of the program.
std::vector<fs::path> places() {
  std::vector<fs::path> all = module_folders();
  for (fs::path& folder : all) folder /= kFileName;
  all.emplace_back(kFileName);
  return all;
}

const SheetLibrary& load() {
  std::string tried;
  for (const fs::path& file : places()) {
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = module != nullptr ? dlsym(module, "treadmark_sheet_library") : nullptr;
    if (symbol == nullptr) {
      const char* why = dlerror();
      tried += "\n  " + std::string(why != nullptr ? why : file.string());
      continue;
    }
    const SheetLibrary& library = *reinterpret_cast<decltype(&treadmark_sheet_library)>(symbol)();
    if (std::string_view(library.version) == TREADMARK_MODULE_VERSION) return library;
    tried += "\n  " + file.string() + " is of version " + library.version;
  }
  throw Error(ErrorKind::configuration,
              std::string("cannot load ") + kFileName + ", which offsets and level sets need:" + tried, {},
              module_advice("openvdb"));
}

}  // namespace

const SheetLibrary& sheet_library() {
  static const SheetLibrary& library = load();
  return library;
}

}  // namespace treadmark::offset
