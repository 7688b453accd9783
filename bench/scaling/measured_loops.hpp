// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::bench {

/// A chain of parts that cannot be done beside each other, and the loops between them.
struct Strand {
  double work = 0.0;      ///< processor time of all parts and all tasks of loops [s]
  double span = 0.0;      ///< the same of the chain, on which a loop takes as long as its longest task [s]
  double in_tasks = 0.0;  ///< part of the span within loops [s]
  long loops = 0;         ///< on the chain
};

/// The thread that runs main(), from its beginning.
Strand measured_so_far();

}  // namespace treadmark::bench
