// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/bench/common/scene.hpp"

namespace treadmark::bench {

/// Enters a method of the contact search in a scene: a first search and one after a small move, on the usual window and
/// on one twice as long and wide, on one thread and on two, through several backends.
bool enter_search(const char* name, detection::SearchMethod method, Scene scene);

}  // namespace treadmark::bench
