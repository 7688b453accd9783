// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/app/cases/solve_cases.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/evolve/contact_source.hpp"
#include "treadmark/app/evolve/passed_patches.hpp"
#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/simulation/study_identity.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {

std::string position_label(const io::EvolutionFile& file, const io::StudyRun& run) {
  const std::string text = label_of(file.positions, run);
  return text.empty() ? std::to_string(run.number) : text;
}

void place_along_bodies(const io::EvolutionFile& file, std::vector<PassedCase>& cases, std::size_t first,
                        std::size_t count) {
  for (const io::EvolvingBody& body : file.bodies) {
    std::vector<double> along;
    along.reserve(count);
    for (std::size_t i = first; i < first + count; ++i)
      along.push_back(place_along(std::get<io::WheelRailCase>(cases[i].given.content), body.body));
    std::vector<damage::Stretch> stretch(count);
    if (body.local) {
      try {
        stretch = stretches(along, body.body, 0.5 * body.du);
      } catch (const Error& e) {
        throw Error(e.kind(), e.message(), body.where, e.advice());
      }
    }
    for (std::size_t i = 0; i < count; ++i) cases[first + i].stretch.push_back(stretch[i]);
  }
}

void meet_rail(std::vector<RailMet>& rails, const io::WheelRailCase& input, std::shared_ptr<const Surface> rail,
               double weight) {
  RailMet met{std::move(rail), input.state.position.x, input.track.cant, placement_of(input), weight};
  const auto known = ranges::find_if(rails, [&](const RailMet& r) {
    return r.rail == met.rail && r.x == met.x && r.cant == met.cant && r.placement == met.placement;
  });
  if (known == rails.end())
    rails.push_back(std::move(met));
  else
    known->weight += weight;
}

namespace {

const io::WheelRailCase& rolling_case(const io::Case& c) { return std::get<io::WheelRailCase>(c.content); }

const io::SurfaceSource& source_of(const io::WheelRailCase& input, Body body) {
  return body == Body::wheel ? input.wheel : input.rail;
}

class CaseContacts : public ContactSource {
 public:
  explicit CaseContacts(const io::EvolutionFile& file) : file_(file) {
    all_.path = file.positions.base;
    all_.title = file.positions.title;
    int sequences = 0;
    for (const io::StudyRun& run : file.positions.runs) sequences += read(run, sequences);
    regions_ = sampled_regions(all_);
  }

  GivenBody given(const io::EvolvingBody& input) override {
    const io::WheelRailCase& first = rolling_case(all_.cases.front());
    GivenBody body;
    body.radius = profile_radius(first, input.body);
    body.surface = natural_of(first, input.body);
    body.x_min = std::numeric_limits<double>::max(), body.x_max = -body.x_min;
    for (const io::Case& c : all_.cases) {
      const io::WheelRailCase& one = rolling_case(c);
      if (natural_of(one, input.body) != body.surface)
        throw Error(
            ErrorKind::configuration,
            fmt::format("the positions have different surfaces of the {}, which evolves", body_name(input.body)),
            source_of(one, input.body).where, "what evolves is one surface; vary the other body");
      body.x_min = std::min(body.x_min, one.state.position.x);
      body.x_max = std::max(body.x_max, one.state.position.x);
    }
    return body;
  }

  PassedContacts solve(const std::vector<NaturalSurface>& surfaces, const Progress& progress) override {
    std::vector<std::pair<std::string, RepresentedSurface>> made;
    std::vector<std::optional<wheelrail::Geometry>> geometries;
    geometries.reserve(all_.cases.size());
    PassedContacts out;
    for (std::size_t i = 0; i < all_.cases.size(); ++i) {
      const io::WheelRailCase& input = rolling_case(all_.cases[i]);
      geometries.emplace_back(geometry_of(input, surfaces, made));
      meet_rail(out.rails, input, geometries.back()->rail, places_[i].weight / places_[i].beside);
    }
    Progress inner;
    inner.stop = progress.stop;
    out.run = solve_cases(all_, geometries, inner);
    if (!out.run.complete) throw Cancelled();
    for (std::size_t i = 0; i < out.run.cases.size(); ++i)
      if (const io::CaseResult& c = out.run.cases[i]; c.status != Status::ok)
        throw Error(ErrorKind::numerical,
                    fmt::format("position {}, case {}: {}{}{}", places_[i].label, places_[i].number,
                                to_string(c.status), c.message.empty() ? "" : ": ", c.message));
    out.passed = places_;
    return out;
  }

 private:
  /// How many sequences the run adds to those before it.
  int read(const io::StudyRun& run, int sequences) {
    const auto cases = std::get<io::CaseFile>(io::read_study_run(file_.positions, run));
    const std::size_t first = places_.size();
    int most = 0;
    for (const io::Case& c : cases.cases) {
      const auto* input = std::get_if<io::WheelRailCase>(&c.content);
      if (input == nullptr || input->roller)
        throw Error(ErrorKind::configuration, "an evolution needs a wheel on a rail", c.where,
                    "patches by themselves have no surface, rollers cannot evolve");
      io::Case& own = all_.cases.emplace_back(c);
      own.number = static_cast<int>(all_.cases.size());
      own.sequence = sequences + c.sequence;
      own.shown = true;
      own.element_table = 0;
      most = std::max(most, c.sequence + 1);
      places_.push_back({own,
                         position_label(file_, run),
                         run.number,
                         c.number,
                         file_.weights[static_cast<std::size_t>(run.number) - 1],
                         static_cast<int>(cases.cases.size()),
                         {}});
    }
    place_along_bodies(file_, places_, first, cases.cases.size());
    return most;
  }

  std::shared_ptr<const NaturalSurface> natural_of(const io::WheelRailCase& input, Body body) {
    io::SurfaceSource source = source_of(input, body);
    source.backend.clear();  // as given: a sampled one would be made all along
    source.resolution = 0.0;
    return store_.get(source, body, profile_radius(input, body), {}).natural;
  }

  /// The surface of a body for a case: what evolves as it is now, in the representation that the case asks for.
  wheelrail::Geometry geometry_of(const io::WheelRailCase& input, const std::vector<NaturalSurface>& surfaces,
                                  std::vector<std::pair<std::string, RepresentedSurface>>& made) {
    wheelrail::Geometry geometry;
    for (const Body body : {Body::rail, Body::wheel}) {
      const io::SurfaceSource& source = source_of(input, body);
      refuse_one_place(source, "an evolution");
      const sampling::Region& region = body == Body::wheel ? regions_.wheel : regions_.rail;
      const auto evolving = ranges::find(file_.bodies, body, &io::EvolvingBody::body);
      std::shared_ptr<const Surface> surface;
      bool constant = false;
      if (evolving == file_.bodies.end()) {
        const StoredSurface& stored = store_.get(source, body, profile_radius(input, body), region);
        surface = stored.represented.surface;
        constant = stored.constant_profile();
      } else {
        const NaturalSurface& natural = surfaces[static_cast<std::size_t>(evolving - file_.bodies.begin())];
        const std::string key = fmt::format("{} {} {:.17g}", body_name(body), source.backend, source.resolution);
        auto known = ranges::find(made, key, [](const auto& m) { return m.first; });
        if (known == made.end())
          known = made.insert(made.end(), {key, represent(natural, {source.backend, source.resolution, region})});
        surface = known->second.surface;
        constant = natural.constant_profile();
      }
      (body == Body::rail ? geometry.rail : geometry.wheel) = std::move(surface);
      (body == Body::rail ? geometry.prismatic_rail : geometry.round_wheel) = constant;
    }
    return geometry;
  }

  const io::EvolutionFile& file_;
  SurfaceStore store_;
  io::CaseFile all_;  ///< cases of all positions
  std::vector<PassedCase> places_;
  SampledRegions regions_;
};

}  // namespace

std::unique_ptr<ContactSource> case_contacts(const io::EvolutionFile& file) {
  return std::make_unique<CaseContacts>(file);
}

}  // namespace treadmark::app
