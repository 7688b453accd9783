// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::io {

/// What a .toml file describes, by the tables at its top.
enum class FileKind {
  study,       ///< [study], whatever its base is
  evolution,   ///< [evolve]
  design,      ///< [design]
  simulation,  ///< [simulation]
  vehicle,     ///< [vehicle]
  track,       ///< [track] with a name, which the track of a case has not
  limits,      ///< [[limits]]
  import,      ///< any table of the settings of an import
  other,       ///< cases, and files that are no .toml, which are not opened
};

/// Throws Error(configuration) for TOML that cannot be read. Thread-safe.
FileKind file_kind(const std::filesystem::path& file);
/// The same by what a file holds. Never throws.
FileKind kind_of(const CaseTable& top);

inline bool is_study_file(const std::filesystem::path& file) { return file_kind(file) == FileKind::study; }
inline bool is_simulation_file(const std::filesystem::path& file) { return file_kind(file) == FileKind::simulation; }

}  // namespace treadmark::io
