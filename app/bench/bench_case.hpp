// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// The case of the benchmark: an S1002 wheel with a rounded flat (160 mm x 60 mm, 1.4 mm deep) on 60E1 with a squat
/// (40 mm x 30 mm, 0.5 mm deep), 125 kN, the contact on the flank of the flat.
io::CaseFile bench_case();

}  // namespace treadmark::app
