// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/convert_profile.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/app/surfaces/written_surface.hpp"
#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/resampling.hpp"
#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/core/copy_bytes.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/write_profile.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

constexpr double kAnyRadius = 0.46;  // [m]
constexpr double kStep = 0.25e-3;    // [m] between points of arcs, as where formulas become splines

struct InputProfile {
  Profile profile;                        ///< whose points are written
  std::optional<NaturalSurface> surface;  ///< that they were sampled from
};

/// Of a surface whose section is the same everywhere.
InputProfile section_of(const NaturalSurface& natural, double resolution) {
  const auto* profile = std::get_if<Profile>(&natural.spec.shape);
  if (profile != nullptr && resolution == 0.0) return {*profile, {}};
  const double step = resolution > 0.0 ? resolution : kStep;
  std::optional<NaturalSurface> straight;  // a roller is written as the rail that its section would be
  if (natural.spec.roller_radius == 0.0) straight = natural;
  // Formulas by their length, so that steep sides have as many points.
  if (natural.spec.defects.empty())
    if (const std::optional<Profile> formula = sampled_formula(natural.spec, step)) return {*formula, straight};
  const Representation wanted{"", step, {}};
  return {Resampling(natural, wanted).section(), straight};
}

InputProfile input_profile(const std::filesystem::path& input, const std::filesystem::path& output,
                           const ConvertSettings& settings) {
  const auto refuse = [&](const char* what, const char* advice) {
    throw Error(ErrorKind::configuration, what, {input.string()}, advice);
  };
  if (settings.range_x || settings.range_theta)
    refuse("ranges belong to surfaces, a profile is written", "leave them out");
  if (is_profile_file(input) && !library_body_of(input)) {
    if (settings.resolution > 0.0) refuse("the points of a profile stay as they are", "leave out --resolution");
    refuse_overrides(input.string(), settings.overrides);
    std::optional<Body> body = settings.body ? settings.body : io::profile_body(input);
    if (!body) body = io::profile_body(output);
    if (!body) refuse("the file does not say whether it is a wheel or a rail", "say --body wheel or --body rail");
    io::ProfileOptions options;
    options.scale = settings.scale_to_mm;
    options.smoothing = {};  // the file's own points
    return {io::read_profile(input, *body, options, {}), {}};
  }
  const std::optional<Body> body = settings.body ? settings.body : io::profile_body(output);
  // A section is the same at any radius; library names of wheels have none.
  const double radius = settings.nominal_radius > 0.0 ? settings.nominal_radius
                        : library_body_of(input)      ? kAnyRadius
                                                      : 0.0;
  const NaturalSurface natural = named_surface(input, {body, radius, settings.scale_to_mm, settings.overrides});
  if (!natural.constant_profile())
    refuse("the section is not the same everywhere, and one profile is written", "write triangles, slices or offsets");
  return section_of(natural, settings.resolution);
}

/// The surface of points of a profile, at any radius.
NaturalSurface surface_of_points(const Profile& profile) {
  return create_natural({profile.body, profile.body == Body::wheel ? kAnyRadius : 0.0, profile, {}});
}

/// Writes it where it is read again as what it was made from, at the place to see that.
void write_checked_points(const std::filesystem::path& output, const Profile& profile,
                          const io::ProfileDerivatives* derivatives, const NaturalSurface& meant, double tolerance) {
  std::optional<OutputFolder> own;
  StagedOutputs staged;
  if (is_stream(output)) own.emplace(std::filesystem::temp_directory_path(), OutputFolder::Old::kept);
  const std::filesystem::path place = own ? own->path() / output.filename() : staged.place(output);
  const SurfaceDifference difference = naming(output, place, [&] {
    io::write_profile(place, profile, derivatives);
    io::SurfaceSource again;
    io::GeometryFile as_written{place, {}};
    as_written.options.placement = io::ProfileOptions::Placement::as_in_file;
    as_written.options.smoothing = {};
    again.geometry = as_written;
    again.where = {place.string(), 0, 0};
    const NaturalSurface back = read_surface(again, profile.body, meant.spec.nominal_radius);
    return fit_error(meant, {back.surface, true, 0.0, {}, 0.0, {}});
  });
  require_as_written(output, "the points", profile.body, difference, tolerance);
  if (own)
    copy_bytes(place, output);
  else
    staged.commit();
}

std::string in_words(const Profile& profile, bool smoothed) {
  return fmt::format("{} profile, {} points{}", body_name(profile.body), profile.y.size(),
                     smoothed ? ", smoothed" : "");
}

}  // namespace

std::string convert_profile(const std::filesystem::path& input, const std::filesystem::path& output,
                            const ConvertSettings& settings, const ProfileConversion& how) {
  auto [profile, surface] = input_profile(input, output, settings);
  using Method = SmoothingOptions::Method;
  if (how.lambda_mm3 > 0.0) profile.smoothing = {Method::spline, 1e-9 * how.lambda_mm3};
  if (how.wavelength_mm > 0.0) profile.smoothing = {Method::weighted_spline, 1e-3 * how.wavelength_mm};
  const bool smoothed = profile.smoothing.strength > 0.0;
  if (smoothed || !surface) surface = surface_of_points(profile);
  io::ProfileDerivatives derivatives;
  if (smoothed || how.derivatives) {
    const std::vector<double> s = spline::arc_length(profile);
    const spline::ProfileSpline curve = spline::fit_profile(profile);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vec2 d = curve.derivative(s[i]), dd = curve.second_derivative(s[i]);
      const double length = std::hypot(d[0], d[1]);
      derivatives.inclination.push_back(std::atan2(d[1], d[0]));
      derivatives.curvature.push_back((d[0] * dd[1] - d[1] * dd[0]) / (length * length * length));
      if (smoothed) profile.y[i] = curve.position(s[i])[0], profile.z[i] = curve.position(s[i])[1];
    }
    derivatives.s = s;
  }
  write_checked_points(output, profile, how.derivatives ? &derivatives : nullptr, *surface, tolerance_of(settings));
  return in_words(profile, smoothed);
}

std::string write_section(const NaturalSurface& surface, const std::filesystem::path& output) {
  const auto [profile, meant] = section_of(surface, 0.0);
  write_checked_points(output, profile, nullptr, meant ? *meant : surface_of_points(profile), kWrittenTolerance);
  return in_words(profile, false);
}

}  // namespace treadmark::app
