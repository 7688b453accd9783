// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

/// Makes "chebyshev" a choice wherever Treadmark reads names of backends: the undamaged surface and, added to it, what
/// the given one differs by, as a truncated Chebyshev series of low rank. Rails and wheels. Once a program.
/// Errors: those of treadmark::register_backend.
void register_chebyshev();
