// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>
#include <numbers>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/convert_surface.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/results/summary.hpp"

namespace treadmark::cli {

int convert_command(const ConvertOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  app::ConvertSettings settings;
  if (!options.body.empty()) settings.body = options.body == "wheel" ? Body::wheel : Body::rail;
  settings.resolution = 1e-3 * options.resolution_mm;
  settings.nominal_radius = 1e-3 * options.nominal_radius_mm;
  settings.scale_to_mm = options.scale_to_mm;
  settings.overrides = options.overrides;
  constexpr double kDegree = std::numbers::pi / 180.0;
  if (!options.range_mm.empty()) settings.range_x = {1e-3 * options.range_mm[0], 1e-3 * options.range_mm[1]};
  if (!options.range_deg.empty())
    settings.range_theta = {kDegree * options.range_deg[0], kDegree * options.range_deg[1]};

  const app::Converted result = app::convert_surface(options.input, options.output, settings);
  const bool wheel = result.body == Body::wheel;
  const io::SurfaceUse use{
      wheel ? "wheel" : "rail",     std::string(result.written.surface->backend()), result.written.resolution,
      result.written.build_seconds, result.written.surface->memory_bytes(),         result.fit,
      result.written.note};
  std::cout << options.output << ": " << result.kind << ", " << io::summary(use) << '\n';
  return kOk;
}

}  // namespace treadmark::cli
