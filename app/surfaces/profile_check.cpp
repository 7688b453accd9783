// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/profile_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/model/natural_view.hpp"

namespace treadmark::app {
namespace {

/// The standard profiles of a body as points.
std::vector<io::StandardOutline> outlines(Body body) {
  constexpr double kFarthest = 0.15, kStep = 0.1e-3, kAnyRadius = 0.5;
  std::vector<io::StandardOutline> list;
  for (const std::string_view name : standard_profile_names()) {
    SurfaceSpec spec;
    spec.body = body;
    spec.shape = StandardProfile{std::string(name)};
    spec.nominal_radius = body == Body::wheel ? kAnyRadius : 0.0;
    NaturalSurface natural;
    try {
      natural = create_natural(spec);
    } catch (const Error&) {
      continue;  // of the other body
    }
    std::vector<double> y, z;
    for (double at = -kFarthest; at <= kFarthest; at += kStep) y.push_back(at);
    z.resize(y.size());
    HeightsOut out;
    out.z = z;
    section_heights(*natural.surface, body, 0.0, y, out);
    io::StandardOutline outline;
    outline.name = name;
    for (std::size_t k = 0; k < y.size(); ++k)
      if (!std::isnan(z[k])) {
        outline.y.push_back(y[k]);
        outline.z.push_back(z[k] - spec.nominal_radius);
      }
    list.push_back(std::move(outline));
  }
  return list;
}

const std::vector<io::StandardOutline>& standards(Body body) {
  static const std::vector<io::StandardOutline> rails = outlines(Body::rail), wheels = outlines(Body::wheel);
  return body == Body::wheel ? wheels : rails;
}

enum class Standards { no, yes };

CheckedProfile checked(const io::SourcedProfile& profile, const std::filesystem::path& file,
                       const io::ExpectedWheel& expected, Standards compare) {
  const Body body = profile.profile.body;
  return {fmt::format("{} profile {}", body == Body::wheel ? "wheel" : "rail", file.string()), body,
          io::judge_profile(profile, expected,
                            compare == Standards::no ? std::vector<io::StandardOutline>() : standards(body))};
}

/// One use of a file: the same file may be turned or scaled otherwise elsewhere.
struct ProfileUse {
  io::GeometryFile file;
  Body body;
  io::ExpectedWheel expected;
  SourcePosition where;

  bool same_as(const ProfileUse& other) const {
    return file.file == other.file.file && file.options == other.file.options && body == other.body &&
           expected.flange_back == other.expected.flange_back &&
           expected.nominal_radius == other.expected.nominal_radius;
  }
};

void collect(const io::SurfaceSource& source, Body body, const io::ExpectedWheel& expected,
             std::vector<ProfileUse>& uses) {
  for (const io::SurfaceSource& part : source.parts) collect(part, body, expected, uses);
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (!source.parts.empty() || file == nullptr) return;
  if (is_offset_file(file->file) || io::is_mesh_file(file->file) || io::is_cad_file(file->file) ||
      io::is_slices_file(file->file) || io::is_spline_file(file->file))
    return;
  ProfileUse use{*file, body, expected, source.where};
  if (std::none_of(uses.begin(), uses.end(), [&](const ProfileUse& u) { return u.same_as(use); }))
    uses.push_back(std::move(use));
}

std::vector<CheckedProfile> checked_profiles(const io::CaseFile& file, Standards compare) {
  std::vector<ProfileUse> uses;
  for (const io::Case& c : file.cases) {
    const auto* input = std::get_if<io::WheelRailCase>(&c.content);
    if (input == nullptr) continue;
    collect(input->rail, Body::rail, {}, uses);
    collect(input->wheel, Body::wheel, {input->wheelset.flange_back_position, profile_radius(*input, Body::wheel)},
            uses);
  }
  std::vector<CheckedProfile> out;
  out.reserve(uses.size());
  for (const ProfileUse& use : uses)
    out.push_back(checked(io::read_sourced_profile(use.file.file, use.body, use.file.options, use.where), use.file.file,
                          use.expected, compare));
  return out;
}

}  // namespace

bool is_profile_file(const std::filesystem::path& file) {
  if (io::profile_body(file) || io::profile_format(file) != io::ProfileFormat::two_column) return true;
  const std::string extension = io::profiles::lower(file.extension().string());
  for (const char* known : {".csv", ".txt", ".dat", ".asc", ".rail"})
    if (extension == known) return true;
  return false;
}

CheckedProfile check_profile(const std::filesystem::path& file, std::optional<Body> body) {
  if (!body) body = io::profile_body(file);
  if (body) return checked(io::read_sourced_profile(file, *body, {}, {}), file, {}, Standards::yes);
  // as rails are half as wide as wheels, and few files can be read as both
  std::optional<io::SourcedProfile> rail, wheel;
  std::optional<Error> trouble;
  for (const Body b : {Body::rail, Body::wheel}) {
    try {
      (b == Body::rail ? rail : wheel) = io::read_sourced_profile(file, b, {}, {});
    } catch (const Error& error) {
      // a file that names its body tells more when it is read as that
      if (!trouble || trouble->message().find("profile is expected") != std::string::npos) trouble = error;
    }
  }
  if (!rail && !wheel) throw *trouble;
  constexpr double kWidestHead = 0.1;
  const std::vector<double>& y = (rail ? rail : wheel)->profile.y;
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  const bool is_wheel = !rail || (wheel && *high - *low > kWidestHead);
  CheckedProfile out = checked(is_wheel ? *wheel : *rail, file, {}, Standards::yes);
  out.judgement.notes.insert(
      out.judgement.notes.begin(),
      fmt::format("taken for a {} by its shape: say --body if it is none", is_wheel ? "wheel" : "rail"));
  return out;
}

std::optional<Body> body_by_shape(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!is_profile_file(file) || io::profile_body(file) || !std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    return check_profile(file, std::nullopt).body;
  } catch (const Error&) {  // told where it is read
    return std::nullopt;
  }
}

std::vector<CheckedProfile> check_profiles(const io::CaseFile& file) { return checked_profiles(file, Standards::yes); }

std::vector<std::string> profile_doubts(const io::CaseFile& file) {
  std::vector<std::string> doubts;
  for (const CheckedProfile& profile : checked_profiles(file, Standards::no)) {
    for (const io::ProfileRemark& remark : profile.judgement.remarks)
      doubts.push_back(fmt::format("{}: {}: {}", profile.name, remark.name, remark.text));
    for (const std::string& note : profile.judgement.notes) doubts.push_back(fmt::format("{}: {}", profile.name, note));
  }
  return doubts;
}

}  // namespace treadmark::app
