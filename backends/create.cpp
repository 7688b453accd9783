// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/create.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "treadmark/backends/analytic/defects.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/assembly/outermost_surface.hpp"
#include "treadmark/backends/composed.hpp"
#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/sampling/convert_points.hpp"
#include "treadmark/backends/sampling/difference.hpp"
#include "treadmark/backends/sampling/sample_points.hpp"
#include "treadmark/backends/sampling/touchable_slices.hpp"
#include "treadmark/backends/spline/make.hpp"
#include "treadmark/backends/spline/slice_kinks.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

using Clock = std::chrono::steady_clock;

std::string_view word(Body body) { return body == Body::wheel ? "wheel" : "rail"; }

bool is_formula(const SurfaceSpec& spec) {
  return std::holds_alternative<StandardProfile>(spec.shape) || std::holds_alternative<ArcChain>(spec.shape);
}

void require_same_body(Body shape, Body wanted, std::string_view what) {
  if (shape != wanted)
    throw Error(ErrorKind::configuration,
                fmt::format("{} belongs to a {}, not to a {}", what, word(shape), word(wanted)));
}

void check(const SurfaceSpec& spec) {
  if (spec.body == Body::wheel && !(spec.nominal_radius > 0.0))
    throw Error(ErrorKind::configuration, "a wheel needs a positive nominal radius");
  if (spec.body == Body::wheel && spec.roller_radius != 0.0)
    throw Error(ErrorKind::configuration, "a roller takes the place of a rail, a wheel cannot be one");
  if (spec.body == Body::rail && spec.defects.on_wheel())
    throw Error(ErrorKind::configuration, "flats and polygonizations belong to wheels, not to rails");
  if (spec.body == Body::wheel && spec.defects.on_rail())
    throw Error(ErrorKind::configuration, "squats, corrugations and other rail defects belong to rails, not to wheels");
  if (const auto* points = std::get_if<Profile>(&spec.shape))
    require_same_body(points->body, spec.body, fmt::format("the profile '{}'", points->name));
  if (const auto* slices = std::get_if<SliceSet>(&spec.shape))
    require_same_body(slices->body, spec.body, fmt::format("the slices '{}'", slices->name));
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape))
    require_same_body(analytic::standard_profile_body(standard->name), spec.body,
                      fmt::format("the standard profile {}", standard->name));
}

/// Flats on a wheel given by a formula have a faster surface of their own.
bool flats_only(const SurfaceSpec& spec) {
  return spec.body == Body::wheel && is_formula(spec) && spec.defects.polygonizations.empty();
}

std::string words(const mesh::MeshRepair& repair) {
  std::string text;
  const auto add = [&](std::size_t n, std::string_view what) {
    if (n > 0) text += fmt::format("{}{} {}", text.empty() ? "repaired the mesh: " : ", ", n, what);
  };
  add(repair.merged_vertices, "coincident vertices merged");
  add(repair.degenerate, "triangles without area removed");
  add(repair.duplicates, "duplicate triangles removed");
  add(repair.flipped, "flipped triangles turned");
  if (repair.turned_inside_out) text += text.empty() ? "repaired the mesh: turned inside out" : ", turned inside out";
  return text.empty() ? text : text + ". ";
}

std::shared_ptr<const Surface> slice_surface(const SliceSet& slices, double nominal_radius) {
  if (slices.kinks.empty()) return spline::make_slice_surface(slices, nominal_radius);
  std::vector<std::shared_ptr<const Surface>> parts;
  for (const SliceSet& part : spline::split_at_kinks(slices))
    parts.push_back(spline::make_slice_surface(part, nominal_radius));
  return assembly::outermost_of(std::move(parts));
}

std::shared_ptr<const Surface> undamaged(const SurfaceSpec& spec, const std::vector<WheelFlat>& flats,
                                         std::string* note = nullptr) {
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape))
    return analytic::make_standard_surface(*standard, spec.body, spec.nominal_radius, flats);
  if (const auto* chain = std::get_if<ArcChain>(&spec.shape))
    return spec.body == Body::wheel ? analytic::make_revolved_surface(*chain, spec.nominal_radius, flats)
                                    : analytic::make_prismatic_surface(*chain);
  if (const auto* slices = std::get_if<SliceSet>(&spec.shape)) return slice_surface(*slices, spec.nominal_radius);
  if (const auto* points = std::get_if<Profile>(&spec.shape))
    return spline::make_profile_surface(*points, spec.nominal_radius);
  mesh::MeshRepair repair;
  auto surface = mesh::make_mesh_surface(std::get<TriangleMesh>(spec.shape), spec.body, {}, &repair);
  if (note != nullptr) *note = words(repair);
  return surface;
}

std::shared_ptr<const Surface> make_natural(const SurfaceSpec& spec, std::string& note) {
  if (flats_only(spec)) return undamaged(spec, spec.defects.flats);
  return analytic::add_defects(undamaged(spec, {}, &note), spec.defects, spec.body, spec.nominal_radius);
}

/// One re-representation: the natural surface, what is wanted of it, and the samplings that the backends share.
class Resampling {
 public:
  Resampling(const NaturalSurface& natural, const Representation& wanted)
      : natural_(natural),
        spec_(natural.spec),
        region_(wanted.region),
        resolution_(wanted.resolution > 0.0 ? wanted.resolution : kDefaultResolution),
        asked_(wanted.resolution > 0.0) {
    if (!(wanted.resolution >= 0.0) || !std::isfinite(wanted.resolution))
      throw Error(ErrorKind::configuration, "the resolution of a surface must be positive");
  }

  Sampled sampled() const { return {resolution_, region_, note_}; }

  std::shared_ptr<const Surface> as_spline() {
    if (spec_.defects.empty() || flats_only(spec_)) {
      // formulas are sampled at their own joints
      const double step = asked_ ? resolution_ : kResampleStep;
      const auto* chain = std::get_if<ArcChain>(&spec_.shape);
      const auto* standard = std::get_if<StandardProfile>(&spec_.shape);
      if (chain != nullptr || standard != nullptr) {
        const Profile profile = chain != nullptr ? analytic::sample_profile(*chain, spec_.body, step)
                                                 : analytic::sample_profile(*standard, step);
        resolution_ = step;
        if (spec_.defects.empty()) return spline::make_profile_surface(profile, spec_.nominal_radius);
        return spline::make_slice_surface(
            analytic::sample_wheel(profile, spec_.nominal_radius, spec_.defects.flats, step), spec_.nominal_radius);
      }
    }
    if (natural_.constant_profile()) return spline::make_profile_surface(section(), spec_.nominal_radius);
    return spline::make_slice_surface(slices(), spec_.nominal_radius);
  }

  std::shared_ptr<const Surface> as_nurbs() {
    const auto* chain = std::get_if<ArcChain>(&spec_.shape);
    const auto* standard = std::get_if<StandardProfile>(&spec_.shape);
    if (spec_.defects.empty() && !asked_ && (chain != nullptr || (standard != nullptr && standard->name == "60E1"))) {
      resolution_ = 0.0;
      limit_rail();
      return spline::make_nurbs_surface(chain != nullptr ? *chain : analytic::rail_60e1_chain(), spec_.body,
                                        spec_.nominal_radius, region_.u_min, region_.u_max);
    }
    return spline::make_nurbs_surface(points(true));
  }

  std::shared_ptr<const Surface> as_mesh(mesh::Refinement refinement, std::string backend) {
    mesh::MeshOptions options;
    options.refinement = refinement;
    options.backend = std::move(backend);
    mesh::MeshRepair repair;
    auto surface = mesh::make_mesh_surface(triangles(), spec_.body, options, &repair);
    note_ += words(repair);
    return surface;
  }

  TriangleMesh triangles() {
    const auto* given = std::get_if<TriangleMesh>(&spec_.shape);
    if (given != nullptr && !asked_ && spec_.defects.empty()) {
      resolution_ = 0.0;
      return *given;
    }
    return sampling::to_mesh(points(false, true), "samples of the " + std::string(word(spec_.body)));
  }

  SliceSet slices() {
    return sampling::to_slices(points(false), spec_.nominal_radius, "samples of the " + std::string(word(spec_.body)));
  }

  /// Offsets and the undamaged surface below them; base_spec is that surface's description.
  offset::OffsetSample offsets(std::shared_ptr<const Surface>& base, SurfaceSpec& base_spec,
                               const SurfaceSpec* given = nullptr) {
    const bool known = is_formula(spec_) || std::holds_alternative<Profile>(spec_.shape);
    base_spec.body = spec_.body;
    base_spec.nominal_radius = spec_.nominal_radius;
    if (given != nullptr) {
      base_spec = *given;
      limit_rail();
    } else if (known) {
      base_spec.shape = spec_.shape;
    } else {
      limit_rail();
      sampling::SampleSettings s{resolution_, 0.0, region_};
      constexpr double kStations = 200.0;
      const double length = region_.u_max - region_.u_min;
      const double whole = spec_.body == Body::wheel ? 2.0 * 3.141592653589793 * spec_.nominal_radius : length;
      const double along =
          spec_.body == Body::wheel && length < 7.0 ? length * spec_.nominal_radius : std::min(whole, length);
      s.spacing_u = std::max(resolution_, (std::isfinite(along) ? along : whole) / kStations);
      base_spec.shape = sampling::median_section(
          kept(sampling::sample_points(*natural_.surface, spec_.body, spec_.nominal_radius, s)), spec_.nominal_radius,
          "median section");
    }
    base = undamaged(base_spec, {});
    limit_rail();
    Rectangle region{region_.u_min, region_.u_max, region_.y_min, region_.y_max};
    if (known && given == nullptr) narrow(region);
    return offsets_over(*base, region);
  }

  std::shared_ptr<const Surface> as_offset(offset::Interpolation interpolation, std::string backend) {
    std::shared_ptr<const Surface> base;
    SurfaceSpec base_spec;
    offset::OffsetSample sample;
    const std::string note = note_;
    try {
      sample = offsets(base, base_spec);
    } catch (const Error& one_section) {
      if (spec_.body != Body::rail || one_section.kind() != ErrorKind::input_data) throw;
      note_ = note;
      // one section lies not below all of the rail: let the base follow it
      try {
        base = following_base();
        sample = offsets_over(*base, {region_.u_min, region_.u_max, region_.y_min, region_.y_max});
      } catch (const Error&) {
        throw one_section;
      }
    }
    return offset::make_offset_surface(std::move(base), sample.offsets, interpolation, std::move(backend));
  }

 private:
  /// An offset that ends makes splines ring for some voxels: let it end outside.
  double beyond() const {
    constexpr double kBeyond = 8.0;
    return kBeyond * resolution_ / (spec_.body == Body::wheel ? spec_.nominal_radius : 1.0);
  }

  offset::OffsetSample offsets_over(const Surface& base, const Rectangle& region) {
    offset::OffsetSettings settings;
    settings.du = settings.dy = resolution_;
    settings.region_uy = region;
    settings.region_uy.x_min -= beyond();
    settings.region_uy.x_max += beyond();
    auto sample = offset::sample_offsets(*natural_.surface, base, spec_.body, spec_.nominal_radius, settings);
    constexpr double kMostContinued = 0.02;
    if (sample.gaps > 0)
      throw Error(ErrorKind::input_data,
                  fmt::format("offsets cannot represent this {}: it has no surface at {} sections between others",
                              word(spec_.body), sample.gaps),
                  {}, "use the backend 'mesh' for surfaces with gaps");
    if (static_cast<double>(sample.continued) > kMostContinued * static_cast<double>(sample.nodes))
      throw Error(ErrorKind::input_data,
                  fmt::format("offsets cannot represent this {}: {} of {} nodes over the base have no surface",
                              word(spec_.body), sample.continued, sample.nodes),
                  {}, "use the backend 'mesh' or 'spline' for surfaces with gaps");
    if (sample.continued > 0)
      note_ += fmt::format("{} nodes at the ends of the profile continue their neighbours. ", sample.continued);
    note_ += fmt::format("{} active voxels, {:.3g} MB. ", sample.active,
                         1e-6 * static_cast<double>(offset::memory_bytes(*sample.offsets)));
    return sample;
  }

  /// A spline through sections far apart, for rails that move aside: offsets over it are small, and its sides are where
  /// the rail's are. Sides that no wheel can touch are left out: along them offsets would be large.
  std::shared_ptr<const Surface> following_base() {
    constexpr double kStationSteps = 40.0;
    const double apart = kStationSteps * resolution_;
    limit_rail();
    note_ += fmt::format("offsets over sections at least {:g} mm apart. ", 1e3 * apart);
    const auto* slices = std::get_if<SliceSet>(&spec_.shape);
    if (slices != nullptr && !slices->features.empty() && spec_.defects.empty())
      return slice_surface(sampling::thinned_slices(*slices, apart), 0.0);
    Region r = region_;
    r.u_min -= beyond() + resolution_;
    r.u_max += beyond() + resolution_;
    return spline::make_slice_surface(sampling::touchable_slices(*natural_.surface, r, apart, resolution_), 0.0);
  }

  void limit_rail() {
    if (spec_.body != Body::rail) return;
    const Box3 box = natural_.surface->bounds();
    const auto limit = [&](double& end, double box_end, double fallback) {
      if (std::isfinite(end)) return;
      end = std::isfinite(box_end) ? box_end : fallback;
    };
    const bool open = !std::isfinite(region_.u_min) || !std::isfinite(region_.u_max);
    limit(region_.u_min, box.min.x(), -kDefaultHalfLength);
    limit(region_.u_max, box.max.x(), kDefaultHalfLength);
    if (open && !std::isfinite(box.max.x()))
      note_ += fmt::format("the rail was sampled from x = {:g} m to {:g} m. ", region_.u_min, region_.u_max);
  }

  /// Without damage there is nothing to sample: keep to the damaged part and some voxels round it.
  void narrow(Rectangle& r) const {
    constexpr double kMargin = 4.0;
    const auto damaged = analytic::defect_region(spec_.defects, spec_.nominal_radius);
    const double along = kMargin * resolution_ / (spec_.body == Body::wheel ? spec_.nominal_radius : 1.0);
    const double across = kMargin * resolution_;
    if (!damaged) {
      if (!std::isfinite(r.x_min) || !std::isfinite(r.x_max)) r.x_min = 0.0, r.x_max = along;
      r.x_max = std::min(r.x_max, r.x_min + along);
      return;
    }
    // a wheel's angles may be given on any turn: only the whole turn is safe to narrow
    if (spec_.body == Body::rail || !(r.x_max - r.x_min < 6.2)) {
      r.x_min = std::max(r.x_min, damaged->x_min - along);
      r.x_max = std::min(r.x_max, damaged->x_max + along);
    }
    r.y_min = std::max(r.y_min, damaged->y_min - across);
    r.y_max = std::min(r.y_max, damaged->y_max + across);
    r.x_max = std::max(r.x_max, r.x_min + along);
    r.y_max = std::max(r.y_max, r.y_min + across);
  }

  sampling::PointGrid points(bool common, bool staggered = false) {
    limit_rail();
    sampling::SampleSettings s{resolution_, 0.0, region_, common, staggered};
    // along a prismatic rail nothing changes: longer steps lose nothing
    constexpr double kLongStep = 4.0;
    if (natural_.constant_profile() && spec_.body == Body::rail) s.spacing_u = kLongStep * resolution_;
    // the rows of triangles begin half a step apart: begin earlier, so that the region itself is covered
    if (staggered) {
      const double step =
          (s.spacing_u > 0.0 ? s.spacing_u : resolution_) / (spec_.body == Body::wheel ? spec_.nominal_radius : 1.0);
      s.region.u_min -= step;
      s.region.u_max += step;
    }
    return kept(sampling::sample_points(*natural_.surface, spec_.body, spec_.nominal_radius, s));
  }

  /// What was sampled of a part of a wheel is all that the result stands for.
  sampling::PointGrid kept(sampling::PointGrid grid) {
    if (spec_.body == Body::wheel && !grid.closed) {
      region_.u_min = std::max(region_.u_min, grid.u.front());
      region_.u_max = std::min(region_.u_max, grid.u.back());
    }
    return grid;
  }

  Profile section() {
    sampling::SampleSettings s{resolution_, 1e-3, region_};
    s.region.u_min = 0.0;
    s.region.u_max = spec_.body == Body::wheel ? 1e-2 : 3e-3;
    if (spec_.body == Body::rail) {
      const Box3 box = natural_.surface->bounds();
      if (std::isfinite(box.min.x())) s.region.u_min = box.min.x(), s.region.u_max = box.max.x();
    }
    return sampling::median_section(sampling::sample_points(*natural_.surface, spec_.body, spec_.nominal_radius, s),
                                    spec_.nominal_radius, "samples of the " + std::string(word(spec_.body)));
  }

  const NaturalSurface& natural_;
  const SurfaceSpec& spec_;
  Region region_;
  double resolution_;
  bool asked_;
  std::string note_;
};

/// Formulas need no samples where they are asked for as formulas, splines none where points are given.
bool is_natural(const NaturalSurface& natural, const Representation& wanted) {
  if (wanted.backend.empty()) return true;
  if (natural.surface->backend() != wanted.backend) return false;
  return wanted.backend == "analytic" || !(wanted.resolution > 0.0);
}

}  // namespace

std::span<const std::string_view> backend_names() {
  static constexpr std::array<std::string_view, 8> kNames{
      "analytic", "spline", "nurbs", "mesh", "mesh-flat", "offset", "offset-quadratic", "offset-bilinear"};
  return kNames;
}

void require_backend(std::string_view name) {
  if (std::ranges::find(backend_names(), name) == backend_names().end())
    throw Error(ErrorKind::configuration, fmt::format("unknown backend '{}'", name), {},
                fmt::format("available: {}", fmt::join(backend_names(), ", ")));
}

std::span<const std::string_view> standard_profile_names() { return analytic::standard_profile_names(); }

NaturalSurface create_natural(SurfaceSpec spec) {
  check(spec);
  if (spec.roller_radius < 0.0) return create_ring(std::move(spec));
  if (spec.roller_radius != 0.0) return create_roller(std::move(spec));
  NaturalSurface natural;
  natural.surface = make_natural(spec, natural.note);
  natural.spec = std::move(spec);
  return natural;
}

NaturalSurface read_offset_surface(const std::filesystem::path& file) {
  offset::OffsetFile content = offset::read_vdb(file);
  check(content.base);
  NaturalSurface natural;
  natural.surface = offset::make_offset_surface(undamaged(content.base, {}), content.offsets,
                                                offset::Interpolation::bicubic, "offset");
  // what lies below is known, but not what was added: it is resampled from the surface
  natural.spec.body = content.base.body;
  natural.spec.nominal_radius = content.base.nominal_radius;
  natural.spec.shape = SliceSet{};
  return natural;
}

RepresentedSurface represent(const NaturalSurface& natural, const Representation& wanted) {
  using offset::Interpolation;
  if (natural.wheel_of_roller != nullptr) return represent_roller(natural, wanted);
  if (is_ring(natural)) return represent_ring(natural, wanted);
  if (!natural.parts.empty()) return represent_parts(natural, wanted);
  const auto start = Clock::now();
  RepresentedSurface out;
  out.region = wanted.region;
  if (!wanted.backend.empty()) require_backend(wanted.backend);
  if (is_natural(natural, wanted)) {
    out.surface = natural.surface;
    out.note = natural.note;
    return out;
  }
  Resampling sampling(natural, wanted);
  if (wanted.backend == "analytic")
    throw Error(ErrorKind::configuration,
                "the backend 'analytic' needs a formula, not measured points, slices, triangles or offsets", {},
                "use the backend 'spline', or a standard profile or arc chain");
  if (wanted.backend == "spline") out.surface = sampling.as_spline();
  if (wanted.backend == "nurbs") out.surface = sampling.as_nurbs();
  if (wanted.backend == "mesh") out.surface = sampling.as_mesh(mesh::Refinement::smooth, "mesh");
  if (wanted.backend == "mesh-flat") out.surface = sampling.as_mesh(mesh::Refinement::facets, "mesh-flat");
  if (wanted.backend == "offset") out.surface = sampling.as_offset(Interpolation::bicubic, "offset");
  if (wanted.backend == "offset-quadratic")
    out.surface = sampling.as_offset(Interpolation::quadratic, "offset-quadratic");
  if (wanted.backend == "offset-bilinear") out.surface = sampling.as_offset(Interpolation::bilinear, "offset-bilinear");
  out.resampled = true;
  const Sampled sampled = sampling.sampled();
  out.resolution = sampled.resolution;
  out.region = sampled.region;
  out.note = sampled.note;
  out.build_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return out;
}

SurfaceDifference fit_error(const NaturalSurface& natural, const RepresentedSurface& represented) {
  if (natural.wheel_of_roller != nullptr) return roller_fit_error(natural, represented);
  sampling::DifferenceSettings settings;
  settings.region = represented.region;
  if (natural.spec.body == Body::rail && !std::isfinite(natural.surface->bounds().max.x())) {
    if (!std::isfinite(settings.region.u_min)) settings.region.u_min = -kDefaultHalfLength;
    if (!std::isfinite(settings.region.u_max)) settings.region.u_max = kDefaultHalfLength;
  }
  return sampling::difference(*natural.surface, *represented.surface, natural.spec.body, natural.spec.nominal_radius,
                              settings);
}

std::shared_ptr<const Surface> create_surface(const SurfaceSpec& spec, std::string_view backend) {
  return represent(create_natural(spec), {std::string(backend), 0.0, {}}).surface;
}

TriangleMesh to_triangles(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) {
  if (natural.wheel_of_roller != nullptr) return roller_triangles(natural, wanted, sampled);
  if (is_ring(natural)) return to_triangles(rail_of_ring(natural), wanted, sampled);
  Resampling sampling(natural, wanted);
  TriangleMesh mesh = sampling.triangles();
  if (sampled != nullptr) *sampled = sampling.sampled();
  return mesh;
}

SliceSet to_slices(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) {
  if (natural.wheel_of_roller != nullptr) return roller_slices(natural, wanted, sampled);
  if (is_ring(natural)) return to_slices(rail_of_ring(natural), wanted, sampled);
  Resampling sampling(natural, wanted);
  SliceSet slices = sampling.slices();
  if (sampled != nullptr) *sampled = sampling.sampled();
  return slices;
}

void write_offsets(const std::filesystem::path& file, const NaturalSurface& natural, const Representation& wanted,
                   Sampled* sampled, const SurfaceSpec* given_base, const std::string& notes) {
  if (natural.wheel_of_roller != nullptr || is_ring(natural))
    throw Error(ErrorKind::configuration, "files of offsets hold rails and wheels, not rollers", {},
                "write slices or triangles");
  Resampling sampling(natural, wanted);
  std::shared_ptr<const Surface> base;
  offset::OffsetFile content;
  content.offsets = sampling.offsets(base, content.base, given_base).offsets;
  content.notes = notes;
  if (sampled != nullptr) *sampled = sampling.sampled();
  offset::write_vdb(file, content);
}

}  // namespace treadmark
