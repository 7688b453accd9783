// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

/// Makes "fine-grid", every point of a grid with half of the usual steps, a detector by name. Once a program.
void register_fine_grid();
