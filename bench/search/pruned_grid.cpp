// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/search/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool pruned_grid =
    enter_search("pruned_grid/damaged", detection::SearchMethod::pruned_grid, Scene::damaged);
[[maybe_unused]] const bool pruned_grid_round =
    enter_search("pruned_grid/round", detection::SearchMethod::pruned_grid, Scene::round);

}  // namespace treadmark::bench
