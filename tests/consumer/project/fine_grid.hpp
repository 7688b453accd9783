// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

/// Makes "fine-grid" a choice wherever Treadmark reads names of detectors: every point of a grid with half of the usual
/// steps. Once a program. Errors: those of treadmark::detection::register_detector.
void register_fine_grid();
