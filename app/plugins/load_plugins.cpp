// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/plugins/plugin.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/modules.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/sha256.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

struct LoadedPlugins {
  std::mutex mutex;
  std::vector<std::pair<std::string, std::string>> files;  ///< and their hashes
} loaded;

[[noreturn]] void refuse_plugin(const std::string& file, const std::string& why, const std::string& advice) {
  throw Error(ErrorKind::configuration, why, {file}, advice);
}

std::string plugin_file(const std::string& name) {
  std::error_code failed;
  std::string looked;
  if (!fs::exists(name, failed) && name.find('/') == std::string::npos)
    for (const fs::path& folder : module_folders()) {
      for (const std::string& as : {name, name + ".so"})
        if (!name.empty() && fs::exists(folder / "plugins" / as, failed)) return fs::canonical(folder / "plugins" / as);
      looked += (looked.empty() ? "it is neither here nor in " : ", ") + (folder / "plugins").string();
    }
  if (!looked.empty())
    throw MissingFile(ErrorKind::configuration, "the plug-in does not exist", {name}, advice_on_missing(name, looked));
  require_file(name, "plug-in", ErrorKind::configuration);
  return fs::canonical(name);
}

PluginRows rows_of_plugin(const std::string& file) {
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    refuse_plugin(file, fmt::format("this cannot be loaded as a library: {}", dlerror()),
                  "name a plug-in, a shared library (.so) that was built for this machine");
  const auto abi = reinterpret_cast<const char* (*)()>(dlsym(library, "treadmark_plugin_abi"));
  const auto fill = reinterpret_cast<void (*)(PluginRows*)>(dlsym(library, "treadmark_plugin_rows"));
  if (abi == nullptr || fill == nullptr)
    refuse_plugin(file, "this is a library, but no plug-in: it lacks treadmark_plugin_abi or treadmark_plugin_rows",
                  "a plug-in is made by TREADMARK_PLUGIN, see docs/write-a-backend.md");
  if (abi() != plugin_abi())
    refuse_plugin(file, fmt::format("this was built for another Treadmark: '{}', not '{}'", abi(), plugin_abi()),
                  "build it again with the headers and libraries of this Treadmark");
  PluginRows rows;
  fill(&rows);
  return rows;
}

}  // namespace

void load_plugins(const std::vector<std::string>& names) {
  const std::lock_guard lock(loaded.mutex);
  for (const std::string& name : names) {
    const std::string file = plugin_file(name);
    if (ranges::any_of(loaded.files, [&](const auto& known) { return known.first == file; })) continue;
    try {
      const PluginRows rows = rows_of_plugin(file);
      std::string hash = io::sha256_file(file);
      for (const Backend& row : rows.backends) register_backend(row);
      for (const detection::DetectorRow& row : rows.detectors) detection::register_detector(row);
      loaded.files.emplace_back(file, std::move(hash));
    } catch (const Error& error) {
      refuse_plugin(file, error.message(), error.advice());
    }
  }
}

std::vector<std::string> plugins_of_environment() {
  std::vector<std::string> files;
  const char* named = std::getenv("TREADMARK_PLUGINS");
  std::istringstream list(named != nullptr ? named : "");
  for (std::string name; std::getline(list, name, ':');) {
    std::vector<std::string> here;
    std::error_code failed;
    for (fs::directory_iterator one(name, failed), end; !failed && one != end; one.increment(failed))
      if (one->path().extension() == ".so") here.push_back(one->path().string());
    if (failed && !name.empty()) here = {name};  // a file; or load_plugins says what is wrong with it
    ranges::sort(here);
    files.insert(files.end(), here.begin(), here.end());
  }
  return files;
}

std::vector<std::pair<std::string, std::string>> loaded_plugins() {
  const std::lock_guard lock(loaded.mutex);
  return loaded.files;
}

std::string plugin_identity() {
  std::string text;
  for (const auto& [file, hash] : loaded_plugins()) text += fmt::format("plug-in {}\n", hash);
  return text;
}

}  // namespace treadmark::app
