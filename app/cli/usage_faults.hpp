// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace treadmark::cli {

/// The words of a command line, of which "help", "help run" and "run help" are what --help is.
std::vector<std::string> with_help(std::vector<std::string> words);

/// The first word that is no option has to be a verb. Errors: Error(configuration) where it is none, or where an option
/// of several letters has one hyphen only.
void check_words(const CLI::App& program, const std::vector<std::string>& words);

/// What the parser refused, with the option or value that was probably meant, and how the verb is called: lines for
/// standard error.
std::string usage_fault(const CLI::App& program, const CLI::ParseError& refused);

}  // namespace treadmark::cli
