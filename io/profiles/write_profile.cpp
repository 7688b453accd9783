// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/write_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::io {
namespace {

/// The number of mm that a reader turns into exactly this number of metres.
double exact_mm(double metres) {
  constexpr double kMetresPerMm = 1e-3;
  const double mm = metres * 1e3;
  double below = mm, above = mm;
  for (int k = 0; k < 4; ++k) {
    if (below * kMetresPerMm == metres) return below;
    if (above * kMetresPerMm == metres) return above;
    below = std::nextafter(below, -INFINITY);
    above = std::nextafter(above, INFINITY);
  }
  return mm;
}

void check_name(const std::filesystem::path& file, const Profile& profile, bool with_derivatives) {
  const auto refuse = [&](const std::string& message, const std::string& advice) {
    throw Error(ErrorKind::configuration, message, {file.string(), 0, 0}, advice);
  };
  const std::string extension = extension_of(file);
  if (!is_writable_profile(file))
    refuse(fmt::format("profiles cannot be written to files '{}'", extension), "use .prr .prw .ban .whl or .csv");
  const std::optional<Body> named = profile_body(file);
  if (named && *named != profile.body)
    refuse(fmt::format("the extension {} stands for a {}, this is a {}", extension, body_name(*named),
                       body_name(profile.body)),
           profile.body == Body::rail ? "use .prr, .ban or .csv" : "use .prw, .whl or .csv");
  if (with_derivatives && (extension == ".prr" || extension == ".prw"))
    refuse("Simpack files have no columns for slope and curvature", "use .csv, .ban or .whl");
}

std::string simpack_text(const Profile& p) {
  std::string text = fmt::format(
      "header.begin\n  version = 1\n  type = {}\nheader.end\nspline.begin\n  approx.smooth = 0.\n  comment = 'written "
      "by "
      "Treadmark; y to the right, z down'\n  units.len.f = 1000.\n  units.ang.f = 1.\n  point.begin\n",
      p.body == Body::rail ? 0 : 1);
  for (std::size_t i = 0; i < p.y.size(); ++i)
    fmt::format_to(std::back_inserter(text), "    {} {}\n", exact_mm(p.y[i]), exact_mm(p.z[i]));
  return text + "  point.end\nspline.end\n";
}

std::string miniprof_text(const Profile& p, const ProfileDerivatives* d) {
  std::string text =
      fmt::format("ProgramName=Treadmark\nXYPoints={}\nColumnDef={}\n\n", p.y.size(), d != nullptr ? "X,Y,A,C" : "X,Y");
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{} {}", exact_mm(p.y[i]), -exact_mm(p.z[i]));
    // z up: angle and curvature change sign
    if (d != nullptr)
      fmt::format_to(std::back_inserter(text), " {:.9g} {:.9g}", -d->inclination[i], -1e-3 * d->curvature[i]);
    text += '\n';
  }
  return text;
}

std::string csv_text(const Profile& p, const ProfileDerivatives* d) {
  std::string text = d != nullptr ? "y [mm],z [mm],s [mm],inclination [rad],curvature [1/m]\n" : "y [mm],z [mm]\n";
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{}", exact_mm(p.y[i]), exact_mm(p.z[i]));
    if (d != nullptr)
      fmt::format_to(std::back_inserter(text), ",{:.9g},{:.9g},{:.9g}", 1e3 * d->s[i], d->inclination[i],
                     d->curvature[i]);
    text += '\n';
  }
  return text;
}

/// Some numbers of metres are those of no number of mm, but for rounding.
bool same_points(const Profile& a, const Profile& b) {
  constexpr double kRounding = 1e-15;  // m
  const auto same = [](const std::vector<double>& p, const std::vector<double>& q) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end(),
                      [](double u, double v) { return std::fabs(u - v) <= kRounding; });
  };
  return same(a.y, b.y) && same(a.z, b.z);
}

}  // namespace

bool is_writable_profile(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  for (const char* known : {".prr", ".prw", ".ban", ".whl", ".csv"})
    if (extension == known) return true;
  return false;
}

void write_profile(const std::filesystem::path& file, const Profile& profile, const ProfileDerivatives* derivatives) {
  check_name(file, profile, derivatives != nullptr);
  const std::string extension = extension_of(file);
  const std::string text = extension == ".csv"                          ? csv_text(profile, derivatives)
                           : extension == ".prr" || extension == ".prw" ? simpack_text(profile)
                                                                        : miniprof_text(profile, derivatives);
  ProfileOptions as_written;
  as_written.placement = ProfileOptions::Placement::as_in_file;
  as_written.smoothing = {};
  const Profile again = parse_profile(text, file.string(), profile_format(file), profile.body, as_written);
  if (!same_points(again, profile))
    throw Error(ErrorKind::configuration,
                "a reader of this file would take the points for others (upside down, zig-zag)", {file.string(), 0, 0},
                extension == ".csv" ? "use .prr or .prw, which say how they stand" : "use .csv");
  write_file(file, text);
}

}  // namespace treadmark::io
