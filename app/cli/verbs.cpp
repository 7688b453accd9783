// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/verbs.hpp"

#include "treadmark/io/files/replaced.hpp"

namespace treadmark::cli {
namespace {

constexpr Verb kVerbs[] = {
#define VERB(name, group, summary, part, examples) {#name, group, summary, part, examples, add_##name},
#include "treadmark/app/cli/verbs.def"
#undef VERB
};

}  // namespace

std::span<const Verb> verbs() { return kVerbs; }

std::string example_lines(const Verb& verb) {
  return "  treadmark " + io::replaced(verb.examples, "\n", "\n  treadmark ") + '\n';
}

}  // namespace treadmark::cli
