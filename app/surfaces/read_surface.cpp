// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/read_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/offset_table.hpp"
#include "treadmark/app/surfaces/section_bridges.hpp"
#include "treadmark/backends/added_offsets.hpp"
#include "treadmark/backends/assembly/stretched_rail.hpp"
#include "treadmark/backends/levelset/read_level_set.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/backends/spline/spline_gaps.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/io/cases/shape_keys.hpp"
#include "treadmark/io/files/foreign_kind.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/files/surface_errors.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/slice_file.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {

bool is_offset_file(const std::filesystem::path& file) { return io::can_hold(file, io::kOffsetFile); }

bool has_own_radius(const io::SurfaceSource& wheel) {
  if (!wheel.parts.empty()) return ranges::any_of(wheel.parts, has_own_radius);
  const auto* file = std::get_if<io::GeometryFile>(&wheel.geometry);
  if (file == nullptr) return std::holds_alternative<io::SolidsInput>(wheel.geometry);
  return io::can_hold(file->file, io::kTriangleFile | io::kSplineFile | io::kCadFile | io::kOffsetFile);
}

namespace {

NaturalSurface read_offsets(const io::GeometryFile& file, const io::SurfaceSource& source, Body body,
                            double nominal_radius) {
  NaturalSurface natural = read_offset_surface(file.file);
  if (body == Body::rail && nominal_radius != 0.0)
    throw Error(ErrorKind::configuration, "a file of offsets cannot become a roller", {file.file.string()},
                "use a profile, slices or triangles");
  if (natural.spec.body != body)
    throw Error(ErrorKind::configuration,
                fmt::format("the offsets belong to a {}", body == Body::rail ? "wheel" : "rail"), {file.file.string()});
  constexpr double kSameRadius = 1e-9;
  if (body == Body::wheel && std::fabs(natural.spec.nominal_radius - nominal_radius) > kSameRadius)
    throw Error(ErrorKind::configuration,
                fmt::format("the offsets were made for a nominal wheel radius of {:.6g} mm, the case has {:.6g} mm",
                            1e3 * natural.spec.nominal_radius, 1e3 * nominal_radius),
                {file.file.string()}, "set wheelset.nominal_radius_mm to the file's radius");
  if (!source.defects.empty())
    throw Error(ErrorKind::configuration, "defects cannot be added to a file of offsets", source.where,
                "add them before the offsets are written");
  return natural;
}

bool is_crossing(std::string_view key) { return key.starts_with("crossing"); }

/// What a shape is given by, and the keys of [rail.shape] and [wheel.shape] beside it that act on such.
struct ShapeKind {
  const char* name;
  bool (*takes)(std::string_view key);
  const char* advice;
};
constexpr ShapeKind kOffsets{"a file of offsets", [](std::string_view) { return false; },
                             "offsets are in metres over a base of their own: change what they are written from"};
constexpr ShapeKind kSplines{"a file of splines", [](std::string_view key) { return key == "scale_to_mm"; },
                             "of the keys beside shape.file only scale_to_mm belongs to it"};
constexpr ShapeKind kTriangles{
    "a file of triangles",
    [](std::string_view key) { return key == "mirror_y" || key == "mirror_z" || key == "scale_to_mm"; },
    "triangles are mirrored and scaled, no more; measured points are smoothed by treadmark import"};
constexpr ShapeKind kCad{"a file of CAD", is_crossing,
                         "CAD files have units of their own, axes and exact shapes: change them there, or convert them "
                         "to triangles, which are mirrored and scaled"};
constexpr ShapeKind kSlices{"a file of slices",
                            [](std::string_view key) { return !is_crossing(key) && key != "placement"; },
                            "only one section can move along the track, and slices lie as they are in their file"};
constexpr ShapeKind kProfileShape{"a profile", [](std::string_view key) { return key != "open_seam"; },
                                  "it belongs to slices all round a wheel (.slcw)"};
constexpr ShapeKind kSolids{"a shape of solids", [](std::string_view key) { return key == "voxel_mm"; },
                            "scale and place each body in its own table"};
constexpr ShapeKind kFormula{"a shape without a file",
                             [](std::string_view key) { return is_crossing(key) || key.starts_with("start_"); },
                             "they belong to a shape given by a file"};

constexpr ShapeKind kParts{"a rail made of parts", [](std::string_view) { return false; }, "give them in the parts"};

ShapeKind kind_of(const io::SurfaceSource& source) {
  if (!source.parts.empty()) return kParts;
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (std::holds_alternative<io::SolidsInput>(source.geometry)) return kSolids;
  if (file == nullptr) return kFormula;
  if (is_offset_file(file->file)) return kOffsets;
  if (io::is_spline_file(file->file)) return kSplines;
  if (io::is_mesh_file(file->file)) return kTriangles;
  if (io::is_cad_file(file->file)) return kCad;
  return io::is_slices_file(file->file) ? kSlices : kProfileShape;
}

/// A key that would do nothing is an error.
void refuse_idle_keys(const io::SurfaceSource& source, Body body) {
  const ShapeKind kind = kind_of(source);
  const bool moves = source.crossing.part != io::CrossingInput::Part::none;
  std::vector<std::string> idle;
  for (const std::string& key : io::given_shape_keys(source, body)) {
    if (kind.takes(key) && is_crossing(key) && !moves)
      throw Error(ErrorKind::configuration, key + " does nothing: the section does not move along the track",
                  source.where, "say crossing = \"nose\" or \"wing\", or leave it out");
    if (!kind.takes(key)) idle.push_back(key);
  }
  if (!idle.empty())
    throw Error(
        ErrorKind::configuration,
        fmt::format("{} {} not belong to {}", fmt::join(idle, ", "), idle.size() == 1 ? "does" : "do", kind.name),
        source.where, kind.advice);
}

/// As the keys mirror_y and mirror_z say; the outside stays outside.
TriangleMesh mirrored_mesh(TriangleMesh mesh, const io::ProfileOptions& how) {
  const bool y = how.mirror_y == 1, z = how.mirror_z == 1;
  for (Vec3& v : mesh.vertices) v = {v.x(), y ? -v.y() : v.y(), z ? -v.z() : v.z()};
  if (y != z)
    for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  return mesh;
}

SliceSet slices_of(const io::GeometryFile& file, Body body, const SourcePosition& where) {
  SliceSet slices = io::read_slices(file.file, body, file.options, where);
  slices.open_seam = file.open_seam;
  return slices;
}

/// As the keys of the shape change the surface.
std::shared_ptr<const SurfaceErrors> errors_of(const io::GeometryFile& file, Body body) {
  const io::ProfileOptions& how = file.options;
  const auto errors = io::read_surface_errors(file.file);
  if (!errors || (how.scale == 1.0 && how.mirror_y != 1 && how.mirror_z != 1)) return errors;
  const Stations stations = io::is_slices_file(file.file) ? Stations::kept
                            : body == Body::rail          ? Stations::along
                                                          : Stations::round;
  return std::make_shared<const SurfaceErrors>(
      changed(*errors, how.scale, how.mirror_y == 1, how.mirror_z == 1, stations));
}

decltype(SurfaceSpec::shape) shape_of_cad(const io::GeometryFile& file, Body body, double radius,
                                          const SourcePosition& where, std::string& note) {
  if (body == Body::rail && radius != 0.0)
    throw Error(ErrorKind::configuration, "a file of CAD cannot become a roller", where, "use a profile or slices");
  io::CadSurface cad = io::read_cad(file.file, body, radius, where);
  note = std::move(cad.note);
  return std::visit([](auto& shape) -> decltype(SurfaceSpec::shape) { return std::move(shape); }, cad.shape);
}

/// note: what was done to its points.
Profile placed_profile(const io::GeometryFile& file, Body body, const SourcePosition& where, std::string& note) {
  io::SourcedProfile read = io::read_sourced_profile(file.file, body, file.options, where);
  for (const std::string& done : read.source.understood.notes) note += (note.empty() ? "" : "; ") + done;
  return std::move(read.profile);
}

/// One surface, or a body of several.
NaturalSurface read_spline_file(const io::GeometryFile& file, const io::SurfaceSource& source, Body body,
                                double radius) {
  io::SplineFile read = io::read_splines(file.file, file.options.scale, source.where);
  if (read.surfaces.size() > 1 && !source.defects.empty())
    throw Error(ErrorKind::configuration, "defects cannot be added to a body of several parts", source.where);
  const std::string gaps = spline::spline_gaps(read.surfaces, read.interfaces);
  std::vector<SurfacePart> parts;
  parts.reserve(read.surfaces.size());
  for (SplineSurface& splines : read.surfaces) {
    SurfaceSpec spec;
    spec.body = body;
    (body == Body::wheel ? spec.nominal_radius : spec.roller_radius) = radius;
    spec.defects = source.defects;
    spec.shape = std::move(splines);
    SurfacePart part;
    part.natural = std::make_shared<const NaturalSurface>(create_natural(std::move(spec)));
    parts.push_back(std::move(part));
  }
  NaturalSurface out = parts.size() == 1 ? *parts.front().natural : join_surfaces(std::move(parts));
  if (body == Body::wheel) {
    const double reach = std::max(-out.surface->bounds().min.z(), out.surface->bounds().max.z());
    constexpr double kLeast = 0.5, kMost = 1.5;
    if (!(reach > kLeast * radius && reach < kMost * radius))
      throw Error(ErrorKind::input_data,
                  fmt::format("the surface reaches out to {:.6g} mm, the nominal radius is {:.6g} mm", 1e3 * reach,
                              1e3 * radius),
                  {file.file.string()}, "is the axle the y axis, the running surface below it, and scale_to_mm right?");
  }
  out.note += gaps;
  return out;
}

SolidShape read_solids(const io::SolidsInput& given, const SourcePosition& where) {
  SolidShape shape;
  shape.voxel = given.voxel;
  for (const io::SolidInput& one : given.solids) {
    Solid& solid = shape.solids.emplace_back();
    solid.use = one.use;
    solid.offset = one.offset;
    if (io::is_mesh_file(one.file))
      solid.shape = io::read_mesh(one.file, one.scale, where);
    else if (is_offset_file(one.file))
      solid.shape = levelset::read_level_set(one.file, one.scale * kMillimetre, one.grid);
    else
      throw Error(ErrorKind::configuration, fmt::format("'{}' is no body", one.file.string()), where,
                  "give closed triangles (.ply, .stl, .obj or .off) or a level set (.vdb)");
  }
  return shape;
}

NaturalSurface read_parts(const io::SurfaceSource& source, Body body, double radius) {
  if (!source.defects.empty())
    throw Error(ErrorKind::configuration, "defects cannot be added to a body of several parts", source.where);
  std::vector<SurfacePart> parts;
  for (const io::SurfaceSource& part : source.parts) {
    if (part.resolution > 0.0 && part.backend.empty() && source.backend.empty()) refuse_idle_resolution(part.where);
    parts.push_back({std::make_shared<const NaturalSurface>(read_surface(part, body, radius)), part.offset,
                     part.backend, part.resolution});
  }
  return join_surfaces(std::move(parts));
}

}  // namespace

MovingSection motion_of(const io::CrossingInput& c) {
  MovingSection m;
  m.x = c.x, m.y = c.y, m.z = c.z;
  m.rounding = c.rounding;
  const bool nose = c.part == io::CrossingInput::Part::nose;
  m.slope_z_before = nose ? -c.slope : 0.0;
  m.slope_y_after = nose ? 0.0 : c.slope;
  m.length_before = nose ? c.length : c.rounding;
  m.length_after = nose ? c.rounding : c.length;
  return m;
}

namespace {

/// Of files: standard profiles and arcs are what they are.
void refuse_narrow(const NaturalSurface& natural, const io::SurfaceSource& source) {
  constexpr double kNarrowestWheel = 10e-3, kNarrowestRail = 5e-3;  // [m]
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (file == nullptr) return;
  const Box3 box = natural.surface->bounds();
  const double width = box.max.y() - box.min.y();
  const bool wheel = natural.spec.body == Body::wheel;
  if (!(width < (wheel ? kNarrowestWheel : kNarrowestRail))) return;
  throw Error(ErrorKind::input_data,
              fmt::format("the {} of {} is {:.3g} mm wide, and none is", body_name(natural.spec.body),
                          file->file.string(), kMilli * width),
              source.where, "is the file in inches or cm? the factor to mm is then 25.4 or 10 (scale_to_mm, --scale)");
}

/// What is found by one look at all slices of a long rail.
struct LongRail {
  assembly::RailStretches stretches;
  int across = 0;  ///< as SliceSet's
  std::vector<SurfaceDoubt> doubts;
};
constexpr std::size_t kOfStretch = 400,  // slices
    kAboutStretch = 16;                  // to both sides, as the influence of a slice falls by 3.7 per slice

/// Slices of a stretch and those beside it.
SliceSet slices_about(const io::SliceFile& slices, std::size_t number, const std::vector<double>& u) {
  const std::size_t from = number * kOfStretch, to = u.size() - from < 2 * kOfStretch ? u.size() : from + kOfStretch;
  return slices.read(from - std::min(from, kAboutStretch), std::min(u.size(), to + 1 + kAboutStretch));
}

LongRail look_at_slices(const io::SliceFile& slices, const std::vector<double>& u) {
  constexpr double kBetweenPoints = 1e-3;  // no spline swings farther beyond its points, 0.5 mm apart [m]
  constexpr double kApart = 0.5e-3;        // of lateral places [m]
  constexpr std::size_t kMostDoubts = 3;
  LongRail out;
  assembly::RailStretches& s = out.stretches;
  s.backend = "spline";
  s.y_min = s.z_min = kInfinity, s.y_max = s.z_max = -kInfinity;
  double longest = 0.0;
  for (std::size_t number = 0; (number + 1) * kOfStretch <= u.size(); ++number) {
    check_cancelled();
    s.ends.push_back(u[number * kOfStretch]);
    const SliceSet here = slices_about(slices, number, u);
    for (const Profile& profile : here.profiles) {
      const auto [y_min, y_max] = std::minmax_element(profile.y.begin(), profile.y.end());
      const auto [z_min, z_max] = std::minmax_element(profile.z.begin(), profile.z.end());
      s.y_min = std::min(s.y_min, *y_min - kBetweenPoints), s.y_max = std::max(s.y_max, *y_max + kBetweenPoints);
      s.z_min = std::min(s.z_min, *z_min - kBetweenPoints), s.z_max = std::max(s.z_max, *z_max + kBetweenPoints);
      double length = 0.0;
      for (std::size_t k = 1; k < profile.y.size(); ++k)
        length += std::hypot(profile.y[k] - profile.y[k - 1], profile.z[k] - profile.z[k - 1]);
      longest = std::max(longest, length);
    }
    const std::size_t first = number * kOfStretch, before = first - std::min(first, kAboutStretch);
    for (SectionBridge bridge : section_bridges(here)) {
      bridge.first += before;
      if (bridge.first >= first && bridge.first < first + kOfStretch && out.doubts.size() < kMostDoubts)
        out.doubts.push_back({"between_sections", to_text(bridge)});
    }
  }
  s.ends.push_back(u.back());
  out.across = 2 + to_whole<int>(longest / kApart);
  return out;
}

/// A rail of so many slices that only those about the places that are asked for are in the memory; it ends with them.
/// Nothing where it is none, or where something is to be done to all of it.
std::optional<NaturalSurface> read_long_rail(const io::SurfaceSource& source, Body body, double radius) {
  constexpr std::uintmax_t kLongList = 100'000;  // bytes of lists that may have so many
  constexpr std::size_t kMostAtOnce = 4000;
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  std::error_code missing;
  if (file == nullptr || body != Body::rail || radius != 0.0 || !source.defects.empty() ||
      !source.offsets.file.empty() || source.crossing.part != io::CrossingInput::Part::none ||
      !io::is_slices_file(file->file) || !(std::filesystem::file_size(file->file, missing) > kLongList) || missing)
    return std::nullopt;
  auto slices = std::make_shared<io::SliceFile>(file->file, file->options, source.where);
  std::vector<double> u = slices->u();
  if (u.size() <= kMostAtOnce || slices->has_features()) return std::nullopt;
  slices->check();
  LongRail rail = look_at_slices(*slices, u);
  rail.stretches.open = [slices, u = std::move(u), across = rail.across](std::size_t number) {
    SliceSet here = slices_about(*slices, number, u);
    here.across = across;
    SurfaceSpec spec;
    spec.body = Body::rail;
    spec.shape = std::move(here);
    return create_natural(std::move(spec)).surface;
  };
  NaturalSurface out;
  out.spec.body = Body::rail;
  out.spec.shape = SliceSet{};  // too many: resampled from the surface
  out.spec.errors = errors_of(*file, body);
  out.spec.doubts = io::read_surface_doubts(file->file);
  out.spec.doubts.insert(out.spec.doubts.end(), rail.doubts.begin(), rail.doubts.end());
  out.surface = assembly::join_stretches(std::move(rail.stretches));
  return out;
}

NaturalSurface read_shape(const io::SurfaceSource& source, Body body, double radius) {
  refuse_idle_keys(source, body);
  if (!source.parts.empty()) return read_parts(source, body, radius);
  if (std::optional<NaturalSurface> rail = read_long_rail(source, body, radius)) {
    refuse_narrow(*rail, source);
    return std::move(*rail);
  }
  SurfaceSpec spec;
  spec.body = body;
  (body == Body::wheel ? spec.nominal_radius : spec.roller_radius) = radius;
  spec.defects = source.defects;
  std::string note;
  if (const auto* file = std::get_if<io::GeometryFile>(&source.geometry)) {
    io::refuse_foreign_file(file->file, source.where);
    if (is_offset_file(file->file)) return read_offsets(*file, source, body, radius);
    if (io::is_spline_file(file->file)) return read_spline_file(*file, source, body, radius);
    if (io::is_mesh_file(file->file))
      spec.shape = mirrored_mesh(io::read_mesh(file->file, file->options.scale, source.where), file->options);
    else if (io::is_cad_file(file->file))
      spec.shape = shape_of_cad(*file, body, radius, source.where, note);
    else if (io::is_slices_file(file->file))
      spec.shape = slices_of(*file, body, source.where);
    else
      spec.shape = placed_profile(*file, body, source.where, note);
    spec.errors = errors_of(*file, body);
    spec.doubts = io::read_surface_doubts(file->file);
  } else if (const auto* standard = std::get_if<StandardProfile>(&source.geometry)) {
    if (!library_body(standard->name)) {
      const std::string near = nearest_library_name(standard->name);
      throw Error(ErrorKind::configuration, fmt::format("there is no standard profile '{}'", standard->name),
                  source.where,
                  near.empty() ? "treadmark list profiles prints those there are"
                               : fmt::format("did you mean '{}'? treadmark list profiles prints all", near));
    }
    spec.shape = *standard;
  } else if (const auto* solids = std::get_if<io::SolidsInput>(&source.geometry)) {
    spec.shape = read_solids(*solids, source.where);
  } else {
    spec.shape = std::get<ArcChain>(source.geometry);
  }
  if (source.crossing.part != io::CrossingInput::Part::none)
    spec.shape = move_section(spec, motion_of(source.crossing));
  NaturalSurface natural = create_natural(std::move(spec));
  refuse_narrow(natural, source);
  natural.note += note;
  return natural;
}

}  // namespace

std::optional<std::pair<double, double>> measured_range(const NaturalSurface& surface,
                                                        const io::SurfaceSource& source) {
  const auto* slices = std::get_if<SliceSet>(&surface.spec.shape);
  if (slices == nullptr || slices->u.size() < 2 || source.crossing.part != io::CrossingInput::Part::none)
    return std::nullopt;
  const std::vector<double>& u = slices->u;
  if (surface.spec.body == Body::wheel) {
    constexpr double kWidestGap = 1.5;  // of the steps between slices: closed beyond the last one
    double widest = 0.0;
    for (std::size_t i = 1; i < u.size(); ++i) widest = std::max(widest, u[i] - u[i - 1]);
    if (2.0 * kPi - (u.back() - u.front()) <= kWidestGap * widest) return std::nullopt;
  }
  return std::pair{u.front(), u.back()};
}

NaturalSurface read_surface(const io::SurfaceSource& source, Body body, double radius) {
  NaturalSurface shape = read_shape(source, body, radius);
  if (source.offsets.file.empty()) return shape;
  if (body == Body::rail && radius != 0.0)
    throw Error(ErrorKind::configuration, "a table of deviations cannot be added to a roller", source.offsets.where,
                "use a profile, slices or triangles that have them");
  return add_offsets(shape, read_offset_table(source.offsets, shape));
}

}  // namespace treadmark::app
