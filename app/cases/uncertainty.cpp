// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/case_derivatives.hpp"
#include "treadmark/app/cases/case_sequence.hpp"
#include "treadmark/app/cases/noise_of_results.hpp"
#include "treadmark/app/cases/run_parts.hpp"
#include "treadmark/app/cases/solve_cases.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

/// Solutions; of surfaces alone fewer, since their draws tell no more.
constexpr std::size_t kChecked = 8, kSamples = 200, kSurfaceSamples = 48;
constexpr double kBent = 0.3;  ///< by how much of a deviation derivatives may miss solutions, root mean square

using Numbers = std::vector<double>;

/// Of what is given: a number of the case, or heights with a factor each. All factors are independent, of deviation 1.
struct UncertainSource {
  std::string name, key;  ///< key: of a number
  double sigma = 0.0;
  std::vector<SectionHeights> heights;
  std::size_t factors() const { return key.empty() ? heights.size() : 1; }
};

using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// Numbers that may have derivatives, and after them elements in contact, as many of the size that another result has.
NamedNumbers numbers_of(const io::CaseResult& result, const io::CaseResult& other) {
  NamedNumbers out = smooth_numbers(result);
  for (std::size_t k = 0; k < std::min(result.patches.size(), other.patches.size()); ++k) {
    const io::PatchResult &patch = result.patches[k], &like = other.patches[k];
    out.emplace_back(fmt::format("patch_{}.elements.ncon", k + 1),
                     patch.ncon * patch.fields.grid.cell_area() / like.fields.grid.cell_area());
  }
  return out;
}

/// Solutions of a case with errors in what is given.
class CaseWithErrors {
 public:
  CaseWithErrors(const io::Case& c, const io::CaseResult& solved, SurfaceStore& store, const SampledRegions& regions,
                 std::size_t samples)
      : case_(c),
        solved_(solved),
        store_(store),
        regions_(regions),
        samples_(samples),
        base_(numbers_of(solved, solved)),
        smooth_(base_.size() - solved.patches.size()) {
    for (const auto& [name, value] : base_) left_open_.push_back(left_open(name, value));
    auto& input = std::get<io::WheelRailCase>(case_.content);
    const std::vector<io::UncertainInput> given = std::exchange(input.uncertainty, {});
    input.subsurface = {};
    input.history = HistoryUse::start;
    geometry_ = geometry_of(input, store_, regions_);
    for (const io::UncertainInput& one : given) add(one);
    add_noise(input);
    if (sources_.empty())
      throw Error(ErrorKind::configuration, "nothing says how well the case or its surfaces are known", {},
                  "give case.uncertainty, or leave case.error_bars out");
    for (const UncertainSource& source : sources_) factors_ += source.factors();
  }

  /// drawn: called with how many solutions are done, of a sample.
  io::CaseUncertainty found(const std::function<void(std::size_t)>& drawn) {
    by_derivatives();
    const std::size_t missed = check();
    if (missed > 0) {
      while (drawn_.size() < samples_) {
        solve_more(samples_);
        drawn(drawn_.size());
      }
      out_.samples = static_cast<int>(samples_);
    }
    from_sample();
    for (std::size_t n = 0; n < base_.size(); ++n)
      if (out_.numbers[n].sigma <= left_open_[n]) out_.numbers[n].sigma = 0.0;
    return std::move(out_);
  }

 private:
  /// A drawn solution: its factors, and its numbers with those of patches only if it has as many as the case.
  struct Drawn {
    Numbers factors, numbers;
    bool same_patches = false;
  };

  /// What a number, in the unit of files, is not known better than by which solutions are left open; what is 0 by
  /// symmetry is so beside others of its unit.
  double left_open(const std::string& name, double value) const {
    const auto unit = [](const std::string& of) { return of.substr(of.rfind('_') + 1); };
    double greatest = 0.1;
    for (const auto& [other, its] : base_)
      if (unit(other) == unit(name)) greatest = std::max(greatest, std::abs(its));
    return 1e-5 * std::abs(value) + 1e-8 * greatest;
  }

  const Surface& surface_of(Facing facing) const { return facing == Facing::up ? *geometry_.rail : *geometry_.wheel; }

  void add(const io::UncertainInput& given) {
    UncertainSource source{given.key, given.key, given.sigma, {}};
    if (given.length > 0.0) {
      source.key.clear();
      const Facing facing = given.key == "rail.shape" ? Facing::up : Facing::down;
      const Numbers places = places_across(surface_of(facing), given.length);
      for (std::size_t k = 0; k < places.size(); ++k) {
        SectionHeights one{facing, places.front(), given.length, Numbers(places.size(), 0.0)};
        one.values[k] = given.sigma / kMilli;
        source.heights.push_back(std::move(one));
      }
    }
    out_.sources.push_back({source.name, source.sigma});
    sources_.push_back(std::move(source));
  }

  /// What smoothing and import have left uncertain: draws of which the variance is the mean of squares, and what the
  /// import tells besides.
  void add_noise(const io::WheelRailCase& input) {
    constexpr double kStep = 0.25e-3;  // [m], of the knots of such errors
    const auto natural = [&](const io::SurfaceSource& source, Body body) {
      return store_.natural(source, body, profile_radius(input, body));
    };
    const NoiseOfResults noise(*natural(input.rail, Body::rail), *natural(input.wheel, Body::wheel));
    if (!noise.any()) return;
    for (const Body body : {Body::rail, Body::wheel}) {
      const Facing facing = body == Body::rail ? Facing::up : Facing::down;
      const Numbers places = places_across(surface_of(facing), kStep);
      const std::vector<Numbers> draws = noise.heights(body, solved_, places);
      if (draws.empty()) continue;
      SourceOfErrors scatter{fmt::format("noise of the {}", body_name(body)), {}};
      for (const Numbers& draw : draws) {
        SectionHeights& one = scatter.errors.emplace_back(SectionHeights{facing, places.front(), kStep, draw});
        for (double& height : one.values) height /= std::sqrt(static_cast<double>(draws.size()));
      }
      std::vector<SourceOfErrors> all = noise.sources(body, solved_, surface_of(facing));
      all.insert(all.begin(), std::move(scatter));
      for (SourceOfErrors& one : all) {
        const double sigma = kMilli * extent_of(one, places);
        out_.sources.push_back({one.name, sigma});
        sources_.push_back({one.name, {}, sigma, std::move(one.errors)});
      }
    }
  }

  void by_derivatives() {
    std::vector<std::string> keys;
    std::vector<SectionHeights> heights;
    for (const UncertainSource& source : sources_) {
      if (!source.key.empty()) keys.push_back(source.key);
      heights.insert(heights.end(), source.heights.begin(), source.heights.end());
    }
    const io::CaseDerivatives found = derivatives_by(case_, store_, regions_, keys, heights);
    for (const auto& [name, value] : base_) out_.numbers.push_back({name, value, 0.0, false, {}});
    slopes_.assign(base_.size(), Numbers(factors_, kNaN));
    why_ = found.message;
    const auto changes_surfaces = [&](std::size_t k) {
      return k >= found.parameters.size() || found.parameters[k].of_surfaces || !found.parameters[k].left_out.empty();
    };
    for (std::size_t k = 0; k < keys.size(); ++k) remakes_ = remakes_ || (changes_surfaces(k) && !store_.replaced());
    if (!why_.empty()) return;
    // keys come first there, each source in its turn here
    std::size_t key = 0, height = keys.size(), factor = 0;
    for (const UncertainSource& source : sources_)
      for (std::size_t k = 0; k < source.factors(); ++k, ++factor) {
        const std::size_t place = source.key.empty() ? height++ : key++;
        const std::string& left_out = found.parameters[place].left_out;
        if (why_.empty() && !left_out.empty()) why_ = fmt::format("by {}: {}", source.name, left_out);
        for (const io::CaseDerivatives::Number& number : found.numbers)
          for (std::size_t n = 0; n < base_.size(); ++n)
            if (base_[n].first == number.name)
              slopes_[n][factor] = number.by[place] * (source.key.empty() ? 1.0 : source.sigma);
      }
    for (std::size_t n = 0; n < base_.size(); ++n) {
      const Numbers parts = variances(n);
      double variance = 0.0;
      for (const double part : parts) variance += part;
      out_.numbers[n].sigma = std::sqrt(variance);
      for (const double part : parts) out_.numbers[n].shares.push_back(variance > 0.0 ? part / variance : kNaN);
    }
  }

  /// What each source adds to the variance of a number, by derivatives.
  Numbers variances(std::size_t n) const {
    Numbers out;
    std::size_t factor = 0;
    for (const UncertainSource& source : sources_) {
      double sum = 0.0;
      for (std::size_t k = 0; k < source.factors(); ++k, ++factor) sum += slopes_[n][factor] * slopes_[n][factor];
      out.push_back(sum);
    }
    return out;
  }

  /// Holds derivatives to solutions, and says of how many numbers a sample is needed.
  std::size_t check() {
    solve_more(kChecked);
    for (const Drawn& one : drawn_)
      if (why_.empty() && !one.same_patches)
        why_ = "contact comes or goes, or there is no solution, within what is given";
    const bool all = !why_.empty();
    out_.checked = all ? 0 : static_cast<int>(kChecked);
    std::size_t missed = 0;
    std::string first;
    for (std::size_t n = 0; n < base_.size(); ++n) {
      double squares = 0.0;
      for (const Drawn& one : drawn_) {
        double linear = base_[n].second;
        for (std::size_t k = 0; k < factors_; ++k) linear += slopes_[n][k] * one.factors[k];
        if (!one.numbers.empty()) squares += (one.numbers[n] - linear) * (one.numbers[n] - linear);
      }
      const double miss = std::sqrt(squares / static_cast<double>(kChecked));
      io::CaseUncertainty::Number& number = out_.numbers[n];
      if (n >= smooth_) {  // what has been drawn tells of counts
        number.sampled = true;
        continue;
      }
      number.sampled = all || !(miss <= std::max(kBent * number.sigma, left_open_[n]));
      if (!number.sampled) continue;
      if (missed++ == 0) first = number.name;
    }
    out_.why = all || missed == 0 ? why_
                                  : fmt::format("solutions miss the tangent of {} number{} ({}{})", missed,
                                                missed > 1 ? "s" : "", first, missed > 1 ? ", ..." : "");
    return missed;
  }

  /// Some more drawn solutions, up to a count.
  void solve_more(std::size_t count) {
    constexpr std::size_t kAtOnce = 16;  // their fields are in memory, and surfaces where each draw has its own
    SurfaceStore passing;
    io::CaseFile file;
    std::vector<std::optional<wheelrail::Geometry>> geometries;
    const std::size_t first = drawn_.size(), last = std::min(count, first + kAtOnce);
    for (std::size_t i = first; i < last; ++i) {
      Drawn& one = drawn_.emplace_back();
      for (std::size_t k = 0; k < factors_; ++k) one.factors.push_back(normal(random_));
      try {
        io::Case c = case_with(one.factors);
        geometries.emplace_back(geometry_with(c, one.factors, remakes_ ? passing : store_));
        c.number = static_cast<int>(i - first);
        c.sequence = c.number;
        c.shown = true;
        file.cases.push_back(std::move(c));
      } catch (const Error&) {  // no number can be so: a draw without contact
      }
    }
    for (const io::CaseResult& result : solve_cases(file, geometries).cases) {
      if (result.status != Status::ok) continue;
      Drawn& one = drawn_[first + static_cast<std::size_t>(result.number)];
      one.same_patches = result.patches.size() == solved_.patches.size();
      const NamedNumbers numbers = numbers_of(result, solved_);
      one.numbers.assign(base_.size(), kNaN);
      for (std::size_t n = 0; n < base_.size(); ++n)
        for (const auto& [name, value] : numbers)
          if (name == base_[n].first && (one.same_patches || !name.starts_with("patch_"))) one.numbers[n] = value;
    }
    check_cancelled();
  }

  io::Case case_with(const Numbers& factors) const {
    io::Case c = case_;
    std::size_t factor = 0;
    for (const UncertainSource& source : sources_) {
      if (!source.key.empty())  // beside an error of the same number in another row
        io::apply_override(c, fmt::format("{}={:.17g}", source.key,
                                          io::number_of(c, source.key).value() + factors[factor] * source.sigma));
      factor += source.factors();
    }
    return c;
  }

  wheelrail::Geometry geometry_with(const io::Case& c, const Numbers& factors, SurfaceStore& store) {
    wheelrail::Geometry geometry = geometry_of(std::get<io::WheelRailCase>(c.content), store, regions_);
    std::size_t factor = 0;
    for (const UncertainSource& source : sources_) {
      if (source.key.empty()) {
        auto& surface = source.heights.front().facing == Facing::up ? geometry.rail : geometry.wheel;
        surface = with_heights(surface, source.heights, std::span(factors).subspan(factor, source.factors()));
      }
      factor += source.factors();
    }
    return geometry;
  }

  void from_sample() {
    for (const Drawn& one : drawn_) out_.others += one.same_patches ? 0 : 1;
    for (std::size_t n = 0; n < base_.size(); ++n) {
      io::CaseUncertainty::Number& number = out_.numbers[n];
      if (!number.sampled) continue;
      std::vector<const Drawn*> known;
      for (const Drawn& one : drawn_)
        if (!one.numbers.empty() && std::isfinite(one.numbers[n])) known.push_back(&one);
      number.sigma = kNaN, number.shares.assign(sources_.size(), kNaN);
      if (2 * known.size() < drawn_.size()) continue;  // too few to stand for all
      const auto value = [n](const Drawn& one) { return one.numbers[n]; };
      number.sigma = std::sqrt(covariance(known, value, value));
      if (!(number.sigma > left_open_[n]) || drawn_.size() < samples_) continue;
      std::size_t factor = 0;
      for (std::size_t k = 0; k < sources_.size(); factor += sources_[k++].factors()) {
        if (sources_[k].factors() > 1 && !std::isfinite(slopes_[n][factor])) continue;
        const auto part = [&, from = factor, count = sources_[k].factors()](const Drawn& one) {
          if (count == 1) return one.factors[from];
          double sum = 0.0;
          for (std::size_t i = from; i < from + count; ++i) sum += slopes_[n][i] * one.factors[i];
          return sum;
        };
        const double both = covariance(known, part, value), own = covariance(known, part, part);
        if (own > 0.0) number.shares[k] = both * both / own / (number.sigma * number.sigma);
      }
    }
  }

  template <class A, class B>
  static double covariance(const std::vector<const Drawn*>& known, A&& a, B&& b) {
    const double count = static_cast<double>(known.size());
    double mean_a = 0.0, mean_b = 0.0, sum = 0.0;
    for (const Drawn* one : known) mean_a += a(*one) / count, mean_b += b(*one) / count;
    for (const Drawn* one : known) sum += (a(*one) - mean_a) * (b(*one) - mean_b);
    return sum / (count - 1.0);
  }

  io::Case case_;  ///< without errors, from rest
  const io::CaseResult& solved_;
  SurfaceStore& store_;
  bool remakes_ = false;  ///< a key changes surfaces
  const SampledRegions& regions_;
  std::size_t samples_;
  const NamedNumbers base_;
  std::size_t smooth_;  ///< of these, that may have derivatives
  Numbers left_open_;
  wheelrail::Geometry geometry_;
  std::vector<UncertainSource> sources_;
  std::size_t factors_ = 0;
  std::vector<Numbers> slopes_;  ///< of each number by each factor; NaN: not known
  std::string why_;
  std::vector<Drawn> drawn_;
  Random random_{20260101};
  io::CaseUncertainty out_;
};

io::CaseUncertainty uncertainty_of(const io::Case& c, const io::CaseResult& solved, SurfaceStore& store,
                                   const SampledRegions& regions, std::size_t samples,
                                   const std::function<void(std::size_t)>& drawn) {
  io::CaseUncertainty none;
  if (solved.status != Status::ok || solved.patches.empty()) {
    none.message = "the case has no solution that is ok";
    return none;
  }
  if (!starts_anew(c)) {
    none.message = "the case goes on from the one before it";
    return none;
  }
  try {
    return CaseWithErrors(c, solved, store, regions, samples).found(drawn);
  } catch (const Error& e) {
    none.message = e.what();
    return none;
  }
}

/// Whether the import of a surface of the case told more than scatter of it.
bool has_imported_errors(const io::WheelRailCase& input, SurfaceStore& store) {
  const auto has = [&](const io::SurfaceSource& source, Body body) {
    const auto errors = store.natural(source, body, profile_radius(input, body))->spec.errors;
    return errors != nullptr && (!errors->motions.empty() || !errors->fields.empty());
  };
  return has(input.rail, Body::rail) || has(input.wheel, Body::wheel);
}

}  // namespace

bool wants_error_bars(const io::Case& c) {
  const auto* input = std::get_if<io::WheelRailCase>(&c.content);
  return input != nullptr && input->error_bars != io::ErrorBars::never &&
         (!input->uncertainty.empty() || input->error_bars == io::ErrorBars::always);
}

bool may_have_error_bars(const io::CaseFile& file, SurfaceStore& store) {
  return ranges::none_of(file.cases, wants_error_bars) && ranges::any_of(file.cases, [&](const io::Case& c) {
           const auto* input = std::get_if<io::WheelRailCase>(&c.content);
           return input != nullptr && input->error_bars == io::ErrorBars::automatic &&
                  has_imported_errors(*input, store);
         });
}

void add_uncertainty(io::RunResult& result, const io::CaseFile& file, SurfaceStore& store, const Progress& progress) {
  const SampledRegions regions = sampled_regions(file);
  const std::vector<const io::Case*> c = solved_cases(file, result);
  std::size_t finished = 0;
  try {
    const CancellationScope scope(progress.stop);
    for (std::size_t i = 0; i < result.cases.size(); ++i) {
      io::CaseResult& solved = result.cases[i];
      if (!wants_error_bars(*c[i])) continue;
      check_cancelled();
      const bool of_surfaces = std::get<io::WheelRailCase>(c[i]->content).uncertainty.empty();
      const std::size_t samples = of_surfaces ? kSurfaceSamples : kSamples;
      const auto tell = [&](const std::string& more) {
        if (progress.report)
          progress.report(finished, result.cases.size(), fmt::format("uncertainty of case {}{}", solved.number, more));
      };
      solved.uncertainty = uncertainty_of(*c[i], solved, store, regions, samples, [&](std::size_t drawn) {
        tell(fmt::format(", {} of {} solutions", drawn, samples));
      });
      ++finished;
      tell("");
    }
  } catch (const Cancelled&) {  // the cases themselves are whole
    result.complete = false;
  }
}

}  // namespace treadmark::app
