// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/scan_options.hpp"

#include <CLI/CLI.hpp>

#include <cstddef>

namespace treadmark::cli {

void add_scan_options(CLI::App& verb, ScanOptions& o) {
  const auto length = [&](const char* name, double& value, const char* text) {
    verb.add_option(name, value, text)->check(CLI::NonNegativeNumber)->type_name("MM");
  };
  const auto share = [&](const char* name, double& value, const char* text) {
    verb.add_option(name, value, text)->check(CLI::Range(0.0, 0.9))->type_name("SHARE");
  };
  const auto range = [&](const char* name, std::vector<double>& value, const char* text) {
    verb.add_option(name, value, text)->delimiter(',')->expected(2)->type_name("FROM,TO");
  };
  verb.add_option("SURFACE", o.surface,
                  "Profile, slices, triangles (.ply .stl .obj .off), offsets (.vdb), or a case file")
      ->required();
  verb.add_option("-o,--output", o.cloud, "File of points: .ply .las .xyz .asc .txt .csv")
      ->required()
      ->type_name("FILE");
  verb.add_option("--truth", o.truth_file,
                  "Write what is known about the scan here (JSON); - for standard output instead of the summary")
      ->type_name("FILE");
  verb.add_option("--body", o.body, "wheel or rail, where the input does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  CLI::Option* points =
      verb.add_option("--points", o.points, "Points on the surface before any are lost, default 1000000")
          ->check(CLI::Range(std::size_t{1}, std::size_t{200'000'000}));
  verb.add_option("--spacing-mm", o.spacing_mm, "Between points, instead of their number")
      ->check(CLI::PositiveNumber)
      ->type_name("MM")
      ->excludes(points);
  length("--noise-mm", o.noise_mm, "Standard deviation along the beam, which meets the surface along its normal");
  length("--noise-lateral-mm", o.noise_lateral_mm, "Standard deviation across the beam");
  share("--outliers", o.outliers, "Share of all points that lie off the surface");
  share("--holes", o.holes, "Share of the area without points");
  length("--hole-size-mm", o.hole_size_mm, "Mean diameter of the holes, default 4");
  share("--drop-outs", o.drop_outs, "Share of the points lost one by one and in short runs");
  verb.add_option("--most-incidence-deg", o.most_incidence_deg,
                  "Steeper to the beam nothing is seen; 0 = everything is")
      ->check(CLI::Range(0.0, 90.0))
      ->type_name("DEG");
  verb.add_option("--passes", o.passes, "Passes that overlap by a quarter, beside each other (rail) or round the wheel")
      ->check(CLI::Range(1, 1000));
  length("--registration-mm", o.registration_mm, "Standard deviation of each pass's error of position");
  verb.add_option("--frame", o.frame, "Frame of the cloud: identity (that of the surface) or random")
      ->check(CLI::IsMember({"identity", "random"}));
  verb.add_option("--unit", o.unit, "Unit of the file: mm (default), m, um, in")
      ->check(CLI::IsMember({"mm", "m", "um", "in"}));
  range("--range-mm", o.range_mm, "Part of a rail: from, to along the track");
  range("--range-deg", o.range_deg, "Part of a wheel: from, to round it");
  range("--range-y-mm", o.range_y_mm, "Part across: from, to");
  verb.add_option("--nominal-radius,--nominal-radius-mm", o.nominal_radius_mm, "Wheel radius at profile z = 0 [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--scale,--scale-to-mm", o.scale_to_mm,
                  "Factor from units of the surface's file to mm (1000 for a file in m)")
      ->check(CLI::PositiveNumber);
  verb.add_option("--seed", o.seed, "Of all random numbers, default 1; the same seed gives the same points");
}

}  // namespace treadmark::cli
