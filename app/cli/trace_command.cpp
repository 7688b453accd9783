// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/trace_line.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct TraceOptions {
  std::string file, body, output, backend;
  double nominal_radius_mm = 0.0, scale = 1.0, step_mm = 1.0, resolution_mm = 0.0;
  std::optional<double> section_mm, section_deg, line_mm;
  std::vector<double> range_mm, range_deg;
  std::vector<std::string> overrides;
};

int trace_command(const TraceOptions& options, const CommonOptions& common) {
  const auto refuse = [&](const char* what, const char* advice) {
    throw Error(ErrorKind::configuration, what, {options.file}, advice);
  };
  if (options.section_mm.has_value() + options.section_deg.has_value() + options.line_mm.has_value() != 1)
    refuse("which line is meant is not said", "give one of --section-mm, --section-deg and --line-mm");
  const ThreadLimit limit(common.threads);
  catch_interrupt();
  const CancellationScope scope(&interrupted());
  app::NamedSurface said;
  said.body = body_asked(options.body, options.file, common.quiet);
  said.nominal_radius = 1e-3 * options.nominal_radius_mm;
  said.scale_to_mm = options.scale;
  said.overrides = options.overrides;
  const NaturalSurface natural = app::named_surface(options.file, said);
  const Body body = natural.spec.body;
  if (natural.spec.roller_radius != 0.0)
    refuse("lines are traced on rails and wheels, not on rollers", "trace the profile of the roller");
  const bool wheel = body == Body::wheel;
  if (wheel ? options.section_mm.has_value() : options.section_deg.has_value())
    refuse("a section of a rail lies at a place in mm, one of a wheel at an angle",
           "--section-mm for rails, --section-deg for wheels");
  app::TraceRequest request;
  constexpr double kDegree = std::numbers::pi / 180.0;
  request.section = !options.line_mm;
  request.at = options.section_deg ? kDegree * *options.section_deg
                                   : 1e-3 * (options.section_mm ? *options.section_mm : *options.line_mm);
  request.step = 1e-3 * options.step_mm;
  const bool angles = wheel && !request.section;
  if (angles ? !options.range_mm.empty() : !options.range_deg.empty())
    refuse("a range across or along the track is one in mm, one round a wheel in degrees", "--range-mm or --range-deg");
  if (!options.range_mm.empty()) request.range = {1e-3 * options.range_mm[0], 1e-3 * options.range_mm[1]};
  if (!options.range_deg.empty()) request.range = {kDegree * options.range_deg[0], kDegree * options.range_deg[1]};
  Representation wanted{options.backend, 1e-3 * options.resolution_mm, {}};
  if (request.range && !request.section)
    wanted.region.u_min = request.range->first, wanted.region.u_max = request.range->second;
  const RepresentedSurface represented = represent(natural, wanted);
  if (const std::string note = represented.resampled ? natural.note + represented.note : natural.note; !note.empty())
    print_notes({note}, common.quiet);
  const app::TracedLine line = app::trace_line(*represented.surface, body, request);
  const std::string csv = app::traced_csv(line);
  if (options.output.empty() || options.output == "-") {
    std::cout << csv;
    return kOk;
  }
  write_file(options.output, csv);
  std::cout << fmt::format("{}: {} points over {:.6g} mm, {}, derivatives {}\n", options.output, line.points.size(),
                           1e3 * line.points.back().s, line.backend,
                           line.exact_derivatives ? "of the representation" : "by differences");
  return kOk;
}

}  // namespace

Command add_trace(CLI::App& verb) {
  auto options = std::make_shared<TraceOptions>();
  verb.add_option("FILE", options->file, "Profile, slices, triangles, offsets (.vdb .nvdb) or case file")->required();
  verb.add_option("-o,--output", options->output, "CSV file; default: standard output")
      ->check(is_output(true))
      ->type_name("FILE");
  verb.add_option("--body", options->body, "wheel or rail, where the file does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  verb.add_option("--section-mm", options->section_mm, "Across a rail (constant u): at this x [mm]")->type_name("MM");
  verb.add_option("--section-deg", options->section_deg, "Across a wheel (constant u): at this angle")
      ->type_name("DEGREES");
  verb.add_option("--line-mm", options->line_mm,
                  "Along a rail or round a wheel (constant v): from this y on [mm]; needs a range")
      ->type_name("MM");
  verb.add_option("--range-mm", options->range_mm, "From, to: y of a section; x of a line along a rail")
      ->delimiter(',')
      ->expected(2);
  verb.add_option("--range-deg", options->range_deg, "From, to: angles of a line round a wheel")
      ->delimiter(',')
      ->expected(2);
  verb.add_option("--step", options->step_mm, "Arc length between points [mm]")
      ->capture_default_str()
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--backend", options->backend, "Representation; default: as given")->type_name("NAME");
  verb.add_option("--resolution", options->resolution_mm, "Spacing of its samples [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--nominal-radius", options->nominal_radius_mm, "Wheel radius at profile z = 0 [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--scale", options->scale, "From the numbers of profile and triangle files to mm")
      ->check(CLI::PositiveNumber);
  add_overrides(verb, options->overrides);
  return command(options, trace_command);
}

}  // namespace treadmark::cli
