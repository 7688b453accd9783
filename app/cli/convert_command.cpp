// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>
#include <numbers>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/surfaces/convert_profile.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/profiles/write_profile.hpp"
#include "treadmark/io/results/summary.hpp"

namespace treadmark::cli {
namespace {

struct ConvertOptions {
  std::string input, output;  ///< geometry or case file; surface file
  std::string body;           ///< "wheel", "rail" or empty
  double resolution_mm = 0.0;
  double nominal_radius_mm = 0.0;
  double scale_to_mm = 1.0;
  std::vector<double> range_mm, range_deg;  ///< along the track, round the wheel: two numbers or none
  std::vector<std::string> overrides;
  app::ProfileConversion profile;  ///< where a profile is written
};

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

  if (io::is_writable_profile(options.output)) {
    std::cout << options.output << ": "
              << app::convert_profile(options.input, options.output, settings, options.profile) << '\n';
    return kOk;
  }
  if (options.profile.derivatives || options.profile.lambda_mm3 > 0.0 || options.profile.wavelength_mm > 0.0)
    throw Error(ErrorKind::configuration, "--smooth, --wavelength and --derivatives belong to profiles",
                {options.output}, "leave them out, or write .prr .prw .ban .whl or .csv");
  const app::Converted result = app::convert_surface(options.input, options.output, settings);
  const bool wheel = result.body == Body::wheel;
  const io::SurfaceUse use{
      wheel ? "wheel" : "rail",     std::string(result.written.surface->backend()), result.written.resolution,
      result.written.build_seconds, result.written.surface->memory_bytes(),         result.fit,
      result.written.note};
  std::cout << options.output << ": " << result.kind << ", " << io::summary(use) << '\n';
  return kOk;
}

}  // namespace

Command add_convert(CLI::App& verb) {
  auto options = std::make_shared<ConvertOptions>();
  verb.add_option("IN", options->input,
                  "Profile, slices, triangles (.ply .stl .obj .off), offsets (.vdb), or a case file")
      ->required();
  verb.add_option("OUT", options->output,
                  ".ply .stl .obj .off, .slcs .slcw, .vdb, or a profile: .prr .prw .ban .whl .csv")
      ->required();
  verb.add_option("--body", options->body, "wheel or rail, where the input does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  verb.add_option("--resolution", options->resolution_mm, "Spacing of the samples [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--nominal-radius", options->nominal_radius_mm, "Wheel radius at profile z = 0 [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--scale", options->scale_to_mm, "Factor from units of the file to mm (1000 for a file in m)")
      ->check(CLI::PositiveNumber);
  verb.add_option("--range-mm", options->range_mm, "Part of a rail: from, to along the track")
      ->delimiter(',')
      ->expected(2);
  verb.add_option("--range-deg", options->range_deg, "Part of a wheel: from, to round it")->delimiter(',')->expected(2);
  CLI::Option* lambda = verb.add_option("--smooth", options->profile.lambda_mm3,
                                        "Profile: smoothed with this parameter [mm3], as shape.smoothing_lambda_mm3")
                            ->check(CLI::PositiveNumber)
                            ->type_name("MM3");
  verb.add_option("--wavelength", options->profile.wavelength_mm,
                  "Profile: smoothed with this cut-off wavelength, as shape.smoothing_wavelength_mm")
      ->check(CLI::PositiveNumber)
      ->excludes(lambda)
      ->type_name("MM");
  verb.add_flag("--derivatives", options->profile.derivatives,
                "Profile as .csv, .ban or .whl: columns of arc length, inclination and curvature too");
  add_overrides(verb, options->overrides);
  return command(options, convert_command);
}

}  // namespace treadmark::cli
