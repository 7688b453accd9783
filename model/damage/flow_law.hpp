// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark {

/// What plastic flow below a surface follows from.
enum class FlowTheory {
  none,        ///< nothing flows
  ratchetting  ///< every passage adds shear strain where the orthogonal shear stress is above the yield
};

/// A law of plastic flow with its numbers, SI.
struct FlowLaw {
  FlowTheory theory = FlowTheory::none;
  std::string source;  ///< where the numbers come from

  double shear_yield = 0.0;       ///< k, in cyclic shear, of the fresh material [Pa]
  double strain_per_cycle = 0.0;  ///< C: strain of a passage at twice the yield [-]
  std::vector<double> depths;     ///< below the surface at which layers lie, increasing [m]
  double hardening_factor = 0.0;  ///< beta: yield of fully strained material over the fresh one [-]; 0: no hardening
  double hardening_rate = 0.0;    ///< alpha, of the strain [-]

  /// Effective shear yield after a shear strain: k max(1, beta sqrt(1 - exp(-alpha strain))) [Pa].
  double yield_after(double strain) const;
};

/// One row a theory: its word in study files, what it is, where it holds, and the keys that it needs.
struct FlowTheoryRow {
  FlowTheory theory;
  std::string_view word, name, source, validity;
  std::string_view keys;  ///< needed ones, with blanks between them
};

/// In the order of the enumerators after none.
inline constexpr FlowTheoryRow kFlowTheories[] = {
    {FlowTheory::ratchetting, "ratchetting",
     "shear strain of a passage = C (largest orthogonal shear stress / yield - 1) where that is > 0, layer by layer",
     "the layer model of Kapoor and Franklin 2000 (unverified: from secondary literature)",
     "line contacts of twin-disc tests; of other contacts the net of both directions along and across is taken",
     "shear_yield_MPa strain_per_cycle depths_mm"}};

/// The row of a theory other than none.
constexpr const FlowTheoryRow& flow_row(FlowTheory theory) {
  return kFlowTheories[static_cast<std::size_t>(theory) - 1];
}

/// Errors: Error(configuration) that names the key for numbers that are missing, negative or out of order.
void check(const FlowLaw& law);

}  // namespace treadmark
