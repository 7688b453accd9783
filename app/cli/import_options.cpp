// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/import_options.hpp"

#include <CLI/CLI.hpp>

namespace treadmark::cli {

void add_import_options(CLI::App& verb, ImportOptions& o) {
  verb.add_option("SCAN", o.scans,
                  "Points (.ply .stl .obj .off .las .xyz .asc .txt .csv), several files = several passes; or a gridded "
                  "map of deviations (.csv .asc)");
  verb.add_option(
          "-o,--output", o.outputs,
          "Surface file: .slcs .slcw (spline), .ply .stl .obj .off (mesh), .vdb (offset); may be given several times")
      ->allow_extra_args(false)
      ->type_name("FILE");
  verb.add_option("--report", o.report_folder,
                  "Folder for the audit: report.json, summary.txt, settings.toml and pictures (SVG)")
      ->type_name("FOLDER");
  verb.add_option("--json", o.json_file, "Write the audit here (JSON); - for standard output instead of the summary")
      ->type_name("FILE");
  verb.add_option("--settings", o.settings_file, "TOML file of settings (see --list-settings)")->type_name("FILE");
  verb.add_option("--body", o.body, "wheel or rail, where the surface file does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  verb.add_option("--unit", o.unit,
                  "Unit of the scan: m, mm, um, in; default: the file's word or the size of the wheel or rail")
      ->check(CLI::IsMember({"auto", "m", "mm", "um", "in"}));
  verb.add_option("--nominal", o.nominal,
                  "Nominal profile: S1002, 60E1, a profile file, none; default S1002 for wheels, 60E1 for rails")
      ->type_name("PROFILE");
  verb.add_option("--nominal-radius", o.nominal_radius_mm, "Wheel radius at profile z = 0 [mm], default from the scan")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--resolution", o.resolution_mm, "Distance of the surface's points [mm], default 0.5")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_flag("--list-settings", o.list_settings, "Print all settings with their defaults as a TOML file");
}

}  // namespace treadmark::cli
