// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/surface_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/app/surfaces/section_bridges.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::app {
namespace {

constexpr double kAnyWheel = 0.46;   // nominal radius where none is said [m]
constexpr double kAxleAbove = 0.25;  // what lies farther from its origin is a wheel about its axle [m]

using Facts = std::vector<std::pair<std::string, std::string>>;

bool is_built(const std::filesystem::path& file) { return io::can_hold(file, ~(io::kProfileFile | io::kPointFile)); }

std::string range_text(double low, double high, const char* unit, double factor) {
  if (!std::isfinite(low) && !std::isfinite(high)) return "without ends";
  return fmt::format("{:.6g} .. {:.6g} {}", factor * low, factor * high, unit);
}

void say_kind(const io::SurfaceSource& source, const NaturalSurface& natural, Facts& facts) {
  const auto& given = std::get<io::GeometryFile>(source.geometry);
  const SurfaceSpec& spec = natural.spec;
  const std::string scaled =
      given.options.scale == 1.0 ? "mm" : fmt::format("{:g} mm by scale_to_mm", given.options.scale);
  std::string kind, unit = scaled;
  if (const auto* mesh = std::get_if<TriangleMesh>(&spec.shape); mesh != nullptr && io::is_mesh_file(given.file)) {
    kind = fmt::format("triangles: {} over {} vertices", mesh->triangles.size(), mesh->vertices.size());
    unit += ", as files of triangles say none";
  } else if (const auto* slices = std::get_if<SliceSet>(&spec.shape);
             slices != nullptr && !slices->u.empty() && io::is_slices_file(given.file)) {
    const bool wheel = spec.body == Body::wheel;
    const auto points = ranges::minmax(slices->profiles, {}, [](const Profile& p) { return p.y.size(); });
    kind = fmt::format("{} slices of {} to {} points, {}", slices->u.size(), points.min.y.size(), points.max.y.size(),
                       wheel ? range_text(slices->u.front(), slices->u.back(), "degrees", 180.0 / kPi)
                             : "x = " + range_text(slices->u.front(), slices->u.back(), "mm", kMilli));
  } else if (io::is_slices_file(given.file)) {
    const Box3 box = natural.surface->bounds();
    kind = fmt::format("slices, so many that they are read where they are asked for, x = {}",
                       range_text(box.min.x(), box.max.x(), "mm", kMilli));
  } else if (io::is_cad_file(given.file)) {
    kind = "CAD, taken as ";
    kind += std::holds_alternative<Profile>(spec.shape)         ? "one section"
            : std::holds_alternative<SliceSet>(spec.shape)      ? "slices"
            : std::holds_alternative<SplineSurface>(spec.shape) ? "one spline"
                                                                : "triangles";
    unit = "that of the file";
  } else if (is_offset_file(given.file)) {
    const offset::OffsetFile content = offset::read_vdb(given.file);
    const auto* standard = std::get_if<StandardProfile>(&content.base.shape);
    kind = fmt::format(
        "offsets ({}): {} voxels over {}", io::extension_of(given.file) == ".nvdb" ? "NanoVDB" : "OpenVDB",
        offset::active_count(*content.offsets), standard != nullptr ? standard->name : "a section of its own");
    unit = "m, as such files have it";
  } else {
    kind = fmt::format("splines (XML of G+Smo), backend {}", natural.surface->backend());
    unit += ", as such files say none";
  }
  facts.emplace_back("kind", kind);
  facts.emplace_back("unit", unit);
}

/// Heights of the section in the middle of what there is, at even steps across.
struct MiddleSection {
  double u = 0.0;  ///< [m] or [rad]
  std::vector<double> y, z;
};

MiddleSection middle_of(const NaturalSurface& natural) {
  constexpr int kPoints = 401;
  constexpr double kFarthest = 0.3;
  const Box3 box = natural.surface->bounds();
  const Body body = natural.spec.body;
  MiddleSection out;
  if (body == Body::rail)
    out.u = std::isfinite(box.min.x()) && std::isfinite(box.max.x()) ? 0.5 * (box.min.x() + box.max.x()) : 0.0;
  else if (box.min.z() > 0.0 || box.max.z() < 0.0 || box.min.x() > 0.0 || box.max.x() < 0.0)
    out.u = std::atan2(0.5 * (box.min.x() + box.max.x()), 0.5 * (box.min.z() + box.max.z()));
  const double low = std::max(box.min.y(), -kFarthest), high = std::min(box.max.y(), kFarthest);
  for (int i = 0; i < kPoints; ++i) out.y.push_back(low + (high - low) * i / (kPoints - 1));
  out.z.resize(out.y.size());
  section_heights(*natural.surface, body, out.u, out.y, {out.z, {}, {}});
  return out;
}

void say_section(const NaturalSurface& natural, CheckedProfile& out) {
  const bool wheel = natural.spec.body == Body::wheel;
  const MiddleSection section = middle_of(natural);
  const std::string place = wheel ? fmt::format("theta = {:.4g} degrees", section.u * 180.0 / kPi)
                                  : fmt::format("x = {:.6g} mm", kMilli * section.u);
  std::size_t top = section.z.size(), first = top, last = top;
  for (std::size_t i = 0; i < section.z.size(); ++i) {
    if (std::isnan(section.z[i])) continue;
    if (first == section.z.size()) first = i;
    last = i;
    if (top == section.z.size() || (wheel ? section.z[i] > section.z[top] : section.z[i] < section.z[top])) top = i;
  }
  if (top == section.z.size()) {
    out.judgement.remarks.push_back(
        {"upside_down", fmt::format("at {} nothing is seen from {}: x runs forward, y to the right, z down{}", place,
                                    wheel ? "below" : "above", wheel ? ", the axle is the y axis" : "")});
    return;
  }
  out.judgement.facts.emplace_back(wheel ? "largest radius" : "top",
                                   fmt::format("{} = {:.6g} mm at y = {:.5g} mm, {}", wheel ? "r" : "z",
                                               kMilli * section.z[top], kMilli * section.y[top], place));
  out.judgement.facts.emplace_back("seen across", range_text(section.y[first], section.y[last], "mm", kMilli));
  if (wheel) return;
  // a head is highest somewhere between its sides, which lie lower
  constexpr double kClearly = 1e-3;
  const double middle = section.z[(first + last) / 2];
  if (!std::isnan(middle) && middle - std::max(section.z[first], section.z[last]) > kClearly)
    out.judgement.remarks.push_back(
        {"upside_down", fmt::format("the middle of the section at {} lies {:.3g} mm below its sides: if z points up in "
                                    "the file, set shape.mirror_z = \"yes\"",
                                    place, kMilli * (middle - std::max(section.z[first], section.z[last])))});
}

CheckedProfile described(const io::SurfaceSource& source, const NaturalSurface& natural, bool judged) {
  const auto& file = std::get<io::GeometryFile>(source.geometry).file;
  const Body body = natural.spec.body;
  CheckedProfile out;
  out.name = fmt::format("{} surface {}", body_name(body), file.string());
  Facts& facts = out.judgement.facts;
  say_kind(source, natural, facts);
  facts.emplace_back("body",
                     fmt::format("{}{}", body_name(body), judged ? ", by its place: say --body if it is none" : ""));
  const Box3 box = natural.surface->bounds();
  facts.emplace_back("x", range_text(box.min.x(), box.max.x(), "mm", kMilli));
  facts.emplace_back("y", range_text(box.min.y(), box.max.y(), "mm", kMilli));
  facts.emplace_back("z", range_text(box.min.z(), box.max.z(), "mm", kMilli));
  say_section(natural, out);
  constexpr double kLeast = 5e-3, kMost = 20.0;
  const double size = box.max.y() - box.min.y();
  if (size < kLeast || size > kMost)
    out.judgement.remarks.push_back(
        {"unit", fmt::format("{:.4g} mm across is no wheel or rail: is the file in mm? shape.scale_to_mm leads to it",
                             kMilli * size)});
  if (!natural.note.empty()) out.judgement.notes.push_back(natural.note);
  for (const SurfaceDoubt& doubt : natural.spec.doubts) out.judgement.remarks.push_back({doubt.name, doubt.text});
  if (const auto* slices = std::get_if<SliceSet>(&natural.spec.shape)) {
    if (auto remark = remark_on_slices(*slices, natural.spec.body, {{}, {}, false, {}}))
      out.judgement.remarks.push_back(*std::move(remark));
    for (const SectionBridge& bridge : section_bridges(*slices)) out.judgement.notes.push_back(to_text(bridge));
  }
  return out;
}

NaturalSurface read_as(const io::SurfaceSource& source, Body body) {
  return read_surface(source, body, body == Body::wheel ? kAnyWheel : 0.0);
}

std::optional<Body> body_said(const std::filesystem::path& file) {
  if (io::is_slices_file(file)) return io::body_by_extension(file);
  if (is_offset_file(file)) return offset::read_vdb(file).base.body;
  return std::nullopt;
}

}  // namespace

bool is_surface_file(const std::filesystem::path& file) { return is_built(file) || is_cloud_file(file); }

CheckedProfile check_surface(const std::filesystem::path& file, std::optional<Body> body) {
  if (!is_built(file)) return check_cloud(file);
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{file, {}};
  source.where = {file.string(), 0, 0};
  if (is_offset_file(file)) {
    const NaturalSurface natural = read_offset_surface(file);
    if (body && *body != natural.spec.body)
      throw Error(ErrorKind::configuration, "the offsets belong to the other body", {file.string()},
                  "leave out --body");
    return described(source, natural, false);
  }
  if (!body) body = body_said(file);
  if (body) return described(source, read_as(source, *body), false);
  // a rail lies near its origin, a wheel round it
  std::optional<Error> trouble;
  try {
    const NaturalSurface rail = read_as(source, Body::rail);
    const Box3 box = rail.surface->bounds();
    if (std::max(std::fabs(box.min.z()), std::fabs(box.max.z())) < kAxleAbove) return described(source, rail, true);
  } catch (const MissingFile&) {
    throw;
  } catch (const Error& error) {
    if (io::is_mesh_file(file) && is_cloud_file(file) && error.message().find("triangles") != std::string::npos)
      return check_cloud(file);
    trouble = error;
  }
  try {
    return described(source, read_as(source, Body::wheel), true);
  } catch (const Error&) {
    if (trouble) throw *trouble;
    throw;
  }
}

namespace {

void check_source(const io::SurfaceSource& source, Body body, double radius, std::vector<CheckedProfile>& out) {
  for (const io::SurfaceSource& part : source.parts) check_source(part, body, radius, out);
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (!source.parts.empty() || file == nullptr || !is_built(file->file)) return;
  io::SurfaceSource alone = source;  // without what is put on top
  alone.defects = {};
  alone.offsets = {};
  CheckedProfile found = described(alone, read_surface(alone, body, radius), false);
  const auto same = [&](const CheckedProfile& other) {
    return other.name == found.name && other.judgement.facts == found.judgement.facts;
  };
  if (ranges::none_of(out, same)) out.push_back(std::move(found));
}

}  // namespace

std::vector<CheckedProfile> check_surfaces(const io::CaseFile& file) {
  std::vector<CheckedProfile> out;
  for (const io::Case& c : file.cases)
    if (const auto* input = std::get_if<io::WheelRailCase>(&c.content)) {
      check_source(input->rail, Body::rail, profile_radius(*input, Body::rail), out);
      check_source(input->wheel, Body::wheel, profile_radius(*input, Body::wheel), out);
    }
  return out;
}

}  // namespace treadmark::app
