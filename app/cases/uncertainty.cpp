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
#include "treadmark/core/random.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

constexpr std::size_t kChecked = 8, kSamples = 200;  ///< solutions
constexpr double kBent = 0.3;  ///< by how much of a deviation derivatives may miss solutions, root mean square

using Numbers = std::vector<double>;

/// Of what is given: a number of the case, or heights with a factor each. All factors are independent, of deviation 1.
struct UncertainSource {
  std::string name, key;  ///< key: of a number
  double sigma = 0.0;
  std::vector<SectionHeights> heights;
  std::size_t factors() const { return key.empty() ? heights.size() : 1; }
};

/// y of places over all of a surface.
Numbers places_across(const Surface& surface, double step) {
  constexpr double kFar = 0.2;  // [m], of bounds that may be infinite
  constexpr std::size_t kMost = 2000;
  const Box3 box = surface.bounds();
  const double from = std::max(box.min.y(), -kFar), to = std::min(box.max.y(), kFar);
  const auto count = to_whole<std::size_t>(std::ceil(std::max(0.0, to - from) / step)) + 2;
  if (count > kMost)
    throw Error(ErrorKind::configuration, fmt::format("errors of heights {:g} mm apart are too many", kMilli * step),
                {}, "give a greater case.uncertainty.length_mm");
  Numbers out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(from + static_cast<double>(k) * step);
  return out;
}

/// Solutions of a case with errors in what is given.
class CaseWithErrors {
 public:
  CaseWithErrors(const io::Case& c, const io::CaseResult& solved, SurfaceStore& store, const SampledRegions& regions)
      : case_(c), solved_(solved), store_(store), regions_(regions), base_(smooth_numbers(solved)) {
    for (const auto& [name, value] : base_) left_open_.push_back(left_open(name, value));
    auto& input = std::get<io::WheelRailCase>(case_.content);
    const std::vector<io::UncertainInput> given = std::exchange(input.uncertainty, {});
    input.subsurface = {};
    input.history = HistoryUse::start;
    geometry_ = geometry_of(input, store_, regions_);
    for (const io::UncertainInput& one : given) add(one);
    add_noise(input);
    for (const UncertainSource& source : sources_) factors_ += source.factors();
  }

  /// drawn: called with how many solutions are done, of a sample.
  io::CaseUncertainty found(const std::function<void(std::size_t)>& drawn) {
    by_derivatives();
    const std::size_t missed = check();
    if (missed > 0) {
      while (drawn_.size() < kSamples) {
        solve_more(kSamples);
        drawn(drawn_.size());
      }
      from_sample();
      out_.samples = static_cast<int>(kSamples);
    }
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

  /// What smoothing and import have left uncertain: draws of which the variance is the mean of squares.
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
      UncertainSource source{fmt::format("noise of the {}", body_name(body)), {}, 0.0, {}};
      double squares = 0.0;
      for (const Numbers& draw : draws) {
        SectionHeights one{facing, places.front(), kStep, draw};
        for (double& height : one.values) {
          height /= std::sqrt(static_cast<double>(draws.size()));
          squares += height * height;
        }
        source.heights.push_back(std::move(one));
      }
      source.sigma = kMilli * std::sqrt(squares / static_cast<double>(places.size()));
      out_.sources.push_back({source.name, source.sigma});
      sources_.push_back(std::move(source));
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
    constexpr std::size_t kAtOnce = 16;  // their fields are in memory
    io::CaseFile file;
    std::vector<std::optional<wheelrail::Geometry>> geometries;
    const std::size_t first = drawn_.size(), last = std::min(count, first + kAtOnce);
    for (std::size_t i = first; i < last; ++i) {
      Drawn& one = drawn_.emplace_back();
      for (std::size_t k = 0; k < factors_; ++k) one.factors.push_back(normal());
      try {
        io::Case c = case_with(one.factors);
        geometries.emplace_back(geometry_with(c, one.factors));
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
      const auto numbers = smooth_numbers(result);
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

  wheelrail::Geometry geometry_with(const io::Case& c, const Numbers& factors) {
    wheelrail::Geometry geometry = geometry_of(std::get<io::WheelRailCase>(c.content), store_, regions_);
    std::size_t factor = 0;
    for (const UncertainSource& source : sources_) {
      if (source.key.empty()) {
        SectionHeights sum = source.heights.front();
        std::fill(sum.values.begin(), sum.values.end(), 0.0);
        for (std::size_t k = 0; k < source.heights.size(); ++k)
          for (std::size_t i = 0; i < sum.values.size(); ++i)
            sum.values[i] += factors[factor + k] * source.heights[k].values[i];
        geometry = with_heights(std::move(geometry), sum, 1.0);
      }
      factor += source.factors();
    }
    return geometry;
  }

  /// Of the standard normal distribution (Box and Muller 1958).
  double normal() {
    const double size = std::sqrt(-2.0 * std::log(1.0 - random_.uniform()));
    return size * std::cos(2.0 * kPi * random_.uniform());
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
      if (2 * known.size() < kSamples) continue;  // too few to stand for all
      const auto value = [n](const Drawn& one) { return one.numbers[n]; };
      number.sigma = std::sqrt(covariance(known, value, value));
      if (!(number.sigma > left_open_[n])) continue;
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
  const SampledRegions& regions_;
  const std::vector<std::pair<std::string, double>> base_;
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
                                   const SampledRegions& regions, const std::function<void(std::size_t)>& drawn) {
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
    return CaseWithErrors(c, solved, store, regions).found(drawn);
  } catch (const Error& e) {
    none.message = e.what();
    return none;
  }
}

}  // namespace

void add_uncertainty(io::RunResult& result, const io::CaseFile& file, SurfaceStore& store, const Progress& progress) {
  const SampledRegions regions = sampled_regions(file);
  auto c = file.cases.begin();
  std::size_t finished = 0;
  try {
    const CancellationScope scope(progress.stop);
    for (io::CaseResult& solved : result.cases) {
      while (c->number != solved.number) ++c;
      const auto* input = std::get_if<io::WheelRailCase>(&c->content);
      if (input == nullptr || input->uncertainty.empty()) continue;
      check_cancelled();
      const auto tell = [&](const std::string& more) {
        if (progress.report)
          progress.report(finished, result.cases.size(), fmt::format("uncertainty of case {}{}", solved.number, more));
      };
      solved.uncertainty = uncertainty_of(*c, solved, store, regions, [&](std::size_t drawn) {
        tell(fmt::format(", {} of {} solutions", drawn, kSamples));
      });
      ++finished;
      tell("");
    }
  } catch (const Cancelled&) {  // the cases themselves are whole
    result.complete = false;
  }
}

}  // namespace treadmark::app
