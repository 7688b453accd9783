// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/design/design_cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/analysis/geometry/analysis.hpp"
#include "treadmark/app/cases/case_sequence.hpp"
#include "treadmark/app/cases/run_parts.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/simulation/study_identity.hpp"
#include "treadmark/app/surfaces/convert_profile.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/results/listed_number.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::app {
namespace {

constexpr std::size_t kMostPatches = 6;  // of a position that are looked at
constexpr std::size_t kPads = 4;         // places beyond an end: a spline has swung out there
constexpr double kConicityStep = 2e-3;   // share of a range over which conicity is differenced

/// What is wrong is told at this place of the file.
template <class Work>
auto told_at(const SourcePosition& where, const Work& work) {
  try {
    return work();
  } catch (const Error& e) {
    throw Error(e.kind(), e.message(), where, e.advice());
  }
}

const io::WheelRailCase& input_of(const io::Case& c) { return std::get<io::WheelRailCase>(c.content); }

/// The surface of a body.
std::shared_ptr<const Surface> surface_of(const wheelrail::Geometry& geometry, Body body) {
  return body == Body::rail ? geometry.rail : geometry.wheel;
}

/// Of a wheelset with two such wheels on two such rails. Errors: also Error(numerical) where there is none.
std::vector<double> conicities(const io::WheelRailCase& input, const wheelrail::Geometry& bodies,
                               const std::vector<double>& amplitudes) {
  geometry::AnalysisSettings settings;
  settings.second = 0.0;
  settings.harmonic = false;
  settings.amplitudes = amplitudes;
  geometry::SideBodies side;
  side.wheel = std::make_shared<const geometry::Section>(geometry::wheel_section(*bodies.wheel));
  side.radius = side.wheel->at(0.0).z;
  side.cant = input.track.cant;
  side.rail = std::make_shared<const geometry::Section>(
      geometry::rail_section(*bodies.rail, side.cant, input.state.position.x));
  std::vector<double> out;
  for (const geometry::Conicity& c : geometry::analyse(side, side, placement_of(input), settings).conicity) {
    if (!std::isfinite(c.tan_gamma))
      throw Error(ErrorKind::numerical, fmt::format("no conicity at {:g} mm: {}", kMilli * c.amplitude, c.reason));
    out.push_back(c.tan_gamma);
  }
  return out;
}

}  // namespace

DesignCases::DesignCases(const io::DesignFile& file) : file_(file) {
  read_positions();
  find_variables();
  find_surfaces();
  find_quantities();
}

void DesignCases::read_positions() {
  cases_.path = file_.positions.base;
  cases_.title = file_.positions.title;
  for (const io::StudyRun& run : file_.positions.runs) {
    const auto cases = std::get<io::CaseFile>(io::read_study_run(file_.positions, run));
    const std::string label = label_of(file_.positions, run);
    for (const io::Case& c : cases.cases) {
      const auto* input = std::get_if<io::WheelRailCase>(&c.content);
      if (input == nullptr || input->roller)
        throw Error(ErrorKind::configuration, "a design needs a wheel on a rail", c.where,
                    "patches by themselves have no surface, and rollers are not designed");
      if (!starts_anew(c))
        throw Error(ErrorKind::configuration, "a design needs cases that stand by themselves", c.where,
                    "take steady rolling");
      io::Case& own = cases_.cases.emplace_back(c);
      own.number = static_cast<int>(cases_.cases.size());
      own.sequence = own.number;
      own.shown = true;
      own.element_table = 0;
      std::string name = label.empty() ? fmt::format("position {}", run.number) : label;
      if (cases.cases.size() > 1) name += fmt::format(", case {}", c.number);
      labels_.push_back(std::move(name));
      weights_.push_back(file_.weights[static_cast<std::size_t>(run.number) - 1] /
                         static_cast<double>(cases.cases.size()));
    }
  }
  require_registered(cases_);
}

void DesignCases::find_variables() {
  for (const io::DesignParameter& p : file_.parameters) {
    const auto value_in = [&](const io::Case& c) { return told_at(p.where, [&] { return io::number_of(c, p.key); }); };
    const std::optional<double> given = value_in(cases_.cases.front());
    if (!given)
      throw Error(ErrorKind::configuration, fmt::format("{} is not given by the base", p.key), p.where,
                  "write it there: the search starts at its value");
    if (!(*given >= p.from && *given <= p.to))
      throw Error(ErrorKind::configuration,
                  fmt::format("{} = {:g} of the base is not between {:g} and {:g}", p.key, *given, p.from, p.to),
                  p.where, "the search starts at the value of the base");
    for (std::size_t i = 0; i < cases_.cases.size(); ++i)
      if (value_in(cases_.cases[i]) != given)
        throw Error(ErrorKind::configuration,
                    fmt::format("{} is not the same in all positions: see {}", p.key, labels_[i]), p.where,
                    "what is sought must not be varied");
    keys_.push_back(p.key);
    variables_.push_back({p.key, p.from, p.to, *given});
  }
  if (!file_.depth) return;
  const io::DesignDepth& d = *file_.depth;
  for (std::size_t k = 0; k < d.least.size(); ++k) {
    if (!(d.least[k] < d.most[k])) continue;
    places_.push_back(k);
    variables_.push_back({fmt::format("depth_mm at y = {:g} mm", kMilli * (d.from + static_cast<double>(k) * d.step)),
                          kMilli * d.least[k], kMilli * d.most[k], kMilli * std::clamp(0.0, d.least[k], d.most[k]),
                          kNaN, true});
    std::vector<double> range(d.least.size(), 0.0);
    range[k] = d.most[k] - d.least[k];
    ranges_.push_back(padded(std::move(range)));
    by_place_.push_back(heights(ranges_.back()));
  }
}

void DesignCases::find_surfaces() {
  store_.emplace();
  std::vector<double> start;
  start.reserve(variables_.size());
  for (const DesignVariable& v : variables_) start.push_back((v.given - v.from) / (v.to - v.from));
  const auto at_end = [&](std::size_t k, double share) {
    std::vector<double> design = start;
    design[k] = share;
    return design;
  };
  io::CaseFile reached = cases_;  // what is sampled of surfaces must hold all designs
  for (std::size_t k = 0; k < keys_.size(); ++k)
    for (const double share : {0.0, 1.0})
      told_at(file_.parameters[k].where, [&] {
        for (std::size_t p = 0; p < cases_.cases.size(); ++p) reached.cases.push_back(case_of(p, at_end(k, share)));
      });
  regions_ = sampled_regions(reached);
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    const auto at = [&](double share) {
      return told_at(file_.parameters[k].where, [&] { return given_geometry(0, at_end(k, share)); });
    };
    const wheelrail::Geometry low = at(0.0), high = at(1.0);
    variables_[k].surfaces = low.rail != high.rail || low.wheel != high.wheel;
    remakes_ |= variables_[k].surfaces;
  }
  std::vector<wheelrail::Geometry> all;
  for (std::size_t p = 0; p < cases_.cases.size(); ++p) {
    const io::WheelRailCase& input = input_of(cases_.cases[p]);
    all.push_back(given_geometry(p, start));
    if (file_.depth && surface_of(all[p], file_.depth->body) != surface_of(all[0], file_.depth->body))
      throw Error(
          ErrorKind::configuration,
          fmt::format("the positions have different surfaces of the {}, which changes", body_name(file_.depth->body)),
          source_of(cases_.cases[p]).where, "what changes is one surface; vary the other body");
    const auto same = ranges::find_if(pairs_, [&](const BodyPair& pair) {
      const io::WheelRailCase& other = input_of(cases_.cases[pair.position]);
      return all[pair.position].rail == all[p].rail && all[pair.position].wheel == all[p].wheel &&
             placement_of(other) == placement_of(input) && other.track.cant == input.track.cant &&
             other.state.position.x == input.state.position.x;
    });
    if (same == pairs_.end())
      pairs_.push_back({p, weights_[p]});
    else
      same->weight += weights_[p];
  }
  if (!file_.depth) return;
  const io::DesignDepth& d = *file_.depth;
  const double u = d.body == Body::rail ? input_of(cases_.cases[0]).state.position.x : 0.0;
  for (std::size_t k = 0; k < d.least.size(); ++k) {
    const double y = d.from + static_cast<double>(k) * d.step;
    const std::array<double, 3> at{y - d.step, y, y + d.step};
    std::array<double, 3> z{};
    section_heights(*surface_of(all[0], d.body), d.body, u, at, {z, {}, {}});
    if (!std::isfinite(z[1]))
      throw Error(ErrorKind::configuration, fmt::format("there is no {} at y = {:g} mm", body_name(d.body), kMilli * y),
                  d.where, "keep from_mm and to_mm on the profile");
    const double bent = (z[0] - 2.0 * z[1] + z[2]) / (d.step * d.step);
    convexity_.push_back(d.body == Body::rail ? bent : -bent);
  }
}

void DesignCases::find_quantities() {
  const auto add = [&](const io::DesignedQuantity& quantity) {
    Asked one = asked(quantity);
    const auto known = ranges::find_if(
        quantities_, [&](const Asked& other) { return other.name == one.name && other.amplitudes == one.amplitudes; });
    if (known == quantities_.end()) quantities_.push_back(std::move(one));
  };
  for (const io::DesignGoal& goal : file_.goals) add(goal.of);
  for (const io::DesignLimit& limit : file_.limits) add(limit.of);
  contact_ = ranges::any_of(quantities_, [](const Asked& one) { return one.kind == Kind::contact; });
  if (ranges::none_of(quantities_, [](const Asked& one) { return one.kind == Kind::convexity; })) return;
  for (std::size_t k = first_bent(); k + first_bent() < convexity_.size(); ++k)
    if (!std::isfinite(convexity_[k]))
      throw Error(ErrorKind::configuration,
                  fmt::format("the {} ends beside y = {:g} mm, so that its convexity there is not known",
                              body_name(file_.depth->body),
                              kMilli * (file_.depth->from + static_cast<double>(k) * file_.depth->step)),
                  file_.depth->where, "begin and end a step within the profile");
}

DesignCases::Asked DesignCases::asked(const io::DesignedQuantity& quantity) const {
  const auto refuse = [&](const std::string& message, const char* advice) {
    throw Error(ErrorKind::configuration, message, quantity.where, advice);
  };
  struct Own {
    const char* name;
    Kind kind;
  };
  constexpr Own kOwn[] = {{"conicity", Kind::conicity},
                          {"removed_mm2", Kind::removed},
                          {"bend_1_per_m", Kind::bend},
                          {"convexity_1_per_m", Kind::convexity}};
  Asked out{quantity.name, quantity.amplitudes};
  const auto own = ranges::find_if(kOwn, [&](const Own& row) { return row.name == quantity.name; });
  if (own != std::end(kOwn)) out.kind = own->kind;
  if ((out.kind == Kind::conicity) == out.amplitudes.empty())
    refuse(out.amplitudes.empty() ? "conicity needs amplitudes_mm" : quantity.name + " has no amplitudes",
           "amplitudes_mm belongs to conicity");
  if (own != std::end(kOwn)) {
    if (out.kind != Kind::conicity && !file_.depth)
      refuse(quantity.name + " is of a depth, and none is sought", "give [design.depth], or another quantity");
    return out;
  }
  const io::ListedNumber number = told_at(quantity.where, [&] { return io::listed_number(quantity.name); });
  const bool smooth = (number.of_case != nullptr && number.of_case->access.smooth) ||
                      (number.of_patch != nullptr && number.of_patch->access.smooth);
  if (!smooth) refuse(quantity.name + " has no derivatives", "treadmark run --sensitivities tells which numbers have");
  out.name = number.name;
  out.of_patches = number.of_patch != nullptr && number.patch == 0;
  return out;
}

std::size_t DesignCases::place_of(const io::DesignedQuantity& quantity) const {
  const Asked one = asked(quantity);
  return static_cast<std::size_t>(ranges::find_if(quantities_,
                                                  [&](const Asked& other) {
                                                    return other.name == one.name && other.amplitudes == one.amplitudes;
                                                  }) -
                                  quantities_.begin());
}

std::string DesignCases::where_of(std::size_t quantity, std::size_t number) const {
  const Asked& of = quantities_[quantity];
  switch (of.kind) {
    case Kind::contact:
      return of.of_patches ? fmt::format("{}, patch {}", labels_[number / kMostPatches], number % kMostPatches + 1)
                           : labels_[number];
    case Kind::conicity: {
      const std::size_t each = of.amplitudes.size();
      const std::string at = fmt::format("amplitude {:g} mm", kMilli * of.amplitudes[number % each]);
      return pairs_.size() == 1 ? at : fmt::format("{}, {}", labels_[pairs_[number / each].position], at);
    }
    case Kind::removed:
      return "all places";
    case Kind::bend:
    case Kind::convexity:
      break;
  }
  const auto place = static_cast<double>(first_bent() + number);
  return fmt::format("y = {:g} mm", kMilli * (file_.depth->from + place * file_.depth->step));
}

const io::SurfaceSource& DesignCases::source_of(const io::Case& c) const {
  return file_.depth->body == Body::rail ? input_of(c).rail : input_of(c).wheel;
}

io::Case DesignCases::case_of(std::size_t position, const std::vector<double>& design) const {
  io::Case c = cases_.cases[position];
  for (std::size_t k = 0; k < keys_.size(); ++k)
    io::apply_override(c, fmt::format("{}={:.17g}", keys_[k],
                                      variables_[k].from + design[k] * (variables_[k].to - variables_[k].from)));
  return c;
}

std::vector<double> DesignCases::depths(const std::vector<double>& design) const {
  if (!file_.depth) return {};
  std::vector<double> out = file_.depth->least;
  for (std::size_t j = 0; j < places_.size(); ++j)
    out[places_[j]] += design[keys_.size() + j] * (file_.depth->most[places_[j]] - file_.depth->least[places_[j]]);
  return out;
}

std::vector<double> DesignCases::padded(std::vector<double> depths) const {
  const bool level = file_.depth->level_ends;
  depths.insert(depths.begin(), kPads, level ? depths.front() : 0.0);
  depths.insert(depths.end(), kPads, level ? depths.back() : 0.0);
  return depths;
}

SectionHeights DesignCases::heights(std::vector<double> depths) const {
  const io::DesignDepth& d = *file_.depth;
  const bool rail = d.body == Body::rail;
  if (!rail)
    for (double& depth : depths) depth = -depth;  // the radius becomes less
  return {rail ? Facing::up : Facing::down, d.from - static_cast<double>(kPads) * d.step, d.step, std::move(depths)};
}

std::optional<SectionHeights> DesignCases::heights_of(const std::vector<double>& design) const {
  if (!file_.depth) return std::nullopt;
  return heights(padded(depths(design)));
}

wheelrail::Geometry DesignCases::given_geometry(std::size_t position, const std::vector<double>& design) {
  return geometry_of(input_of(case_of(position, design)), *store_, regions_);
}

wheelrail::Geometry DesignCases::geometry(std::size_t position, const std::vector<double>& design) {
  wheelrail::Geometry out = given_geometry(position, design);
  if (const std::optional<SectionHeights> added = heights_of(design)) {
    auto& surface = added->facing == Facing::up ? out.rail : out.wheel;
    surface = with_heights(std::move(surface), *added, 1.0);
  }
  return out;
}

DesignNumbers DesignCases::at(const std::vector<double>& design) {
  if (remakes_) store_.emplace();  // surfaces of other designs are needed no longer
  DesignNumbers out(quantities_.size());
  for (std::size_t q = 0; q < quantities_.size(); ++q)
    if (quantities_[q].kind == Kind::conicity)
      add_conicity(design, q, out[q]);
    else if (quantities_[q].kind != Kind::contact)
      add_depth(design, quantities_[q].kind, out[q]);
  if (contact_) add_contact(design, out);
  return out;
}

void DesignCases::add_contact(const std::vector<double>& design, DesignNumbers& out) {
  const std::optional<SectionHeights> added = heights_of(design);
  for (std::size_t p = 0; p < cases_.cases.size(); ++p) {
    check_cancelled();
    const io::CaseDerivatives known =
        derivatives_by(case_of(p, design), *store_, regions_, keys_, by_place_, added ? &*added : nullptr);
    std::string why = known.message;
    for (std::size_t k = 0; k < known.parameters.size() && why.empty(); ++k)
      if (!known.parameters[k].left_out.empty())
        why = fmt::format("no derivatives by {}: {}", variables_[k].name, known.parameters[k].left_out);
    if (!why.empty()) throw Error(ErrorKind::numerical, labels_[p] + ": " + why, cases_.cases[p].where);
    for (std::size_t q = 0; q < quantities_.size(); ++q)
      if (quantities_[q].kind == Kind::contact) take_contact(quantities_[q], p, known.numbers, out[q]);
  }
}

void DesignCases::take_contact(const Asked& of, std::size_t position,
                               const std::vector<io::CaseDerivatives::Number>& known,
                               std::vector<DesignNumber>& out) const {
  const std::size_t first = out.size(), count = of.of_patches ? kMostPatches : 1;
  out.resize(first + count);
  std::optional<std::size_t> most;
  for (std::size_t k = 0; k < count; ++k) {
    const std::string name = of.of_patches ? fmt::format("patch_{}.{}", k + 1, of.name) : of.name;
    const auto found = ranges::find(known, name, &io::CaseDerivatives::Number::name);
    if (found == known.end() || !std::isfinite(found->value)) continue;
    DesignNumber& number = out[first + k];
    number.value = found->value;
    number.by = found->by;
    for (std::size_t v = 0; v < number.by.size(); ++v) {
      if (v < keys_.size()) number.by[v] *= variables_[v].to - variables_[v].from;
      if (!std::isfinite(number.by[v]))
        throw Error(ErrorKind::numerical,
                    fmt::format("{}: {} has no derivative by {}", labels_[position], name, variables_[v].name));
    }
    if (!most || number.value > out[*most].value) most = first + k;
  }
  if (most) out[*most].weight = weights_[position];
}

void DesignCases::add_conicity(const std::vector<double>& design, std::size_t quantity,
                               std::vector<DesignNumber>& out) {
  const std::vector<double>& amplitudes = quantities_[quantity].amplitudes;
  std::vector<std::vector<double>> designs{design};
  for (std::size_t v = 0; v < variables_.size(); ++v)
    for (const double step : {-kConicityStep, kConicityStep}) {
      designs.push_back(design);
      designs.back()[v] = std::clamp(design[v] + step, 0.0, 1.0);
    }
  for (const BodyPair& pair : pairs_) {
    std::vector<wheelrail::Geometry> bodies;
    bodies.reserve(designs.size());
    for (const std::vector<double>& one : designs) bodies.push_back(geometry(pair.position, one));
    std::vector<std::vector<double>> found(designs.size());
    std::vector<std::exception_ptr> failed(designs.size());
    parallel_for(designs.size(), [&](std::size_t i) {
      try {
        found[i] = conicities(input_of(case_of(pair.position, designs[i])), bodies[i], amplitudes);
      } catch (const Error&) {
        failed[i] = std::current_exception();
      }
    });
    for (const std::exception_ptr& error : failed)  // of several the same one for any number of threads
      if (error) std::rethrow_exception(error);
    for (std::size_t a = 0; a < amplitudes.size(); ++a) {
      DesignNumber number{found[0][a], pair.weight, {}};
      for (std::size_t v = 0; v < variables_.size(); ++v) {
        const std::size_t less = 1 + 2 * v, more = less + 1;
        number.by.push_back((found[more][a] - found[less][a]) / (designs[more][v] - designs[less][v]));
      }
      out.push_back(std::move(number));
    }
  }
}

void DesignCases::add_depth(const std::vector<double>& design, Kind kind, std::vector<DesignNumber>& out) const {
  const double step = file_.depth->step;
  const std::vector<double> now = padded(depths(design));
  const std::size_t places = now.size() - 2 * kPads;
  const auto removed = [&](const std::vector<double>& d) {
    constexpr double kSquareMm = 1e6;
    double sum = 0.0;
    for (std::size_t k = 0; k < places; ++k) sum += d[kPads + k];
    return kSquareMm * step * sum;
  };
  const auto add = [&](double more, const auto& of) {
    DesignNumber number{more + of(now), 1.0, std::vector<double>(keys_.size(), 0.0)};
    for (const std::vector<double>& range : ranges_) number.by.push_back(of(range));
    out.push_back(std::move(number));
  };
  if (kind == Kind::removed) return add(0.0, removed);
  for (std::size_t k = first_bent(); k < places - first_bent(); ++k)
    add(kind == Kind::convexity ? convexity_[k] : 0.0, [&](const std::vector<double>& d) {
      return (d[kPads + k - 1] - 2.0 * d[kPads + k] + d[kPads + k + 1]) / (step * step);
    });
}

DesignNumbers DesignCases::of_results(const io::CaseFile& file, const io::RunResult& run) const {
  DesignNumbers out(quantities_.size());
  for (std::size_t q = 0; q < quantities_.size(); ++q) {
    const Asked& of = quantities_[q];
    if (of.kind == Kind::contact)
      for (std::size_t p = 0; p < file.cases.size(); ++p) {
        std::vector<io::CaseDerivatives::Number> known;
        const auto found = ranges::find(run.cases, file.cases[p].number, &io::CaseResult::number);
        if (found != run.cases.end() && found->status == Status::ok)
          for (auto& [name, value] : smooth_numbers(*found)) known.push_back({name, value, {}});
        take_contact(of, p, known, out[q]);
      }
    if (of.kind != Kind::conicity) continue;
    SurfaceStore store;
    for (const BodyPair& pair : pairs_) {
      const io::WheelRailCase& input = input_of(file.cases[pair.position]);
      for (const double value : conicities(input, geometry_of(input, store, regions_), of.amplitudes))
        out[q].push_back({value, pair.weight, {}});
    }
  }
  return out;
}

io::CaseFile DesignCases::written(const std::vector<double>& design, const std::filesystem::path& folder) {
  if (remakes_) store_.emplace();
  io::CaseFile out = cases_;
  out.path = folder / "designed.toml";
  for (std::size_t p = 0; p < out.cases.size(); ++p) out.cases[p] = case_of(p, design);
  if (!file_.depth) return out;
  const Body body = file_.depth->body;
  const wheelrail::Geometry changed = geometry(0, design);
  NaturalSurface made;
  made.surface = surface_of(changed, body);
  made.spec.body = body;
  made.spec.nominal_radius = profile_radius(input_of(out.cases[0]), body);
  made.spec.shape = SliceSet{};  // known no longer: sampled from the surface
  const bool rail = body == Body::rail;
  io::GeometryFile file;
  if (rail ? changed.prismatic_rail : changed.round_wheel) {
    file.file = folder / (rail ? "rail.csv" : "wheel.csv");
    file.options.placement = io::ProfileOptions::Placement::as_in_file;
    file.options.smoothing = {};
    write_section(made, file.file);
  } else {
    constexpr double kSamples = 1e-3, kAlong = 0.3;  // [m]
    file.file = folder / (rail ? "rail.slcs" : "wheel.slcw");
    ConvertSettings how;
    how.resolution = kSamples;
    if (rail) {
      how.range_x = {kInfinity, -kInfinity};
      for (const io::Case& c : out.cases) {
        how.range_x->first = std::min(how.range_x->first, input_of(c).state.position.x - kAlong);
        how.range_x->second = std::max(how.range_x->second, input_of(c).state.position.x + kAlong);
      }
    }
    write_surface(made, file.file, how);
  }
  for (io::Case& c : out.cases) {
    auto& input = std::get<io::WheelRailCase>(c.content);
    io::SurfaceSource& source = rail ? input.rail : input.wheel;
    io::SurfaceSource now;
    now.geometry = file;
    if (is_sampled(source)) now.backend = source.backend, now.resolution = source.resolution;  // no formula any more
    now.where = source.where;
    source = std::move(now);
  }
  return out;
}

}  // namespace treadmark::app
