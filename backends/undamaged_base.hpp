// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/backends/resampling.hpp"

namespace treadmark {

/// A surface without its damage, for representations that add what is missing to it.
struct UndamagedBase {
  SurfaceSpec spec;  ///< a constant section
  std::shared_ptr<const Surface> surface;
  Rectangle region_uy;  ///< where the two may differ, within the region: x = u [m] or [rad], y [m]; may be infinite
};

/// The section that a surface is known to have, without defects, or else its median one. given: use this one instead.
/// The region becomes small where nothing is damaged: there is nothing to be sampled. Errors: those of the backend of
/// the section and of sampling.
UndamagedBase undamaged_base(Resampling& resampling, const SurfaceSpec* given = nullptr);

}  // namespace treadmark
