// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/surface_difference.hpp"

namespace treadmark::app {

/// How far a written surface, read again, may lie from what it was written from, where nothing else is asked for [m].
inline constexpr double kWrittenTolerance = 10e-6;

/// The same of a surface of samples whose spacing was asked for [m]: what the sagitta of the sharpest arc of wheels and
/// rails, of 10 mm, is over it.
double sampled_tolerance(double spacing);

/// Of a surface read again from a file that was written, or would be. kind: what it is, in words. Errors:
/// Error(numerical) where it lies farther than the tolerance [m] from its source, or lacks much of it.
void require_as_written(const std::filesystem::path& file, const std::string& kind, Body body,
                        const SurfaceDifference& difference, double tolerance);

/// Runs work(). An error that names the place, or what lies beside it, names the file that it stands in for instead,
/// which users know.
template <class Work>
auto naming(const std::filesystem::path& file, const std::filesystem::path& place, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (!error.where().file.starts_with(place.parent_path().string())) throw;
    throw Error(error.kind(), error.message(), {file.string()}, error.advice());
  }
}

/// Surfaces on the way to their names: written into a hidden folder of the folder where they shall lie, which is gone
/// with this object. One thread.
class StagedOutputs {
 public:
  /// Where to write what shall become `file`. Errors: Error(configuration) where no folder can be made.
  std::filesystem::path place(const std::filesystem::path& file);

  /// Gives all of them their names. Errors: Error(configuration) naming the file.
  void commit();

 private:
  std::map<std::filesystem::path, OutputFolder> folders_;
  std::vector<std::filesystem::path> slices_;  ///< whose earlier folders go at last
};

}  // namespace treadmark::app
