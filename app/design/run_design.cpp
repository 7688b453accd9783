// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/design/run_design.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/cases/output_files.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/simulation/study_identity.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/never_cancelled.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/files/part_log.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/solvers/optimisation/minimise.hpp"

namespace treadmark::app {
namespace {

constexpr double kKept = 1e-4;         ///< violation of limits that counts as none
constexpr double kCheckStep = 2e-3;    ///< share of the ranges
constexpr double kDisagreement = 0.1;  ///< of a derivative and a difference, beyond which there is a warning
constexpr double kNoChange = 0.05;     ///< of a number over the whole way, which is no change to be held to
constexpr double kCancelled = 1e-3;    ///< of what a derivative is the sum of, where rounding and noise are all of it
constexpr double kAsWritten = 0.02;    ///< by which numbers of the surface that was written may differ
constexpr double kSmall = 0.1;         ///< of the largest of a quantity, below which a number is held to that

constexpr const char* kSurfaceFiles[] = {"rail.csv", "wheel.csv", "rail.slcs", "wheel.slcw"};

/// No more solutions are allowed.
struct Spent {};

std::string identity_of(const io::DesignFile& file, const DesignOptions& options) {
  std::string text = study_identity(file.positions) + fmt::format("design {}\n", file.positions.sha256);
  for (const std::string& setting : options.settings)  // a search may go on with more solutions
    if (!setting.starts_with("design.solutions=")) text += fmt::format("  set {}\n", setting);
  return text;
}

double scale_of(double size) { return size > 0.0 ? size : 1.0; }

/// The largest size of numbers that are known.
double size_of(const std::vector<DesignNumber>& numbers) {
  double most = 0.0;
  for (const DesignNumber& n : numbers)
    if (std::isfinite(n.value)) most = std::max(most, std::fabs(n.value));
  return most;
}

/// A goal on its way: its value, and how it becomes a part of the sum.
struct GoalTerm {
  const io::DesignGoal* goal;
  std::size_t quantity = 0;
  double scale = 1.0;

  /// Of the numbers of a design; NaN: none is known. by: its gradient, of a mean.
  double value(const std::vector<DesignNumber>& numbers, std::vector<double>* by = nullptr) const {
    double sum = 0.0, weights = 0.0, largest = kNaN;
    for (const DesignNumber& n : numbers) {
      if (!std::isfinite(n.value)) continue;
      if (!(largest >= n.value)) largest = n.value;
      weights += n.weight;
    }
    if (goal->largest) return largest / scale;
    for (const DesignNumber& n : numbers) {
      if (!std::isfinite(n.value) || n.weight == 0.0) continue;
      const double share = n.weight / weights, missed = (n.value - goal->target.value_or(0.0)) / scale;
      sum += share * (goal->target ? missed * missed : missed);
      if (by == nullptr) continue;
      by->resize(n.by.size(), 0.0);
      for (std::size_t v = 0; v < n.by.size(); ++v)
        (*by)[v] += share * (goal->target ? 2.0 * missed : 1.0) * n.by[v] / scale;
    }
    return weights > 0.0 ? sum : kNaN;
  }
};

/// A limit as numbers that should not be above 0.
struct LimitTerm {
  std::size_t quantity = 0;
  double bound = 0.0, sign = 1.0, scale = 1.0;

  double above(const DesignNumber& n) const { return sign * (n.value - bound) / scale; }
};

class DesignRun {
 public:
  DesignRun(const io::DesignFile& file, const DesignOptions& options, const Progress& progress)
      : file_(file),
        options_(options),
        progress_(progress),
        cases_(file),
        log_(options.folder / "design.parts", identity_of(file, options)) {
    each_ = std::max<std::size_t>(1, cases_.solutions());
    if (each_ > static_cast<std::size_t>(file.solutions))
      throw Error(ErrorKind::configuration, fmt::format("{} solutions are too few for {} cases", file.solutions, each_),
                  {file.positions.path.string()},
                  "set design.solutions to some twenty times as many as there are cases");
    for (const DesignVariable& v : cases_.variables()) start_.push_back((v.given - v.from) / (v.to - v.from));
  }

  DesignResult run() {
    begin_result();
    try {
      search();
      write_best();
      check_derivatives();
      run_before_and_after();
    } catch (const Cancelled&) {
      out_.status = "interrupted";
      out_.message = "the same command goes on";
      const NeverCancelled whole;
      write_best();
    }
    out_.solutions = tried_ * cases_.solutions();
    out_.check_solutions = checked_ * cases_.solutions();
    return std::move(out_);
  }

 private:
  void begin_result() {
    out_.version = version();
    out_.git = git_revision();
    out_.title = file_.positions.title;
    out_.input_file = file_.positions.path.string();
    out_.input_sha256 = file_.positions.sha256;
    out_.settings = options_.settings;
    out_.inputs = io::inputs_of(file_.positions);
    out_.method = file_.method == io::DesignFile::Method::mma ? "mma" : "slsqp";
    out_.cases = cases_.given().cases.size();
    out_.variables = cases_.variables();
    out_.status = "interrupted";
    out_.conicity_differenced = ranges::any_of(file_.goals, [](const auto& g) { return g.of.name == "conicity"; }) ||
                                ranges::any_of(file_.limits, [](const auto& l) { return l.of.name == "conicity"; });
  }

  /// Numbers of a design, from the folder where it was tried before. Nothing: it has no solution, failed says why.
  /// Errors: those of the folder, which are no property of a design.
  std::optional<DesignNumbers> numbers_at(const std::vector<double>& design, std::string& failed) {
    const std::size_t part = asked_++;
    if (log_.has(part))
      if (std::optional<DesignNumbers> known = kept(part, design)) return known;
    std::optional<DesignNumbers> found;
    try {
      found = cases_.at(design);
    } catch (const Error& e) {
      if (tried_ == 0) throw;  // the base itself
      failed = e.message();
      return std::nullopt;
    }
    if (!log_.has(part)) keep(part, design, *found);
    return found;
  }

  void keep(std::size_t part, const std::vector<double>& design, const DesignNumbers& numbers) {
    ByteWriter bytes;
    bytes.put(design);
    for (const std::vector<DesignNumber>& list : numbers) {
      bytes.put(list.size());
      for (const DesignNumber& n : list) {
        bytes.put(n.value);
        bytes.put(n.weight);
        bytes.put(n.by);
      }
    }
    log_.add(part, bytes.bytes());
  }

  std::optional<DesignNumbers> kept(std::size_t part, const std::vector<double>& design) const {
    const std::vector<std::byte> content = log_.content(part);
    ByteReader bytes(content);
    std::vector<double> tried;
    bytes.get(tried);
    if (tried != design) return std::nullopt;
    DesignNumbers out(cases_.quantities());
    for (std::vector<DesignNumber>& list : out) {
      list.resize(bytes.get<std::size_t>());
      for (DesignNumber& n : list) {
        bytes.get(n.value);
        bytes.get(n.weight);
        bytes.get(n.by);
      }
    }
    return out;
  }

  /// A design that is tried. Nothing: it has no solution.
  const DesignNumbers* try_design(const std::vector<double>& design) {
    if (tried_ > 0 && design == last_) return last_numbers_ ? &*last_numbers_ : nullptr;
    if ((tried_ + 1) * each_ > static_cast<std::size_t>(file_.solutions)) throw Spent{};
    DesignStep step;
    last_numbers_ = numbers_at(design, step.failed);
    last_ = design;
    step.design = static_cast<int>(++tried_);
    step.solutions = tried_ * cases_.solutions();
    if (tried_ == 1) {
      first_numbers_ = *last_numbers_;
      settle_scales(first_numbers_);
    }
    if (last_numbers_) judge(design, *last_numbers_, step);
    out_.history.push_back(std::move(step));
    if (progress_.report)
      progress_.report(tried_ * each_, static_cast<std::size_t>(file_.solutions), fmt::format("design {}", tried_));
    return last_numbers_ ? &*last_numbers_ : nullptr;
  }

  void judge(const std::vector<double>& design, const DesignNumbers& numbers, DesignStep& step) {
    step.objective = 0.0;
    for (const GoalTerm& term : goals_) step.objective += term.goal->weight * term.value(numbers[term.quantity]);
    step.violation = 0.0;
    for (const LimitTerm& term : limits_)
      for (const DesignNumber& n : numbers[term.quantity])
        if (std::isfinite(n.value)) step.violation = std::max(step.violation, term.above(n));
    const bool keeps = step.violation <= kKept, best_keeps = out_.violation <= kKept;
    step.best = std::isfinite(step.objective) &&
                (best_.empty() || (keeps && !best_keeps) ||
                 (keeps == best_keeps && (keeps ? step.objective < out_.best : step.violation < out_.violation)));
    if (best_.empty()) out_.start = step.objective;
    if (!step.best) return;
    best_ = design;
    best_numbers_ = numbers;
    out_.best = step.objective;
    out_.violation = step.violation;
  }

  void settle_scales(const DesignNumbers& numbers) {
    for (const io::DesignGoal& goal : file_.goals) {
      GoalTerm term{&goal, cases_.place_of(goal.of), 1.0};
      const double given = term.value(numbers[term.quantity]);
      if (!std::isfinite(given))
        throw Error(ErrorKind::configuration, fmt::format("no position has {}", goal.of.name), goal.of.where);
      term.scale = goal.scale ? *goal.scale : scale_of(std::fabs(goal.target.value_or(given)));
      goals_.push_back(term);
    }
    for (const io::DesignLimit& limit : file_.limits) {
      const std::size_t place = cases_.place_of(limit.of);
      const double usual = scale_of(size_of(numbers[place]));
      const auto add = [&](double bound, double sign) {
        limits_.push_back({place, bound, sign, bound != 0.0 ? std::fabs(bound) : usual});
      };
      if (limit.at_most) add(*limit.at_most, 1.0);
      if (limit.at_least) add(*limit.at_least, -1.0);
    }
  }

  /// Variables of the minimisation are those of the design, and one more for each largest number, which is not below
  /// any of those that it is the largest of.
  optimisation::PointValues point_of(const std::vector<double>& point, const DesignNumbers& numbers) const {
    const std::size_t n = start_.size(), all = point.size();
    optimisation::PointValues out;
    out.gradient.assign(all, 0.0);
    const auto row = [&](const DesignNumber& number, double value, double by, std::optional<std::size_t> bound) {
      const bool known = std::isfinite(number.value);
      out.constraints.push_back(known ? value : -1.0);
      const std::size_t first = out.jacobian.size();
      out.jacobian.resize(first + all, 0.0);
      if (!known) return;
      for (std::size_t v = 0; v < n; ++v) out.jacobian[first + v] = by * number.by[v];
      if (bound) out.jacobian[first + *bound] = -1.0;
    };
    std::size_t next = n;
    for (const GoalTerm& term : goals_) {
      const double weight = term.goal->weight;
      const std::vector<DesignNumber>& list = numbers[term.quantity];
      if (term.goal->largest) {
        const std::size_t bound = next++;
        out.objective += weight * point[bound];
        out.gradient[bound] = weight;
        for (const DesignNumber& number : list)
          row(number, number.value / term.scale - point[bound], 1.0 / term.scale, bound);
        continue;
      }
      std::vector<double> by(n, 0.0);
      out.objective += weight * term.value(list, &by);
      for (std::size_t v = 0; v < n; ++v) out.gradient[v] += weight * by[v];
    }
    for (const LimitTerm& term : limits_)
      for (const DesignNumber& number : numbers[term.quantity])
        row(number, term.above(number), term.sign / term.scale, std::nullopt);
    return out;
  }

  void search() {
    try_design(start_);
    const DesignNumbers& first = first_numbers_;
    remove_file(options_.folder / "design.json");  // where it stands, the other files are of its making
    write_best();                                  // what cannot be written is told before the search
    optimisation::Minimisation problem;
    problem.start = start_;
    problem.lower.assign(start_.size(), 0.0);
    problem.upper.assign(start_.size(), 1.0);
    for (const GoalTerm& term : goals_)
      if (term.goal->largest) {
        problem.constraints += first[term.quantity].size();
        problem.start.push_back(term.value(first[term.quantity]));
        problem.lower.push_back(-kInfinity);
        problem.upper.push_back(kInfinity);
      }
    for (const LimitTerm& term : limits_) problem.constraints += first[term.quantity].size();
    problem.method =
        file_.method == io::DesignFile::Method::mma ? optimisation::Method::mma : optimisation::Method::slsqp;
    problem.tolerance = file_.tolerance;
    problem.at = [&](const std::vector<double>& point) -> std::optional<optimisation::PointValues> {
      std::vector<double> design(point.begin(), point.begin() + static_cast<std::ptrdiff_t>(start_.size()));
      for (double& share : design) share = std::clamp(share, 0.0, 1.0);
      const DesignNumbers* numbers = try_design(design);
      if (numbers == nullptr || !std::isfinite(out_.history.back().objective)) return std::nullopt;
      return point_of(point, *numbers);
    };
    try {
      const Report ended = optimisation::minimise(problem).report;
      out_.status = ended.status == Status::ok ? "converged" : "stalled";
      out_.message = ended.status == Status::ok
                         ? fmt::format("the sum or what is sought changes by less than {:g}", file_.tolerance)
                         : ended.message;
      // the last step was short because a longer one ended there
      const auto before = out_.history.end() - static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, tried_));
      const auto without =
          std::find_if(before, out_.history.end(), [](const DesignStep& s) { return !std::isfinite(s.objective); });
      if (ended.status == Status::ok && without != out_.history.end()) {
        out_.status = "stalled";
        out_.message = "the next designs have no solution";
        if (!without->failed.empty()) out_.message += ": " + without->failed;
      }
    } catch (const Spent&) {
      out_.status = "limit";
      out_.message = fmt::format("{} solutions are spent: more by --set design.solutions=...", file_.solutions);
    }
    if (out_.violation > kKept) {
      out_.status = "infeasible";
      out_.message =
          fmt::format("no design keeps the limits: the best one misses one by {:.3g} of its size", out_.violation);
    }
  }

  /// The design as files, and its variables.
  void write_best() {
    if (best_.empty()) return;
    for (std::size_t v = 0; v < best_.size(); ++v) {
      DesignVariable& variable = out_.variables[v];
      variable.best = variable.from + best_[v] * (variable.to - variable.from);
    }
    out_.depth = cases_.depths(best_);
    out_.depth_y.clear();
    for (std::size_t k = 0; k < out_.depth.size(); ++k)
      out_.depth_y.push_back(file_.depth->from + static_cast<double>(k) * file_.depth->step);
    out_.numbers.clear();
    number_place_.clear();
    for (std::size_t q = 0; q < best_numbers_.size(); ++q)
      for (std::size_t i = 0; i < best_numbers_[q].size(); ++i) {
        if (!std::isfinite(best_numbers_[q][i].value) && !std::isfinite(first_numbers_[q][i].value)) continue;
        out_.numbers.push_back({cases_.name_of(q), cases_.where_of(q, i), kNaN, best_numbers_[q][i].value});
        number_place_.emplace_back(q, i);
      }
    designed_ = cases_.written(best_, options_.folder);
    write_file(designed_.path, io::case_file_text(designed_, options_.folder));
    out_.files = {"designed.toml"};
    for (const char* name : kSurfaceFiles)
      if (file_.depth && std::filesystem::exists(options_.folder / name)) out_.files.emplace_back(name);
  }

  /// A difference of second order towards the start, so that it stays within the ranges.
  void check_derivatives() {
    std::vector<double> way(start_.size());
    const auto point_to = [&](const auto& target) {
      double most = 0.0;
      for (std::size_t v = 0; v < way.size(); ++v) {
        way[v] = target(v) - best_[v];
        most = std::max(most, std::fabs(way[v]));
      }
      for (double& part : way) part /= scale_of(most);
      return most > 2.0 * kCheckStep;
    };
    if (!point_to([&](std::size_t v) { return start_[v]; }))
      if (!point_to([](std::size_t) { return 0.5; })) point_to([](std::size_t) { return 1.0; });
    std::string failed;
    const auto beside = [&](double steps) {
      std::vector<double> design = best_;
      for (std::size_t v = 0; v < design.size(); ++v) design[v] += steps * kCheckStep * way[v];
      ++checked_;
      return numbers_at(design, failed);
    };
    const std::optional<DesignNumbers> once = beside(1.0), twice = beside(2.0);
    if (!once || !twice) {
      out_.warnings.push_back("derivatives could not be held to solutions: " + failed);
      return;
    }
    out_.disagreement = 0.0;
    for (std::size_t k = 0; k < out_.numbers.size(); ++k) {
      const auto [q, i] = number_place_[k];
      hold(out_.numbers[k], best_numbers_[q][i], way, (*once)[q][i].value, (*twice)[q][i].value);
    }
    if (out_.disagreement > kDisagreement)
      out_.warnings.push_back(fmt::format(
          "derivatives and solutions disagree by up to {:.2g}: the design may not be the best one", out_.disagreement));
  }

  void hold(DesignedNumber& number, const DesignNumber& here, const std::vector<double>& way, double once,
            double twice) {
    if (!std::isfinite(here.value)) return;
    number.derivative = 0.0;
    double terms = 0.0;
    for (std::size_t v = 0; v < way.size(); ++v) {
      number.derivative += way[v] * here.by[v];
      terms += std::fabs(way[v] * here.by[v]);
    }
    number.difference = (-3.0 * here.value + 4.0 * once - twice) / (2.0 * kCheckStep);
    const double larger = std::max({std::fabs(number.derivative), std::fabs(number.difference),
                                    kNoChange * std::fabs(here.value), kCancelled * terms});
    number.disagreement = std::isfinite(number.difference)
                              ? std::fabs(number.derivative - number.difference) / scale_of(larger)
                              : 1.0;  // a patch went
    out_.disagreement = std::max(out_.disagreement, number.disagreement);
  }

  void run_before_and_after() {
    struct Side {
      const io::CaseFile& file;
      const char* folder;
      double DesignedNumber::*number;
    };
    bool known = false;
    for (const Side& side : {Side{cases_.given(), "before", &DesignedNumber::before},
                             Side{designed_, "after", &DesignedNumber::written}}) {
      SurfaceStore store;
      Progress inner;
      inner.stop = progress_.stop;
      io::RunResult run = run_cases(side.file, store, inner);
      if (!run.complete) throw Cancelled();
      add_surfaces(run, side.file, store);
      out_.notes = write_result_folder(options_.folder / side.folder, run);
      try {
        const DesignNumbers numbers = cases_.of_results(side.file, run);
        for (std::size_t k = 0; k < out_.numbers.size(); ++k) {
          const auto [q, i] = number_place_[k];
          if (i < numbers[q].size()) out_.numbers[k].*side.number = numbers[q][i].value;
        }
        known = true;
      } catch (const Error& e) {
        known = false;
        out_.warnings.push_back(fmt::format("numbers {}: {}", side.folder, e.message()));
      }
    }
    for (std::size_t k = 0; k < out_.numbers.size() && known; ++k) {
      const DesignedNumber& n = out_.numbers[k];
      const std::size_t q = number_place_[k].first;
      if (!cases_.in_results(q)) continue;
      const bool one_alone = std::isfinite(n.written) != std::isfinite(n.after);
      const double size =
          std::max({std::fabs(n.after), kSmall * size_of(best_numbers_[q]), kSmall * std::fabs(n.before)});
      if (one_alone || std::fabs(n.written - n.after) > kAsWritten * size)
        out_.warnings.push_back(fmt::format("{}, {}: {:.5g} of what was written, {:.5g} of the design", n.quantity,
                                            n.where, n.written, n.after));
    }
  }

  const io::DesignFile& file_;
  const DesignOptions& options_;
  const Progress& progress_;
  DesignCases cases_;
  io::PartLog log_;
  std::size_t each_ = 1;  ///< that a design counts of the solutions allowed
  std::vector<double> start_;
  std::vector<GoalTerm> goals_;
  std::vector<LimitTerm> limits_;
  std::size_t asked_ = 0, tried_ = 0, checked_ = 0;  ///< designs in all, of the search, and after it
  std::vector<double> last_, best_;
  std::optional<DesignNumbers> last_numbers_;
  DesignNumbers first_numbers_, best_numbers_;
  std::vector<std::pair<std::size_t, std::size_t>> number_place_;  ///< of the numbers of the result
  io::CaseFile designed_;
  DesignResult out_;
};

}  // namespace

std::vector<std::string> designed_files(const std::filesystem::path& folder) {
  std::vector<std::string> out{(folder / "designed.toml").string()};
  for (const char* name : kSurfaceFiles) out.push_back((folder / name).string());
  return out;
}

DesignResult run_design(const io::DesignFile& file, const DesignOptions& options, const Progress& progress) {
  const CancellationScope scope(progress.stop);
  return DesignRun(file, options, progress).run();
}

}  // namespace treadmark::app
