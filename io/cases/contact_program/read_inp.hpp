// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string_view>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

/// Reads an input file (.inp) of the reference program (CONTACT): modules 1 (wheel-rail) and 3 (basic contact), any
/// number of cases with kept values. Everything is converted to SI. docs/contact-input.md lists what is supported.
/// Geometry files are resolved against the folder of the input file but not opened.
/// Throws Error (configuration) with file:line:column for a broken file and for whatever is not supported, named by its
/// control digit. Safe to call from several threads.
CaseFile read_contact_input(const std::filesystem::path& file);

/// The same for text that is already in memory; name serves for messages and for resolving geometry files.
CaseFile parse_contact_input(std::string_view text, const std::filesystem::path& name);

}  // namespace treadmark::io
