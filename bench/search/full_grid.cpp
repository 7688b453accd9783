// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/search/enter.hpp"

namespace treadmark::bench {

[[maybe_unused]] const bool full_grid =
    enter_search("full_grid/damaged", detection::SearchMethod::full_grid, Scene::damaged);
[[maybe_unused]] const bool full_grid_round =
    enter_search("full_grid/round", detection::SearchMethod::full_grid, Scene::round);

}  // namespace treadmark::bench
