// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/search/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool locus = enter_search("locus/round", detection::SearchMethod::locus, Scene::round);

}  // namespace treadmark::bench
