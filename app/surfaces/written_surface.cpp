// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/written_surface.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/write_slices.hpp"

namespace treadmark::app {
namespace {

std::string length_text(double metres) {
  constexpr double kLarge = 1e-3;
  return metres < kLarge ? fmt::format("{:.3g} um", 1e6 * metres) : fmt::format("{:.4g} mm", 1e3 * metres);
}

}  // namespace

double sampled_tolerance(double spacing) {
  constexpr double kSharpest = 10e-3;
  return std::max(kWrittenTolerance, spacing * spacing / (8.0 * kSharpest));
}

void require_as_written(const std::filesystem::path& file, const std::string& kind, Body body,
                        const SurfaceDifference& difference, double tolerance) {
  constexpr double kMostMissing = 0.05, kOtherSurface = 2e-3;
  const auto all = static_cast<double>(difference.points + difference.missing);
  if (difference.points == 0 || static_cast<double>(difference.missing) > kMostMissing * all)
    throw Error(ErrorKind::numerical,
                fmt::format("read again, {} lack {:.3g} % of what they were written from: nothing was written", kind,
                            all > 0.0 ? 100.0 * static_cast<double>(difference.missing) / all : 100.0),
                {file.string()}, "write triangles (.ply), which may have gaps and any outline");
  if (difference.height_max <= tolerance) return;
  const std::string place = body == Body::wheel
                                ? fmt::format("{:.5g} degrees", difference.worst_u * 180.0 / std::numbers::pi)
                                : fmt::format("x = {:.5g} mm", 1e3 * difference.worst_u);
  throw Error(
      ErrorKind::numerical,
      fmt::format("read again, {} lie up to {} from what they were written from, more than {}, at {}, y = "
                  "{:.4g} mm: nothing was written",
                  kind, length_text(difference.height_max), length_text(tolerance), place, 1e3 * difference.worst_y),
      {file.string()},
      difference.height_max > kOtherSurface
          ? "the file would be read as another surface: see what treadmark check says of the input, or write "
            "triangles (.ply)"
          : "sample it more finely, or allow it: --resolution, --tolerance-um");
}

std::filesystem::path StagedOutputs::place(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (std::filesystem::is_regular_file(folder))
    throw Error(ErrorKind::configuration, fmt::format("cannot write {}: its folder is a file", file.string()), {},
                "choose another output folder");
  if (io::is_slices_file(file)) slices_.push_back(file);
  return folders_.try_emplace(folder, folder, OutputFolder::Old::kept).first->second.path() / file.filename();
}

void StagedOutputs::commit() {
  for (auto& [name, folder] : folders_)
    folder.move_into({}, [&, &within = name] {
      for (const std::filesystem::path& file : slices_)
        if ((file.has_parent_path() ? file.parent_path() : ".") == within) io::remove_other_slices(file);
    });
}

}  // namespace treadmark::app
