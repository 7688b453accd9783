// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/verbs.hpp"

namespace treadmark::cli {
namespace {

constexpr Verb kVerbs[] = {
#define VERB(name, summary, part) {#name, summary, add_##name, part},
#include "treadmark/app/cli/verbs.def"
#undef VERB
};

}  // namespace

std::span<const Verb> verbs() { return kVerbs; }

}  // namespace treadmark::cli
