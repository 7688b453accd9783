// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "treadmark/core/error.hpp"

namespace treadmark {

/// A file that is to be read and is not there.
class MissingFile : public Error {
 public:
  using Error::Error;
};

/// Errors, placed at `where`, or at the file where that is unknown: MissingFile, which names the file of that folder
/// that was probably meant; Error for a folder or a device. what: its role, "case file". kind: of both.
/// Error(configuration) for an output of the command (core/output_claim.hpp). Thread-safe.
void require_file(const std::filesystem::path& file, std::string_view what, ErrorKind kind,
                  const SourcePosition& where = {});

/// What to do about a file that is not there: the name in its folder that was probably meant, else `otherwise`, or that
/// the folder is not there either. Thread-safe.
std::string advice_on_missing(const std::filesystem::path& file, const std::string& otherwise = {});

/// Letters to be changed, left out, added or exchanged with their neighbour from one text to another; small letters and
/// capitals are the same. (Restricted Damerau-Levenshtein distance.)
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate that a name was probably meant to be; empty when nothing is near.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// What to do about a name that is none of those known: the one that was probably meant, else `otherwise`, or all.
std::string advice_on_name(std::string_view name, std::span<const std::string> known,
                           const std::string& otherwise = {});

}  // namespace treadmark
