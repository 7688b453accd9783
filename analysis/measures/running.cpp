// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/running.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>

#include <fmt/format.h>

#include "treadmark/analysis/measures/comfort.hpp"
#include "treadmark/analysis/measures/signal.hpp"
#include "treadmark/analysis/measures/spectrum.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/damage/named_laws.hpp"

namespace treadmark::measures {
namespace {

constexpr double kRunStep = 1e-3;                              // [s]
constexpr double kForceCorner = 20.0;                          // [Hz]
constexpr double kSafetyCorner = 6.0, kFrameCorner = 10.0;     // [Hz]
constexpr double kRideLow = 0.4, kRideHigh = 10.0;             // [Hz]
constexpr double kWeightingLow = 0.4, kWeightingHigh = 100.0;  // [Hz]
constexpr double kSwayLow = 0.4, kSwayHigh = 15.0;             // [Hz], where sway is looked for
constexpr double kSwayHalfBand = 2.0;                          // [Hz]
constexpr double kMeansWidth = 2.0, kMeansStep = 0.5;          // [m]
constexpr double kSwayWidth = 100.0, kSwayStep = 10.0;         // [m]
constexpr std::size_t kComfortWindow = 5000;                   // samples
constexpr std::size_t kSecond = 1000, kAfterCurve = 1600;      // samples
constexpr double kLowShare = 0.0015, kHighShare = 0.9985, kComfortShare = 0.95;
constexpr double kStepsOfPeriod = 8.0;  // of the record, that a period of a filter needs
constexpr double kUnloaded = 0.01;      // of the load at rest

enum class Subject {
  wheel,
  loaded_wheel,  // with a load at rest
  worn_wheel,
  law,
  wheelset,
  longitudinal,
  lateral,
  vertical,
  passenger,  // all directions
  transition  // lateral and roll
};
enum class Value { high, magnitude, middle, mean, rms, comfort, greatest, largest };
enum class Samples {
  q,               // low-passed
  y_outward,       // low-passed
  unloading,       // low-passed, of the load at rest
  ratio_means,     // sliding means of the ratio of both
  sum_means,       // sliding means of the low-passed sum
  sum_sway,        // sliding root mean squares of the sum about its strongest frequency
  sway_frequency,  // that frequency
  wear,            // as they are
  safety,
  frame,         // low-passed accelerations
  ride,          // band-passed ones
  weighted,      // by ISO 8041
  five_seconds,  // root mean squares of these
  second_means,
  second_changes,
  roll_means,
  discomfort,  // what follows from these
  unfiltered
};

struct QuantityRow {
  QuantityInfo info;
  Subject subject;
  Samples samples;
  Value value;
  std::optional<SectionKind> section = {};  // the only kind it is asked of
  std::optional<PointKind> point = {};
};

constexpr const char* kLarger = "larger of |0.15 %| and |99.85 %|";
constexpr const char* kOfComfort = "EN 12299 as the literature quotes it, from memory (not verified against its text)";

/// The one place of quantities, but for those of named laws; limits: model/vehicle/running_limits.cpp.
const QuantityRow kRows[] = {
    {{"Q", "N", "vertical wheel force, low pass 20 Hz", "99.85 %"}, Subject::wheel, Samples::q, Value::high},
    {{"Q_qst", "N", "quasi-static vertical wheel force in curves, low pass 20 Hz", "50 %"},
     Subject::wheel,
     Samples::q,
     Value::middle,
     SectionKind::curve},
    {{"dQ_Q", "1", "unloading of a wheel, of its load at rest, low pass 20 Hz", "greatest"},
     Subject::loaded_wheel,
     Samples::unloading,
     Value::greatest},
    {{"Y", "N", "guiding force, positive outwards, low pass 20 Hz", kLarger},
     Subject::wheel,
     Samples::y_outward,
     Value::magnitude},
    {{"Y_qst", "N", "quasi-static guiding force in curves, positive outwards, low pass 20 Hz", "|50 %|"},
     Subject::wheel,
     Samples::y_outward,
     Value::middle,
     SectionKind::curve},
    {{"YQ_2m", "1", "Y/Q, positive outwards, low pass 20 Hz, mean over 2 m", kLarger},
     Subject::wheel,
     Samples::ratio_means,
     Value::magnitude},
    {{"Tgamma", "J/m", "wear number: power of friction over speed", "mean"},
     Subject::worn_wheel,
     Samples::wear,
     Value::mean},
    {{"sumY_2m", "N", "sum of the guiding forces of a wheelset, positive to the right, low pass 20 Hz, mean over 2 m",
      kLarger},
     Subject::wheelset,
     Samples::sum_means,
     Value::magnitude},
    {{"sumY_rms", "N",
      "sum of the guiding forces of a wheelset within 2 Hz of its strongest frequency, root mean square over 100 m",
      "greatest"},
     Subject::wheelset,
     Samples::sum_sway,
     Value::greatest},
    {{"f_sumY", "Hz", "strongest frequency of that sum from 0.4 to 15 Hz", "mean"},
     Subject::wheelset,
     Samples::sway_frequency,
     Value::mean},
    {{"ay_safety", "m/s2", "lateral acceleration of the car body, low pass 6 Hz", kLarger},
     Subject::lateral,
     Samples::safety,
     Value::magnitude,
     {},
     PointKind::car_body},
    {{"ay_ride", "m/s2", "lateral acceleration of the car body, band pass 0.4 to 10 Hz", kLarger},
     Subject::lateral,
     Samples::ride,
     Value::magnitude,
     {},
     PointKind::car_body},
    {{"az_ride", "m/s2", "vertical acceleration of the car body, band pass 0.4 to 10 Hz", kLarger},
     Subject::vertical,
     Samples::ride,
     Value::magnitude,
     {},
     PointKind::car_body},
    {{"ay_Wd", "m/s2", "lateral acceleration of the car body, weighted by Wd of ISO 8041", "root mean square"},
     Subject::lateral,
     Samples::weighted,
     Value::rms,
     {},
     PointKind::car_body},
    {{"az_Wb", "m/s2", "vertical acceleration of the car body, weighted by Wb of ISO 8041", "root mean square"},
     Subject::vertical,
     Samples::weighted,
     Value::rms,
     {},
     PointKind::car_body},
    {{"ax_P95", "m/s2", "longitudinal acceleration of the car body, weighted by Wd, root mean squares over 5 s", "95 %",
      kOfComfort},
     Subject::longitudinal,
     Samples::five_seconds,
     Value::comfort,
     {},
     PointKind::car_body},
    {{"ay_P95", "m/s2", "lateral acceleration of the car body, weighted by Wd, root mean squares over 5 s", "95 %",
      kOfComfort},
     Subject::lateral,
     Samples::five_seconds,
     Value::comfort,
     {},
     PointKind::car_body},
    {{"az_P95", "m/s2", "vertical acceleration of the car body, weighted by Wb, root mean squares over 5 s", "95 %",
      kOfComfort},
     Subject::vertical,
     Samples::five_seconds,
     Value::comfort,
     {},
     PointKind::car_body},
    {{"N_MV", "1", "mean comfort of the three, 6 times the root of the sum of their squares", "of their 95 %",
      kOfComfort},
     Subject::passenger,
     Samples::five_seconds,
     Value::comfort,
     {},
     PointKind::car_body},
    {{"ay_1s", "m/s2", "lateral acceleration of the car body until 1.6 s behind a transition, mean over 1 s",
      "largest magnitude", kOfComfort},
     Subject::transition,
     Samples::second_means,
     Value::largest,
     SectionKind::transition,
     PointKind::car_body},
    {{"jerk_1s", "m/s3", "its change within 1 s, from 1 s before the transition on", "largest magnitude", kOfComfort},
     Subject::transition,
     Samples::second_changes,
     Value::largest,
     SectionKind::transition,
     PointKind::car_body},
    {{"roll_1s", "rad/s", "rate of roll of the car body on a transition, mean over 1 s", "largest magnitude",
      kOfComfort},
     Subject::transition,
     Samples::roll_means,
     Value::largest,
     SectionKind::transition,
     PointKind::car_body},
    {{"P_CT_standing", "%", "passengers who find the transition uncomfortable, standing", "of the three",
      "Harborough 1986; EN 12299 as the literature quotes it, from memory (not verified against their text)"},
     Subject::transition,
     Samples::discomfort,
     Value::mean,
     SectionKind::transition,
     PointKind::car_body},
    {{"P_CT_seated", "%", "passengers who find the transition uncomfortable, seated", "of the three",
      "Harborough 1986; EN 12299 as the literature quotes it, from memory (not verified against their text)"},
     Subject::transition,
     Samples::discomfort,
     Value::mean,
     SectionKind::transition,
     PointKind::car_body},
    {{"ay_frame", "m/s2", "lateral acceleration of the bogie frame, low pass 10 Hz", kLarger},
     Subject::lateral,
     Samples::frame,
     Value::magnitude,
     {},
     PointKind::bogie_frame},
    {{"ay_box", "m/s2", "lateral acceleration of the axle box, not filtered", "root mean square"},
     Subject::lateral,
     Samples::unfiltered,
     Value::rms,
     {},
     PointKind::axle_box},
    {{"az_box", "m/s2", "vertical acceleration of the axle box, not filtered", "root mean square"},
     Subject::vertical,
     Samples::unfiltered,
     Value::rms,
     {},
     PointKind::axle_box},
};

/// kRows, and a row for each law that a wheel's T gamma and area tell.
std::span<const QuantityRow> quantity_rows() {
  static const auto all = [] {
    std::vector<QuantityRow> list(std::begin(kRows), std::end(kRows));
    for (const NamedLaw& law : named_laws()) {
      if (law.is(WearTheory::archard)) continue;
      const bool wear = std::holds_alternative<WearLaw>(law.numbers);
      const char* const meaning = wear ? "wear: volume by distance" : "fatigue: damage of a passage, 1: failure";
      const QuantityInfo info{law.name, wear ? "m3/m" : "1", meaning, "mean", law.source};
      list.push_back({info, Subject::law, Samples::wear, Value::mean});
    }
    return list;
  }();
  return all;
}

/// What samples ask of a record and of a section; 0: nothing.
struct Needs {
  double lowest = 0.0, highest = 0.0;  // corners of filters [Hz]
  double width = 0.0, step = 0.0;      // of sliding means [m]
  std::size_t window = 0;              // of means in time, samples
  std::size_t before = 0, behind = 0;  // beside the section, samples
};
Needs needs(Samples samples) {
  switch (samples) {
    case Samples::q:
    case Samples::y_outward:
    case Samples::unloading:
      return {kForceCorner, kForceCorner};
    case Samples::ratio_means:
    case Samples::sum_means:
      return {kForceCorner, kForceCorner, kMeansWidth, kMeansStep};
    case Samples::sum_sway:
    case Samples::sway_frequency:
      return {kSwayLow, kSwayHigh + kSwayHalfBand, kSwayWidth, kSwayStep};
    case Samples::safety:
      return {kSafetyCorner, kSafetyCorner};
    case Samples::frame:
      return {kFrameCorner, kFrameCorner};
    case Samples::ride:
      return {kRideLow, kRideHigh};
    case Samples::weighted:
      return {kWeightingLow, kWeightingHigh};
    case Samples::five_seconds:
      return {kWeightingLow, kWeightingHigh, 0.0, 0.0, kComfortWindow};
    case Samples::second_means:
    case Samples::second_changes:
    case Samples::roll_means:
    case Samples::discomfort:
      return {0.0, 0.0, 0.0, 0.0, kSecond, kSecond, kAfterCurve};
    case Samples::wear:
    case Samples::unfiltered:
      break;
  }
  return {};
}

/// Of a sum of guiding forces, where its spectrum is highest [Hz].
double strongest_frequency(std::vector<double> values) {
  constexpr std::size_t kLongest = 8192;  // lines 0.12 Hz apart
  std::size_t segment = kLongest;
  while (segment > values.size()) segment /= 2;
  const PowerSpectrum spectrum = power_spectrum({0.0, kRunStep, std::move(values)}, kSwayHigh, segment);
  std::size_t best = 0;
  for (std::size_t k = 0; k < spectrum.density.size(); ++k) {
    const double frequency = spectrum.line * static_cast<double>(k);
    if (frequency >= kSwayLow && frequency <= kSwayHigh && (best == 0 || spectrum.density[k] > spectrum.density[best]))
      best = k;
  }
  return spectrum.line * static_cast<double>(best);
}

Subject subject_of(PointMotion motion) {
  if (motion == PointMotion::longitudinal) return Subject::longitudinal;
  return motion == PointMotion::lateral ? Subject::lateral : Subject::vertical;
}

void describe(Assessed& out, const std::vector<double>& samples, Value value) {
  out.samples = samples.size();
  const auto [least, most] = ranges::minmax(samples);
  out.least = least, out.most = most;
  out.mean = 0.0;
  for (const double v : samples) out.mean += v / static_cast<double>(samples.size());
  out.rms = rms_of(samples);
  out.low = percentile(samples, kLowShare), out.middle = percentile(samples, 0.5);
  out.high = percentile(samples, kHighShare);
  switch (value) {
    case Value::high:
      out.value = out.high;
      break;
    case Value::magnitude:
      out.value = std::max(std::fabs(out.low), std::fabs(out.high));
      break;
    case Value::middle:
      out.value = std::fabs(out.middle);
      break;
    case Value::mean:
      out.value = out.mean;
      break;
    case Value::rms:
      out.value = out.rms;
      break;
    case Value::comfort:
      out.value = percentile(samples, kComfortShare);
      break;
    case Value::greatest:
      out.value = out.most;
      break;
    case Value::largest:
      out.value = std::max(std::fabs(out.least), std::fabs(out.most));
      break;
  }
}

class Assessor {
 public:
  Assessor(const RunSignals& run, std::span<const AssessmentSection> sections, VehicleKind vehicle,
           const RunningLimits& limits)
      : run_(run), sections_(sections), vehicle_(vehicle), limits_(limits) {
    check();
    place_ = even(run.place);
    if (!run.curvature.empty()) curvature_ = even(run.curvature);
    for (const AssessmentSection& section : sections) parts_.push_back(part_of(section));
  }

  std::vector<Assessed> take() {
    for (const WheelSignal& wheel : run_.wheels) assess(wheel);
    for (std::size_t set = 0; set < run_.wheelsets.size(); ++set) assess_set(set);
    for (const PointSignal& point : run_.points) assess(point);
    for (const PointSignal& point : run_.points)
      if (point.motion == PointMotion::lateral) assess_comfort(point);
    // by section, as they were asked for
    std::vector<Assessed> sorted;
    for (std::size_t s = 0; s < sections_.size(); ++s)
      for (auto& [section, one] : found_)
        if (section == s) sorted.push_back(std::move(one));
    return sorted;
  }

 private:
  void check() const {
    const auto refuse = [](const char* what) { throw Error(ErrorKind::input_data, what); };
    const std::size_t n = run_.time.size();
    if (n < 2) refuse("the run has fewer than two instants: there is nothing to assess");
    const auto is_long = [&](const std::vector<double>& v) { return v.size() == n; };
    bool good = is_long(run_.place);
    for (const WheelSignal& w : run_.wheels)
      good = good && is_long(w.q) && is_long(w.y) && (w.wear.empty() || is_long(w.wear)) &&
             ranges::all_of(w.laws, [&](const auto& law) { return is_long(law.second); });
    for (const PointSignal& p : run_.points) good = good && is_long(p.values);
    good = good && (run_.curvature.empty() || is_long(run_.curvature));
    if (!good) refuse("the signals of a run differ in length");
    for (std::size_t i = 1; i < n; ++i)
      if (!(run_.time[i] >= run_.time[i - 1]) || !(run_.place[i] >= run_.place[i - 1]))
        refuse("time or distance of a run decreases");
    if (!(run_.time.back() > run_.time.front())) refuse("the run takes no time");
  }

  std::vector<double> even(const std::vector<double>& values) const {
    return even_samples(run_.time, values, kRunStep).values;
  }
  std::vector<double> forces(const std::vector<double>& values) const {
    return low_passed(even(values), kRunStep, kForceCorner);
  }

  struct Part {
    std::size_t first = 0, end = 0;  // samples within
    double duration = 0.0, longest_step = 0.0, speed = 0.0;
    double radius = kInfinity;  // by the mean curvature
  };
  Part part_of(const AssessmentSection& section) const {
    Part part;
    const auto begin = ranges::lower_bound(place_, section.from), end = ranges::upper_bound(place_, section.to);
    part.first = static_cast<std::size_t>(begin - place_.begin());
    part.end = std::max(part.first, static_cast<std::size_t>(end - place_.begin()));
    part.duration = kRunStep * static_cast<double>(part.end - part.first);
    for (std::size_t i = 1; i < run_.time.size(); ++i)
      if (run_.place[i] >= section.from && run_.place[i - 1] <= section.to)
        part.longest_step = std::max(part.longest_step, run_.time[i] - run_.time[i - 1]);
    if (part.duration > 0.0) part.speed = (section.to - section.from) / part.duration;
    if (!curvature_.empty() && part.end > part.first) {
      double sum = 0.0;
      for (std::size_t i = part.first; i < part.end; ++i) sum += curvature_[i];
      part.radius = static_cast<double>(part.end - part.first) / std::fabs(sum);
    }
    return part;
  }

  AssessedStatus status_of(Samples samples, const AssessmentSection& section, const Part& part) const {
    constexpr double kSlack = 1e-3;  // [m]
    const Needs need = needs(samples);
    if (section.from < run_.place.front() - kSlack || section.to > run_.place.back() + kSlack ||
        !(section.to > section.from) || part.first < need.before || part.end + need.behind > place_.size())
      return AssessedStatus::outside;
    if (part.end < part.first + 2 || part.end - part.first < need.window ||
        (need.lowest > 0.0 && part.duration < 1.0 / need.lowest) || section.to - section.from < need.width)
      return AssessedStatus::too_short;
    if (need.highest > 0.0 && part.longest_step > 1.0 / (kStepsOfPeriod * need.highest))
      return AssessedStatus::too_coarse;
    return AssessedStatus::ok;
  }

  static std::span<const double> within(const std::vector<double>& values, std::size_t first, std::size_t end) {
    return std::span(values).subspan(first, end - first);
  }
  static std::vector<double> copied(const std::vector<double>& values, const Part& part) {
    const std::span<const double> samples = within(values, part.first, part.end);
    return {samples.begin(), samples.end()};
  }

  /// samples_in: of a section whose status is ok; none: it is too short.
  void add_by(const QuantityRow& row, const std::string& name, double load,
              const std::function<std::vector<double>(const AssessmentSection&, const Part&)>& samples_in,
              const std::function<bool(const Part&)>& unloaded = {}) {
    for (std::size_t s = 0; s < sections_.size(); ++s) {
      const AssessmentSection& section = sections_[s];
      if (row.section && section.kind != *row.section) continue;
      Assessed one{section.name, name, row.info.key};
      const Part& part = parts_[s];
      one.status = status_of(row.samples, section, part);
      if (one.status == AssessedStatus::ok && unloaded && unloaded(part)) one.status = AssessedStatus::unloaded;
      if (one.status == AssessedStatus::ok) {
        const std::vector<double> samples = samples_in(section, part);
        if (samples.empty())
          one.status = AssessedStatus::too_short;
        else
          describe(one, samples, row.value);
      }
      if (one.status == AssessedStatus::ok)
        one.limit = limit_of(limits_, row.info.key, {vehicle_, section.kind, part.radius, part.speed, load});
      found_.emplace_back(s, std::move(one));
    }
  }
  /// values: samples of the whole run.
  void add(const QuantityRow& row, const std::string& name, double load, const std::vector<double>& values,
           const std::function<bool(const Part&)>& unloaded = {}) {
    add_by(
        row, name, load,
        [&](const AssessmentSection& section, const Part& part) {
          return needs(row.samples).width > 0.0 ? sliding(row.samples, section, values) : copied(values, part);
        },
        unloaded);
  }
  std::vector<double> sliding(Samples samples, const AssessmentSection& section,
                              const std::vector<double>& values) const {
    const Needs need = needs(samples);
    // Even samples begin and end within half a step of the run's ends.
    const double from = std::max(section.from, place_.front()), to = std::min(section.to, place_.back());
    return sliding_means(place_, values, from, to, std::min(need.width, to - from), need.step).values;
  }

  double load_of(std::size_t wheelset) const {
    return wheelset < run_.wheelsets.size() ? run_.wheelsets[wheelset].load : kUnknown;
  }

  void assess(const WheelSignal& wheel) {
    const double outward = wheel.left ? -1.0 : 1.0, load = load_of(wheel.wheelset);
    const std::vector<double> q = forces(wheel.q);
    std::vector<double> y = forces(wheel.y), ratio(q.size()), unloading(q.size());
    for (std::size_t i = 0; i < q.size(); ++i) {
      y[i] *= outward;
      ratio[i] = y[i] / q[i];
      unloading[i] = 1.0 - q[i] / (0.5 * load);
    }
    const double least = kUnloaded * 0.5 * (std::isfinite(load) ? load : 2.0 * percentile(q, 0.5));
    const auto unloaded = [&](const Part& part) {
      const std::span<const double> samples = within(q, part.first, part.end);
      return std::any_of(samples.begin(), samples.end(), [&](double v) { return !(v > least); });
    };
    for (const QuantityRow& row : quantity_rows()) {
      if (row.subject == Subject::worn_wheel && !wheel.wear.empty()) add(row, wheel.name, load, even(wheel.wear));
      if (row.subject == Subject::loaded_wheel && load > 0.0) add(row, wheel.name, load, unloading);
      if (const auto law = wheel.laws.find(row.info.key); law != wheel.laws.end())
        add(row, wheel.name, load, even(law->second));
      if (row.subject != Subject::wheel) continue;
      if (row.samples == Samples::q) add(row, wheel.name, load, q);
      if (row.samples == Samples::y_outward) add(row, wheel.name, load, y);
      if (row.samples == Samples::ratio_means) add(row, wheel.name, load, ratio, unloaded);
    }
  }

  void assess_set(std::size_t set) {
    std::vector<double> sum;
    int wheels = 0;
    for (const WheelSignal& wheel : run_.wheels) {
      if (wheel.wheelset != set) continue;
      if (sum.empty()) sum.assign(wheel.y.size(), 0.0);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += wheel.y[i];
      ++wheels;
    }
    if (wheels != 2) return;
    const std::vector<double> raw = even(sum), low = low_passed(raw, kRunStep, kForceCorner);
    const auto samples_of = [&](Samples samples, const AssessmentSection& section, const Part& part) {
      if (samples == Samples::sum_means) return sliding(samples, section, low);
      const double f = strongest_frequency(copied(raw, part));
      if (samples == Samples::sway_frequency) return std::vector<double>{f};
      std::vector<double> square =
          low_passed(high_passed(raw, kRunStep, std::max(f - kSwayHalfBand, kSwayLow)), kRunStep, f + kSwayHalfBand);
      for (double& v : square) v *= v;
      std::vector<double> sway = sliding(samples, section, square);
      for (double& v : sway) v = std::sqrt(v);
      return sway;
    };
    for (const QuantityRow& row : kRows)
      if (row.subject == Subject::wheelset)
        add_by(
            row, run_.wheelsets[set].name, run_.wheelsets[set].load,
            [&](const AssessmentSection& section, const Part& part) { return samples_of(row.samples, section, part); });
  }

  static std::vector<double> weighted(PointMotion motion, const std::vector<double>& samples) {
    const Weighting weighting = motion == PointMotion::vertical ? Weighting::b : Weighting::d;
    return filtered(samples, weighting_sections(weighting, kRunStep));
  }

  void assess(const PointSignal& point) {
    if (point.motion == PointMotion::roll) return;
    const Subject subject = subject_of(point.motion);
    const std::vector<double> samples = even(point.values);
    const auto shown = [&](Samples kind) -> std::vector<double> {
      switch (kind) {
        case Samples::safety:
          return low_passed(samples, kRunStep, kSafetyCorner);
        case Samples::frame:
          return low_passed(samples, kRunStep, kFrameCorner);
        case Samples::ride:
          return low_passed(high_passed(samples, kRunStep, kRideLow), kRunStep, kRideHigh);
        case Samples::weighted:
        case Samples::five_seconds:
          return weighted(point.motion, samples);
        default:
          return samples;
      }
    };
    for (const QuantityRow& row : kRows) {
      if (row.subject != subject || row.point != point.kind) continue;
      const std::vector<double> values = shown(row.samples);
      if (row.samples == Samples::five_seconds)
        add_by(row, point.name, kUnknown, [&](const AssessmentSection&, const Part& part) {
          return window_rms(within(values, part.first, part.end), kComfortWindow);
        });
      else
        add(row, point.name, kUnknown, values);
    }
  }

  const PointSignal* signal_of(const PointSignal& point, PointMotion motion) const {
    const auto same = [&](const PointSignal& p) {
      return p.name == point.name && p.kind == point.kind && p.motion == motion;
    };
    const auto found = ranges::find_if(run_.points, same);
    return found == run_.points.end() ? nullptr : &*found;
  }

  /// What passengers feel of several motions of a point.
  void assess_comfort(const PointSignal& lateral) {
    const PointSignal* along = signal_of(lateral, PointMotion::longitudinal);
    const PointSignal* vertical = signal_of(lateral, PointMotion::vertical);
    const PointSignal* roll = signal_of(lateral, PointMotion::roll);
    for (const QuantityRow& row : kRows) {
      if (row.point != lateral.kind) continue;
      if (row.subject == Subject::passenger && along != nullptr && vertical != nullptr)
        add_mean_comfort(row, {along, &lateral, vertical});
    }
    if (roll != nullptr) add_transitions(lateral, *roll);
  }

  /// Samples are the indices of single windows, the value is that of the percentiles.
  void add_mean_comfort(const QuantityRow& row, const std::array<const PointSignal*, 3>& points) {
    std::array<std::vector<double>, 3> values;
    for (std::size_t d = 0; d < points.size(); ++d) values[d] = weighted(points[d]->motion, even(points[d]->values));
    const std::size_t first = found_.size();
    std::vector<double> comfort;
    add_by(row, points[1]->name, kUnknown, [&](const AssessmentSection&, const Part& part) {
      std::array<std::vector<double>, 3> rms;
      std::array<double, 3> p95{};
      for (std::size_t d = 0; d < values.size(); ++d) {
        rms[d] = window_rms(within(values[d], part.first, part.end), kComfortWindow);
        p95[d] = percentile(rms[d], kComfortShare);
      }
      comfort.push_back(mean_comfort(p95[0], p95[1], p95[2]));
      std::vector<double> single;
      for (std::size_t i = 0; i < rms[0].size(); ++i) single.push_back(mean_comfort(rms[0][i], rms[1][i], rms[2][i]));
      return single;
    });
    auto next = comfort.begin();
    for (std::size_t i = first; i < found_.size(); ++i)
      if (found_[i].second.status == AssessedStatus::ok) found_[i].second.value = *next++;
  }

  void add_transitions(const PointSignal& lateral, const PointSignal& roll) {
    constexpr std::size_t kHalf = kSecond / 2;
    const std::vector<double> means = centred_means(even(lateral.values), kSecond);
    const std::vector<double> rates = centred_means(even(roll.values), kSecond);
    std::vector<double> jerk(means.size(), kUnknown);
    for (std::size_t i = kHalf; i + kHalf < means.size(); ++i)
      jerk[i] = (means[i + kHalf] - means[i - kHalf]) / (kRunStep * static_cast<double>(kSecond));
    const auto known = [](std::span<const double> all) {
      std::vector<double> kept;
      for (const double v : all)
        if (std::isfinite(v)) kept.push_back(v);
      return kept;
    };
    const auto samples_of = [&](Samples samples, const Part& part) {
      if (samples == Samples::second_means) return known(within(means, part.first, part.end + kAfterCurve));
      if (samples == Samples::second_changes) return known(within(jerk, part.first - kSecond, part.end));
      return known(within(rates, part.first, part.end));
    };
    const auto largest = [&](Samples samples, const Part& part) {
      double most = 0.0;
      for (const double v : samples_of(samples, part)) most = std::max(most, std::fabs(v));
      return most;
    };
    for (const QuantityRow& row : kRows)
      if (row.subject == Subject::transition && row.point == lateral.kind)
        add_by(row, lateral.name, kUnknown, [&](const AssessmentSection&, const Part& part) {
          if (row.samples != Samples::discomfort) return samples_of(row.samples, part);
          const TransitionMotion motion{largest(Samples::second_means, part), largest(Samples::second_changes, part),
                                        largest(Samples::roll_means, part)};
          std::vector<double> percentage;
          for (const TransitionDiscomfort& posture : transition_discomforts())
            if (posture.quantity == std::string_view(row.info.key)) percentage.push_back(posture.percentage(motion));
          return percentage;
        });
  }

  const RunSignals& run_;
  std::span<const AssessmentSection> sections_;
  VehicleKind vehicle_;
  const RunningLimits& limits_;
  std::vector<double> place_, curvature_;  // curvature: empty on a straight
  std::vector<Part> parts_;                // of the sections
  std::vector<std::pair<std::size_t, Assessed>> found_;
};

}  // namespace

const char* name_of(AssessedStatus status) {
  switch (status) {
    case AssessedStatus::ok:
      return "ok";
    case AssessedStatus::outside:
      return "outside";
    case AssessedStatus::too_short:
      return "too_short";
    case AssessedStatus::too_coarse:
      return "too_coarse";
    case AssessedStatus::unloaded:
      return "unloaded";
  }
  return "";
}

const char* reason_of(AssessedStatus status) {
  switch (status) {
    case AssessedStatus::ok:
      return "";
    case AssessedStatus::outside:
      return "the run does not hold all of the section, or of what a mean needs around it";
    case AssessedStatus::too_short:
      return "the section is shorter than a mean or a filter needs";
    case AssessedStatus::too_coarse:
      return "steps of the record are too long for a filter";
    case AssessedStatus::unloaded:
      return "the wheel is nearly unloaded";
  }
  return "";
}

std::span<const QuantityInfo> assessed_quantities() {
  static const auto all = [] {
    std::vector<QuantityInfo> list;
    for (const QuantityRow& row : quantity_rows()) list.push_back(row.info);
    return list;
  }();
  return all;
}

const QuantityInfo& quantity_info(const std::string& key) {
  for (const QuantityRow& row : quantity_rows())
    if (key == row.info.key) return row.info;
  throw Error(ErrorKind::configuration, fmt::format("there is no assessed quantity {}", key));
}

double longest_record_step(const RunSignals& run) {
  double corner = run.wheels.empty() ? 0.0 : kForceCorner;
  for (const PointSignal& point : run.points)
    for (const QuantityRow& row : kRows)
      if (point.motion != PointMotion::roll && row.point == point.kind && row.subject == subject_of(point.motion))
        corner = std::max(corner, needs(row.samples).highest);
  return 1.0 / (kStepsOfPeriod * corner);
}

std::vector<Assessed> assess_run(const RunSignals& run, std::span<const AssessmentSection> sections,
                                 VehicleKind vehicle, const RunningLimits& limits) {
  return Assessor(run, sections, vehicle, limits).take();
}

}  // namespace treadmark::measures
