// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app {

/// Adds a remark for each body that is touched beyond the first or last of its measured sections (slices), where its
/// surface only goes on as it ends. Surfaces that end there are judged by the solver.
void doubt_contact_beyond_data(const io::WheelRailCase& input, SurfaceStore& store, io::CaseResult& result);

/// Adds a remark where a rail is touched between sections that begin or end elsewhere (section_bridges.hpp), beside
/// them too, where its surface still swings; of a case that found no patch, where the wheel stands.
void doubt_contact_between_sections(const io::WheelRailCase& input, SurfaceStore& store, io::CaseResult& result);

}  // namespace treadmark::app
