// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/interfaces/python/python.hpp"

namespace treadmark::python {

/// A wheelset on its track, for its files and pictures.
struct FoundGeometry {
  std::shared_ptr<const app::GeometryResult> result;
  Strings notes;
};

/// A file that was measured, or that says why it was not.
struct FoundMeasures {
  std::shared_ptr<const app::MeasuredFile> file;
  app::MeasureRequest request;
};

}  // namespace treadmark::python
