// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/surfaces/contact_files.hpp"
#include "treadmark/app/surfaces/convert_profile.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/write_profile.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/length_unit.hpp"

namespace treadmark::cli {
namespace {

struct ConvertOptions {
  std::string input, output;  ///< geometry or case file; surface or case file
  std::string body;           ///< "wheel", "rail" or empty
  std::string backend;        ///< of splines; empty: as it comes
  double resolution_mm = 0.0;
  double nominal_radius_mm = 0.0;
  double scale_to_mm = 1.0;
  double tolerance_um = 0.0;
  std::vector<double> range_mm, range_deg;  ///< along the track, round the wheel: two numbers or none
  std::optional<double> at;                 ///< of the results of a simulation [s]
  std::string simulation;                   ///< its file; empty: to be looked for
  std::vector<std::string> overrides;
  std::string offsets, offsets_unit, deviation_unit;  ///< a table of deviations, and its units: empty = as it says
  bool offsets_deg = false;
  app::ProfileConversion profile;  ///< where a profile is written
};

io::CaseFile read_cases(const ConvertOptions& options) {
  const bool results = io::extension_of(options.input) == ".h5";
  if (options.at) {
    if (!results)
      throw Error(ErrorKind::configuration, "--at needs the results of a simulation", {options.input},
                  "give its simulation.h5");
    return cases_of_instant(options.input, options.simulation, *options.at, options.overrides);
  }
  if (results)
    throw Error(ErrorKind::configuration, "which instant of these results is meant is not said", {options.input},
                "give its time in seconds, --at TIME");
  if (io::is_simulation_file(options.input))
    throw Error(ErrorKind::configuration, "a simulation is no case, but an instant of its results is", {options.input},
                "treadmark convert simulation.h5 OUT --at TIME");
  return io::read_any_case(options.input, options.overrides);
}

/// What is said of surfaces and profiles, which cases have keys for.
void refuse_surface_options(const ConvertOptions& o) {
  if (o.body.empty() && o.resolution_mm == 0.0 && o.nominal_radius_mm == 0.0 && o.scale_to_mm == 1.0 &&
      o.tolerance_um == 0.0 && o.range_mm.empty() && o.range_deg.empty() && o.offsets.empty() &&
      !o.profile.derivatives && o.profile.lambda_mm3 == 0.0 && o.profile.wavelength_mm == 0.0)
    return;
  throw Error(ErrorKind::configuration, "cases are written, and only --set, --at and --simulation change them",
              {o.output}, "leave the other options out, or set keys of the shapes: --set rail.shape.scale_to_mm=1000");
}

/// Case files into each other, and instants of simulations into case files.
int convert_cases(const ConvertOptions& options, const CommonOptions& common) {
  refuse_surface_options(options);
  const std::filesystem::path output = options.output;
  io::CaseFile file = read_cases(options);
  app::require_registered(file);
  print_notes(file.notes, common.quiet);
  std::string text;
  if (io::extension_of(output) == ".inp") {
    const auto surfaces = app::put_contact_files(file, output);
    text = io::contact_input_text(file, output.parent_path());
    io::parse_contact_input(text, output);  // nothing that cannot be read is written
    for (const auto& write : surfaces) std::cout << write() << '\n';
  } else {
    text = io::case_file_text(file, output.parent_path());
    io::parse_case_text(text, output);
  }
  write_file(output, text);
  std::cout << fmt::format("{}: {} {}\n", options.output, file.cases.size(), file.cases.size() == 1 ? "case" : "cases");
  return kOk;
}

/// What reading a profile changed or could not be sure of, or the import of a surface; the exit status that follows.
int tell_doubts(const ConvertOptions& options, const app::ConvertSettings& settings) {
  const std::optional<Body> body = settings.body ? settings.body : io::profile_body(options.output);
  int status = kOk;
  for (const std::string& doubt : app::import_doubts(options.input, body.value_or(Body::rail))) {
    std::cerr << "warning: " << doubt << '\n';
    status = kFailed;
  }
  std::error_code ignored;
  if (!app::is_profile_file(options.input) || !std::filesystem::exists(io::profile_file(options.input), ignored))
    return status;
  io::ProfileOptions how;
  how.scale = settings.scale_to_mm;
  const io::ProfileJudgement judged = app::check_profile(options.input, body, how).judgement;
  print_notes(judged.notes, false);
  for (const io::ProfileRemark& doubt : judged.remarks) {
    if (doubt.name == "gauge_point") continue;  // it is asked for where the rail is placed
    std::cerr << "warning: " << doubt.name << ": " << doubt.text << '\n';
    status = kFailed;
  }
  return status;
}

int convert_command(const ConvertOptions& options, const CommonOptions& common) {
  if (!options.backend.empty() && !io::is_spline_file(options.output))
    throw Error(ErrorKind::configuration, "--backend belongs to files of splines", {options.output},
                "leave it out, or write .xml");
  if (const std::string kind = io::extension_of(options.output); kind == ".inp" || kind == ".toml")
    return convert_cases(options, common);
  if (options.at) throw Error(ErrorKind::configuration, "an instant is written as .toml or .inp", {options.output});
  const ThreadLimit limit(common.threads);
  catch_interrupt();
  const CancellationScope scope(&interrupted());
  app::ConvertSettings settings;
  if (!options.body.empty() || !io::profile_body(options.output))
    settings.body = body_asked(options.body, options.input, common.quiet);
  settings.resolution = 1e-3 * options.resolution_mm;
  settings.backend = options.backend;
  settings.nominal_radius = 1e-3 * options.nominal_radius_mm;
  settings.scale_to_mm = options.scale_to_mm;
  settings.tolerance = 1e-6 * options.tolerance_um;
  settings.overrides = options.overrides;
  settings.offsets = {
      options.offsets, length_unit(options.offsets_unit), length_unit(options.deviation_unit), options.offsets_deg, {}};
  constexpr double kDegree = std::numbers::pi / 180.0;
  if (!options.range_mm.empty()) settings.range_x = {1e-3 * options.range_mm[0], 1e-3 * options.range_mm[1]};
  if (!options.range_deg.empty())
    settings.range_theta = {kDegree * options.range_deg[0], kDegree * options.range_deg[1]};

  if (io::is_writable_profile(options.output)) {
    if (!options.offsets.empty())
      throw Error(ErrorKind::configuration, "deviations on a grid cannot be written as one profile", {options.output},
                  "write triangles, slices or offsets: .ply .stl .obj .off .slcs .slcw .vdb .nvdb");
    std::cout << options.output << ": "
              << app::convert_profile(options.input, options.output, settings, options.profile) << '\n';
    return tell_doubts(options, settings);
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
  for (const SurfaceDoubt& doubt : result.source.spec.doubts)
    std::cerr << "warning: " << in_words(doubt, body_name(result.body), options.input) << '\n';
  return result.source.spec.doubts.empty() ? kOk : kFailed;
}

}  // namespace

Command add_convert(CLI::App& verb) {
  auto options = std::make_shared<ConvertOptions>();
  verb.add_option(
          "IN", options->input,
          "Profile, slices, triangles (.ply .stl .obj .off), CAD (.step .iges), splines (.xml), offsets (.vdb .nvdb), "
          "a name of 'treadmark list profiles', a case file, or with --at the simulation.h5 of a simulation")
      ->required()
      ->type_name(kProfileName);
  verb.add_option(
          "OUT,-o,--output", options->output,
          ".ply .stl .obj .off, .vtp (ParaView, in m), .slcs .slcw, .vdb, .nvdb, .step, .xml, or a profile: .prr .prw "
          ".ban .whl .csv; of a case file also .inp (CONTACT) or .toml: its cases")
      ->check(is_output(true))
      ->required();
  verb.add_option("--body", options->body, "wheel or rail, where the input does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  verb.add_option("--backend", options->backend,
                  "Splines that are written to .xml: nurbs, thb or thb-quadratic; default: those given, else nurbs");
  verb.add_option("--resolution", options->resolution_mm, "Spacing of the samples [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--nominal-radius", options->nominal_radius_mm, "Wheel radius at profile z = 0 [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option(
          "--tolerance-um", options->tolerance_um,
          "How far the file, read again, may lie from the input; default 10 um, with --resolution what a radius "
          "of 10 mm rises over it")
      ->check(CLI::PositiveNumber)
      ->type_name("UM");
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
  std::vector<std::string> units;
  units.reserve(kLengthUnits.size());
  for (const LengthUnit unit : kLengthUnits) units.emplace_back(symbol(unit));
  CLI::Option* table = verb.add_option("--offsets", options->offsets,
                                       "Table of deviations that is added (z of a rail, radius of a wheel): .csv .txt "
                                       "matrix or .asc grid, as rail.offsets.file of a case")
                           ->type_name("TABLE");
  verb.add_option("--offsets-unit", options->offsets_unit, "Of its positions, where it does not tell: mm")
      ->check(CLI::IsMember(units))
      ->needs(table);
  verb.add_option("--deviation-unit", options->deviation_unit, "Of its deviations; default: that of the positions")
      ->check(CLI::IsMember(units))
      ->needs(table);
  verb.add_flag("--offsets-deg", options->offsets_deg, "Its places round a wheel are degrees, not lengths")
      ->needs(table);
  CLI::Option* at =
      verb.add_option("--at", options->at, "Time of an instant of a simulation [s]: its contacts become cases")
          ->type_name("SECONDS");
  verb.add_option("--simulation", options->simulation,
                  "With --at: the simulation file, where it is not beside the results or their folder")
      ->needs(at);
  add_overrides(verb, options->overrides);
  return command(options, convert_command);
}

}  // namespace treadmark::cli
