// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/io/results/result_model.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// The page of one case that solves what its reader changes; it opens with the case as the run has it. run: of one
/// wheel on a rail, with its surfaces. solving.wheels, rails and backends are filled in.
report::Page live_page(const std::shared_ptr<const io::RunResult>& run, report::Solving solving);

}  // namespace treadmark::app::pages
