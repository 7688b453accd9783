// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::testing {

/// A folder with a small vehicle, track, simulation and study, which solve in about a second. Removed at the end.
class SampleSimulation : public SampleInput {
 public:
  SampleSimulation();

  /// Two wheelsets instead of one, on rails that bend below both and have a joint.
  void share_rails();

  std::string path(const std::string& file) const { return (folder() / file).string(); }
};

}  // namespace treadmark::testing
