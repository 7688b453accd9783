// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/settings/key_words.hpp"

namespace treadmark::io {

/// The cases as a Treadmark case file (.toml) that reads as the same cases, from the table of its keys. What is as it
/// is without a key is left out; sections that all cases share stand at the top. Names of files count from folder.
/// Errors: Error(configuration) at a case that such a file cannot hold: one of both kinds in a file. Thread-safe.
std::string case_file_text(const CaseFile& file, const std::filesystem::path& folder);

/// What the cases ask for, in words and units, for people: what differs from a case without keys, and what everybody
/// wants to know. Cases of another kind than the first are left out. Thread-safe.
Inputs inputs_of(std::span<const Case> cases, const std::filesystem::path& folder);

/// The cases as input of CONTACT (.inp) that reads as the same cases: every case gives all it needs, none keeps values.
/// Settings that are Treadmark's own and no part of the problem (representation, search, details) stand in lines that
/// CONTACT takes for comments, "%treadmark key = value".
/// Errors: Error(configuration) at a case with what such a file cannot say, by the name of its setting. Thread-safe.
std::string contact_input_text(const CaseFile& file, const std::filesystem::path& folder);
/// One case of such a file; sequence: what stands behind the module on its first line.
std::string contact_case_text(const Case& c, const std::filesystem::path& folder, std::string_view sequence);

}  // namespace treadmark::io
