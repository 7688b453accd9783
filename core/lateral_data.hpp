// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

namespace treadmark {

/// What surfaces can tell, too, that are fitted to data along lines.
class LateralData {
 public:
  virtual ~LateralData() = default;
  /// Lateral parameters v (see SurfacePoint) at which the data lie, increasing. Thread-safe.
  virtual std::vector<double> data_v() const = 0;
};

/// Mark of surfaces whose lateral parameter v is arc length along their profile [m], zero where the profile's data have
/// it.
class ArcLengthParameter {
 public:
  virtual ~ArcLengthParameter() = default;
};

}  // namespace treadmark
