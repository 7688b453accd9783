// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <span>

namespace CLI {
class App;
}

namespace treadmark::cli {

/// Exit statuses of the program.
enum ExitStatus : int { kOk = 0, kFailed = 1, kUsage = 2, kInputData = 3, kNotConverged = 4 };

struct CommonOptions {
  int threads = 0;             ///< 0 = all cores
  bool threads_given = false;  ///< by the user
  bool quiet = false;          ///< no progress
};

/// Does the work of a verb, whose options it holds. Returns an exit status or throws treadmark::Error.
using Command = std::function<int(const CommonOptions&)>;

/// One verb of the program. add: its options, and the command that they are parsed into.
struct Verb {
  const char* name;
  const char* summary;
  Command (*add)(CLI::App& verb);
};

/// All verbs, in the order in which they are listed.
std::span<const Verb> verbs();

#define VERB(name, summary) Command add_##name(CLI::App& verb);
#include "treadmark/app/cli/verbs.def"
#undef VERB

}  // namespace treadmark::cli
