// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/analysis/measures/wheel.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/number_text.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/profiles/read_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/app/cases/noise_of_results.hpp"
#include "treadmark/app/cases/section_heights.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/model/magnitudes.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

NaturalSurface surface_of(const GeometryRequest& request, const std::string& name, Body body) {
  if (name == request.case_file) {
    NamedSurface said;
    said.body = body;
    said.overrides = request.overrides;
    return named_surface(name, said);
  }
  if (!fs::exists(name) && !is_offset_file(name)) {
    try {
      SurfaceSpec spec;
      spec.body = body;
      spec.shape = StandardProfile{name};
      spec.nominal_radius = body == Body::wheel ? 0.5 * kUsualDiameter : 0.0;
      return create_natural(std::move(spec));
    } catch (const Error& error) {
      if (library_body_of(name)) throw Error(ErrorKind::input_data, error.message(), {name}, error.advice());
      refuse_missing_surface(name, ErrorKind::input_data);
    }
  }
  NamedSurface said;
  said.body = body;
  said.scale_to_mm = request.scale_to_mm;
  said.nominal_radius = body == Body::wheel && !is_offset_file(name) ? 0.5 * kUsualDiameter : 0.0;
  return named_surface(name, said);
}

/// With errors that its points may have across themselves.
NaturalSurface with_errors(const NaturalSurface& natural, int draw) {
  SurfaceSpec spec = natural.spec;
  auto& profile = std::get<Profile>(spec.shape);
  const measured::ErrorDraws draws(profile);
  profile = draws.moved(profile, static_cast<std::size_t>(draw) % std::max<std::size_t>(1, draws.size()));
  return create_natural(std::move(spec));
}

/// With one draw of all errors that its import leaves it, near a station. The same surface has the same ones
/// everywhere.
std::shared_ptr<const Surface> with_errors(std::shared_ptr<const Surface> surface, const SurfaceErrors& errors,
                                           Body body, double u, int draw) {
  constexpr double kStep = 0.25e-3, kDrawsPerMetre = 1e8;  // of the knots of scatter [m]; as files have them
  const std::vector<double> places = places_across(*surface, kStep);
  const std::vector<std::vector<double>> scatter = draws_of_errors(errors, body, u, places);
  const std::vector<SourceOfErrors> sources = sources_of_errors(errors, body, u, *surface);
  std::uint64_t seed = static_cast<std::uint64_t>(draw);
  for (const double error : errors.draws.front())
    seed = Random(seed + static_cast<std::uint64_t>(to_whole<std::int64_t>(std::round(kDrawsPerMetre * error)))).bits();
  Random random(seed);
  const Facing facing = body == Body::rail ? Facing::up : Facing::down;
  surface =
      with_heights(std::move(surface),
                   {facing, places.front(), kStep, scatter[static_cast<std::size_t>(draw) % scatter.size()]}, 1.0);
  for (const SourceOfErrors& source : sources) {
    std::vector<double> factors;
    for (std::size_t k = 0; k < source.errors.size(); ++k) factors.push_back(normal(random));
    surface = with_heights(std::move(surface), source.errors, factors);
  }
  return surface;
}

/// errors: of which one draw is in it; may be null.
geometry::Section section_of(const GeometryRequest& request, const std::string& name, Body body, double cant,
                             const NaturalSurface& natural, const SurfaceErrors* errors = nullptr) {
  std::shared_ptr<const Surface> surface = natural.surface;
  if (request.backend.empty() && request.resolution > 0.0) refuse_idle_resolution();
  if (!request.backend.empty()) {
    constexpr double kHalfLength = 5e-3, kHalfAngle = 0.03;  // what is sampled round the section [m], [rad]
    Representation wanted{request.backend, request.resolution, {}};
    wanted.region.u_min = body == Body::wheel ? request.pitch - kHalfAngle : request.x - kHalfLength;
    wanted.region.u_max = body == Body::wheel ? request.pitch + kHalfAngle : request.x + kHalfLength;
    surface = represent(natural, wanted).surface;
  }
  if (errors != nullptr)
    surface =
        with_errors(std::move(surface), *errors, body, body == Body::wheel ? request.pitch : request.x, request.draw);
  geometry::Section section = body == Body::wheel ? geometry::wheel_section(*surface, request.pitch)
                                                  : geometry::rail_section(*surface, cant, request.x);
  if (const std::string why = geometry::wrong_body(section); !why.empty())
    throw Error(ErrorKind::input_data, fmt::format("this is no {}: {}", body_name(body), why), {name},
                fmt::format("give the profile of a {} here", body_name(body)));
  return section;
}

/// A wheel with the diameter asked for at its tape line.
void set_wheel(geometry::SideBodies& side, std::shared_ptr<const geometry::Section> section,
               const std::optional<double>& diameter, bool from_case, const std::string& name) {
  const double tape = section->at(0.0).z;
  if (std::isnan(tape))
    throw Error(ErrorKind::input_data,
                fmt::format("no tape line: the wheel's profile does not reach y = 0, it runs from {:.1f} to {:.1f} mm",
                            kMilli * section->first(), kMilli * section->last()),
                {name}, "y counts from the tape line, 70 mm from the flange's back");
  side.radius = diameter ? 0.5 * *diameter : from_case ? tape : 0.5 * kUsualDiameter;
  side.wheel = side.radius == tape ? std::move(section)
                                   : std::make_shared<const geometry::Section>(section->raised(side.radius - tape));
}

/// The wheelset under its load, and what is to be known of these numbers.
void add_load(GeometryResult& out) {
  const geometry::Analysis& a = out.analysis;
  const geometry::WheelsetOnTrack wheelset =
      geometry::place(out.right, out.left, out.placement, out.request.settings.roll, out.request.settings.yaw);
  out.load = geometry::loaded_functions(wheelset, a.functions, {*out.request.axle_load, out.material},
                                        a.equilibrium.value_or(0.0), a.single.amplitude);
  struct Doubt {
    std::string what;
    double first;  ///< shift where it is met
    std::size_t count = 0;
  };
  std::vector<Doubt> doubts;
  const auto met = [&](const std::string& what, double y) {
    auto known = ranges::find(doubts, what, &Doubt::what);
    if (known == doubts.end()) known = doubts.insert(known, {what, y});
    ++known->count;
  };
  for (std::size_t i = 0; i < a.functions.rows.size(); ++i) {
    const geometry::LoadedPosition& at = out.load->rows[i];
    const double y = a.functions.rows[i].y;
    std::string seen;  // both sides may have the same
    for (const geometry::LoadedSide* side : {&at.right, &at.left}) {
      if (side->reason.empty() || side->reason == seen) continue;
      met("no pressure: " + side->reason, y);
      seen = side->reason;
    }
    if (at.right.shared || at.left.shared)
      met("the approach closes the gap of a second contact, which shares the load: the ellipse is not the true one", y);
  }
  for (const Doubt& doubt : doubts)
    out.notes.push_back(fmt::format("at {} of {} displacements, y = {:g} mm the first, {}", doubt.count,
                                    a.functions.rows.size(), kMilli * doubt.first, doubt.what));
}

}  // namespace

double parse_cant(const std::string& text) {
  const auto refuse = [&]() -> double {
    throw Error(ErrorKind::configuration, fmt::format("'{}' is no inclination of a rail", text), {},
                "write it as 1:40, or 0");
  };
  double tangent = 0.0;
  if (const auto colon = text.find(':'); colon != std::string::npos) {
    const auto rise = finite_number(text.substr(0, colon)), run = finite_number(text.substr(colon + 1));
    if (!rise || !run || *run == 0.0) return refuse();
    tangent = *rise / *run;
  } else {
    const auto value = finite_number(text);
    if (!value) return refuse();
    tangent = *value;
  }
  constexpr double kSteepest = 0.2;
  if (std::fabs(tangent) > kSteepest) return refuse();
  return std::atan(tangent);
}

std::vector<double> parse_numbers(const std::string& text) {
  const auto refuse = [&](const char* why) {
    throw Error(ErrorKind::configuration, fmt::format("'{}': {}", text, why), {},
                "write 3, or 1,2,3, or 1:7.5:0.1 (from:to:step)");
  };
  std::vector<double> numbers;
  const char between = text.find(':') != std::string::npos ? ':' : ',';
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(between, at), text.size());
    const auto number = finite_number(std::string_view(text).substr(at, end - at));
    if (!number) refuse("not a number");
    numbers.push_back(*number);
    at = end + 1;
  }
  if (between == ',') return numbers;
  if (numbers.size() != 3 || !(numbers[2] > 0.0) || !(numbers[1] >= numbers[0])) refuse("not from:to:step");
  constexpr double kMost = 10000.0;
  const double from = numbers[0], step = numbers[2], count = std::floor((numbers[1] - from) / step + 1e-6);
  if (count > kMost) refuse("too many values");
  numbers.clear();
  for (int k = 0; k <= static_cast<int>(count); ++k) numbers.push_back(std::round(1e9 * (from + k * step)) / 1e9);
  return numbers;
}

std::shared_ptr<const geometry::Section> SectionStore::get(const GeometryRequest& request, const std::string& name,
                                                           Body body, double cant) {
  const std::string key =
      fmt::format("{}|{}|{}|{}|{}|{}|{}|{}", name, body_name(body), body == Body::rail ? cant : 0.0, request.pitch,
                  request.x, request.scale_to_mm, request.backend, request.resolution);
  constexpr std::size_t kOfProfile = 8, kMost = 2000, kMostScans = 32;  // of long lists whose files come once
  std::shared_ptr<const NaturalSurface> natural;
  bool drawn = false;  // a draw of an exact shape is the shape
  {
    const std::lock_guard lock(mutex_);
    drawn = request.draw > 0 && draws_.contains({name, body});
    if (const auto found = sections_.find(key); found != sections_.end() && !drawn) return found->second;
    if (const auto found = noisy_.find({name, body}); found != noisy_.end() && drawn) natural = found->second;
  }
  if (natural == nullptr) natural = std::make_shared<const NaturalSurface>(surface_of(request, name, body));
  const bool points = noisy_profile(*natural) != nullptr;
  auto section = std::make_shared<const geometry::Section>(
      drawn && points ? section_of(request, name, body, cant, with_errors(*natural, request.draw))
                      : section_of(request, name, body, cant, *natural, drawn ? natural->spec.errors.get() : nullptr));
  const std::lock_guard lock(mutex_);
  if (points || natural->spec.errors) {
    draws_.try_emplace({name, body}, points ? kOfProfile : kNearestDraws);
    // what goes is read again
    if (noisy_.size() >= (points ? kMost : kMostScans) && !noisy_.contains({name, body})) noisy_.clear();
    noisy_.try_emplace({name, body}, natural);
  }
  if (drawn) return section;
  if (!natural->note.empty()) notes_[name] = natural->note;
  if (sections_.size() >= kMost) sections_.clear();
  return sections_.try_emplace(key, std::move(section)).first->second;
}

std::size_t SectionStore::draws_of(const std::string& name, Body body) {
  const std::lock_guard lock(mutex_);
  const auto found = draws_.find({name, body});
  return found == draws_.end() ? 0 : found->second;
}

std::string SectionStore::note_of(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = notes_.find(name);
  return found == notes_.end() ? std::string() : found->second;
}

geometry::PairPlacement placement_of(const io::WheelRailCase& input) {
  geometry::PairPlacement placement;
  if (input.track.gauge_based)
    placement.gauge = input.track.gauge_width, placement.gauge_height = input.track.gauge_height;
  else
    placement.rail_origins = 2.0 * std::fabs(input.track.rail_y0);
  placement.wheel_origins = input.wheelset.flange_back_distance - 2.0 * input.wheelset.flange_back_position;
  return placement;
}

GeometryResult read_geometry(const GeometryRequest& request, SectionStore& store) {
  GeometryResult out;
  out.request = request;
  GeometryRequest& r = out.request;
  double cant = r.cant.value_or(0.0);
  geometry::PairPlacement& placement = out.placement;
  if (!r.case_file.empty()) {
    const io::CaseFile file = read_registered_case(r.case_file, r.overrides);
    const io::WheelRailCase* first = first_wheelrail_case(file);
    if (first == nullptr)
      throw Error(ErrorKind::configuration, "there is no case of a wheel on a rail in the file", {r.case_file});
    if (first->roller)
      throw Error(ErrorKind::configuration, "rollers have no geometry of a track", {r.case_file},
                  "use a case with rails");
    if (r.wheel.empty()) r.wheel = r.case_file;
    if (r.rail.empty()) r.rail = r.case_file;
    if (!r.cant) cant = first->track.cant;
    placement = placement_of(*first);
    out.material = first->material;
    if (file.cases.size() > 1) out.notes.emplace_back("the first case of a wheel on a rail counts");
  } else {
    for (const auto& [name, what] : {std::pair{&r.wheel, "wheel"}, std::pair{&r.rail, "rail"}})
      if (name->empty())
        throw Error(ErrorKind::configuration, fmt::format("no profile: {} is missing", what), {},
                    "name a file or a profile that is built in");
    if (!r.gauge && !r.rail_origins)
      throw Error(ErrorKind::configuration, "where the rails are is not said", {},
                  "give the gauge with the cant, or the distance of the rails' origins");
    if (!r.overrides.empty())
      throw Error(ErrorKind::configuration, "there is no case whose keys could change", {}, "name its file as case");
  }
  for (const std::optional<double>& diameter : {r.diameter, r.diameter_left})
    if (diameter) require_wheel_radius(0.5 * *diameter);
  if (r.gauge && !(*r.gauge >= kLeastGauge && *r.gauge <= kMostGauge))
    throw Error(ErrorKind::configuration, fmt::format("no track has a gauge of {:g} m", *r.gauge), {},
                "is it in the unit that is asked for?");
  if (r.gauge && r.rail_origins)
    throw Error(ErrorKind::configuration, "gauge and distance of the rails' origins say the same thing twice", {},
                "give one of them");
  if (r.gauge) placement.gauge = r.gauge;
  if (r.rail_origins) placement.gauge.reset(), placement.rail_origins = *r.rail_origins;
  if (r.gauge_height) placement.gauge_height = *r.gauge_height;
  if (r.wheel_origins) placement.wheel_origins = *r.wheel_origins;

  const std::string wheel_left = r.wheel_left.empty() ? r.wheel : r.wheel_left,
                    rail_left = r.rail_left.empty() ? r.rail : r.rail_left;
  const auto side = [&](const std::string& wheel, const std::string& rail, const std::optional<double>& diameter) {
    geometry::SideBodies s;
    set_wheel(s, store.get(r, wheel, Body::wheel, 0.0), diameter, wheel == r.case_file, wheel);
    s.rail = store.get(r, rail, Body::rail, cant);
    s.cant = cant;
    return s;
  };
  out.right = side(r.wheel, r.rail, r.diameter);
  out.left = side(wheel_left, rail_left, r.diameter_left ? r.diameter_left : r.diameter);
  if (out.left.radius == out.right.radius && wheel_left == r.wheel) out.left.wheel = out.right.wheel;
  for (const std::string& name : std::set<std::string>{r.wheel, wheel_left, r.rail, rail_left})
    if (const std::string note = store.note_of(name); !note.empty())
      out.notes.push_back(fmt::format("{}: {}", name, note));
  return out;
}

namespace {

/// From draws of the profiles' errors, as results of runs have it.
std::optional<ConicityNoise> noise_of_conicity(const GeometryResult& result, SectionStore& store) {
  const GeometryRequest& r = result.request;
  const std::size_t count = std::max({store.draws_of(r.wheel, Body::wheel), store.draws_of(r.wheel_left, Body::wheel),
                                      store.draws_of(r.rail, Body::rail), store.draws_of(r.rail_left, Body::rail)});
  if (count == 0) return std::nullopt;
  std::vector<std::optional<geometry::Analysis>> found(count);
  parallel_for(count, [&](std::size_t k) {
    GeometryRequest drawn = r;
    drawn.draw = static_cast<int>(k) + 1;
    drawn.settings.wanted_amplitude = result.analysis.single.amplitude;
    drawn.settings.harmonic = false;
    try {
      const GeometryResult placed = read_geometry(drawn, store);
      found[k] = geometry::analyse(placed.right, placed.left, placed.placement, placed.request.settings);
    } catch (const Error&) {  // a wheelset that cannot be so
    }
  });
  std::vector<geometry::Analysis> draws;
  for (std::optional<geometry::Analysis>& one : found)
    if (one) draws.push_back(*std::move(one));
  if (2 * draws.size() < count) return std::nullopt;
  const auto deviation = [&](double base, auto&& of) {
    double squares = 0.0;
    for (const geometry::Analysis& one : draws) squares += std::pow(of(one) - base, 2);
    return std::sqrt(squares / static_cast<double>(draws.size()));
  };
  const geometry::Analysis& a = result.analysis;
  ConicityNoise out;
  for (std::size_t i = 0; i < a.conicity.size(); ++i)
    out.of_amplitude.push_back(
        deviation(a.conicity[i].tan_gamma, [i](const auto& one) { return one.conicity.at(i).tan_gamma; }));
  out.single = deviation(a.single.tan_gamma, [](const auto& one) { return one.single.tan_gamma; });
  out.at_3mm = deviation(a.at_3mm.tan_gamma, [](const auto& one) { return one.at_3mm.tan_gamma; });
  return out;
}

GaugeSweep sweep_gauges(const GeometryResult& base) {
  const std::vector<double>& gauges = base.request.gauges;
  GaugeSweep out;
  out.gauges = gauges;
  out.conicity.resize(gauges.size());
  out.at_3mm.resize(gauges.size());
  out.trouble.resize(gauges.size());
  geometry::AnalysisSettings settings = base.request.settings;
  settings.second = 0.0;
  settings.harmonic = false;
  parallel_for(gauges.size(), [&](std::size_t i) {
    geometry::PairPlacement placement = base.placement;
    placement.gauge = gauges[i];
    try {
      geometry::Analysis a = geometry::analyse(base.right, base.left, placement, settings);
      out.conicity[i] = std::move(a.conicity);
      out.at_3mm[i] = a.at_3mm;
    } catch (const Error& error) {
      out.trouble[i] = error.message();
    }
  });
  return out;
}

}  // namespace

GeometryResult run_geometry(const GeometryRequest& request, SectionStore& store) {
  GeometryResult out = read_geometry(request, store);
  out.analysis = geometry::analyse(out.right, out.left, out.placement, out.request.settings);
  out.noise = noise_of_conicity(out, store);
  std::size_t beyond = 0;
  for (const geometry::Conicity& c : out.analysis.conicity) beyond += c.reason.empty() ? 0U : 1U;
  if (beyond > 0)
    for (const geometry::Conicity& c : out.analysis.conicity)
      if (!c.reason.empty()) {
        out.notes.push_back(fmt::format("no conicity at {} of {} amplitudes, {:g} mm the first: {}", beyond,
                                        out.analysis.conicity.size(), kMilli * c.amplitude, c.reason));
        break;
      }
  if (out.request.axle_load) add_load(out);
  if (!request.new_wheel.empty() || !request.new_rail.empty()) {
    GeometryRequest fresh = request;
    if (!request.new_wheel.empty()) fresh.wheel = request.new_wheel, fresh.wheel_left.clear();
    if (!request.new_rail.empty()) fresh.rail = request.new_rail, fresh.rail_left.clear();
    const GeometryResult placed = read_geometry(fresh, store);
    out.with_new = geometry::analyse(placed.right, placed.left, placed.placement, placed.request.settings);
  }
  if (!request.gauges.empty()) out.sweep = sweep_gauges(out);
  return out;
}

std::vector<std::string> profile_doubts(const GeometryRequest& request) {
  std::vector<std::string> out, seen;
  for (const auto& [name, body] : {std::pair{request.wheel, Body::wheel}, std::pair{request.wheel_left, Body::wheel},
                                   std::pair{request.rail, Body::rail}, std::pair{request.rail_left, Body::rail}}) {
    if (ranges::find(seen, name) != seen.end() || !std::filesystem::exists(name)) continue;
    seen.push_back(name);
    for (std::string& doubt : import_doubts(name, body)) out.push_back(std::move(doubt));
    const io::ExpectedProfile expected{{}, {}, true, request.cant};
    if (io::is_slices_file(name)) {
      io::ProfileOptions options;
      options.scale = request.scale_to_mm;
      if (std::string doubt = doubt_of_slices(io::read_slices(name, body, options), name, body, expected);
          !doubt.empty())
        out.push_back(std::move(doubt));
    }
    if (!is_profile_file(name)) continue;
    const CheckedProfile checked = check_profile(name, body, {}, expected);
    for (const io::ProfileRemark& remark : checked.judgement.remarks)
      if (remark.name != "gauge_point")  // refused where it is needed
        out.push_back(fmt::format("{}: {}: {}", checked.name, remark.name, remark.text));
  }
  return out;
}

void write_geometry_folder(const std::filesystem::path& folder, const GeometryResult& result) {
  make_folder(folder);
  write_file(folder / "functions.csv", functions_csv(result));
  write_file(folder / "conicity.csv", conicity_csv(result));
  write_file(folder / "charts.svg", geometry_charts_svg(result));
  write_file(folder / "contact_points.svg", contact_points_svg(result));
  if (result.sweep) {
    write_file(folder / "gauges.csv", sweep_csv(*result.sweep));
    write_file(folder / "gauges.svg", gauge_sweep_svg(*result.sweep));
  }
  write_file(folder / "geometry.json", geometry_json(result));
}

}  // namespace treadmark::app
