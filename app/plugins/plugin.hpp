// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/backends/registry.hpp"
#include "treadmark/backends/resampling.hpp"
#include "treadmark/core/version.hpp"
#include "treadmark/detection/detector.hpp"

namespace treadmark::app {

/// Counts changes of what program and plug-in hand to each other that neither sizes nor the version show.
inline constexpr int kPluginAbi = 1;

/// What a plug-in brings.
struct PluginRows {
  std::vector<Backend> backends;                  ///< representations of surfaces
  std::vector<detection::DetectorRow> detectors;  ///< ways to look for contact
};

/// Tells apart what cannot work together: that number, the version, and how the compiler of who calls it lays out what
/// is handed over.
inline std::string plugin_abi() {
  std::string text = "plug-in " + std::to_string(kPluginAbi) + " of Treadmark " + treadmark::version() + ", C++ " +
                     std::to_string(__GXX_ABI_VERSION) + ", layout";
  for (const std::size_t size :
       {sizeof(PluginRows), sizeof(Backend), sizeof(Resampling), sizeof(NaturalSurface), sizeof(Surface),
        sizeof(SurfacePoint), sizeof(PlaneGrid), sizeof(detection::DetectorRow), sizeof(detection::SearchSettings),
        sizeof(detection::SearchResult), static_cast<std::size_t>(EIGEN_MAX_STATIC_ALIGN_BYTES)})
    text += ' ' + std::to_string(size);
  return text;
}

/// What a function registers. Errors: its own.
inline PluginRows rows_of(void (*register_rows)()) {
  const std::size_t known = backends().size(), known_detectors = detection::detectors().size();
  register_rows();
  PluginRows rows;
  const auto all = backends();
  for (std::size_t i = known; i < all.size(); ++i) rows.backends.push_back(*all[i]);
  const auto detectors = detection::detectors();
  for (std::size_t i = known_detectors; i < detectors.size(); ++i) rows.detectors.push_back(*detectors[i]);
  return rows;
}

/// Loads plug-ins for the rest of the process: their backends and detectors are choices wherever names are read. names:
/// files; one without a slash that is not there, with or without ".so", is looked for in the folders plugins of
/// core/modules.hpp. What is loaded already is passed over. Errors, placed at the file: MissingFile;
/// Error(configuration) for what is no library or no plug-in, was built for another Treadmark or registers a name that
/// is taken; what was registered before stays. Thread-safe.
void load_plugins(const std::vector<std::string>& names);

/// Files that $TREADMARK_PLUGINS names, with colons between them; of a folder all that end with .so.
std::vector<std::string> plugins_of_environment();

/// The files of those that are loaded, each with its hash, in their order.
std::vector<std::pair<std::string, std::string>> loaded_plugins();

/// A line with the hash of each, for what is kept under a name of all that it depends on; empty without plug-ins.
std::string plugin_identity();

}  // namespace treadmark::app

/// Begins the one function of a plug-in, TREADMARK_PLUGIN() { ... }, which calls register_backend and
/// detection::register_detector. A plug-in is a shared library with a Treadmark of its own inside, so what it registers
/// there is handed to the program that loads it.
#define TREADMARK_PLUGIN()                                                                                         \
  static void treadmark_plugin_registers();                                                                        \
  extern "C" __attribute__((visibility("default"))) const char* treadmark_plugin_abi() {                           \
    static const std::string text = treadmark::app::plugin_abi();                                                  \
    return text.c_str();                                                                                           \
  }                                                                                                                \
  extern "C" __attribute__((visibility("default"))) void treadmark_plugin_rows(treadmark::app::PluginRows* rows) { \
    *rows = treadmark::app::rows_of(treadmark_plugin_registers);                                                   \
  }                                                                                                                \
  static void treadmark_plugin_registers()
