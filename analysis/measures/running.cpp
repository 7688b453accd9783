// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/running.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "treadmark/analysis/measures/signal.hpp"
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
constexpr double kMeansWidth = 2.0, kMeansStep = 0.5;          // [m]
constexpr double kLowShare = 0.0015, kHighShare = 0.9985;
constexpr double kStepsOfPeriod = 8.0;  // of the record, that a period of a filter needs
constexpr double kUnloaded = 0.01;      // of the load at rest
constexpr double kKilo = 1e3;

/// What limits depend on.
struct LimitInput {
  VehicleKind vehicle = VehicleKind::passenger;
  double load = kUnknown;   // 2 Q0 [N]
  double speed = kUnknown;  // [m/s]
};

double shifting_limit(const LimitInput& in) {
  return (in.vehicle == VehicleKind::freight ? 0.85 : 1.0) * (10.0 * kKilo + in.load / 3.0);
}
double wheel_force_limit(const LimitInput& in) {
  constexpr double kKilometrePerHour = 1.0 / 3.6;
  struct Class {
    double speed, force;
  };
  constexpr Class kClasses[] = {{160.0, 200.0}, {200.0, 190.0}, {250.0, 180.0}, {300.0, 170.0}};
  double most = 160.0;
  for (const Class& one : kClasses)
    if (in.speed <= (one.speed + 0.5) * kKilometrePerHour) {
      most = one.force;
      break;
    }
  return std::min(90.0 * kKilo + 0.5 * in.load, most * kKilo);
}
template <int thousandths>
double fixed_limit(const LimitInput&) {
  return 1e-3 * thousandths;
}
/// Freight wagons have others.
template <int thousandths>
double no_freight_limit(const LimitInput& in) {
  return in.vehicle == VehicleKind::freight ? kUnknown : 1e-3 * thousandths;
}

enum class Subject { wheel, worn_wheel, law, wheelset, lateral, vertical };
enum class Value { high, magnitude, middle, mean, rms };
enum class Samples {
  q,            // low-passed
  y_outward,    // low-passed
  ratio_means,  // sliding means of the ratio of both
  sum_means,    // sliding means of the low-passed sum
  wear,         // as they are
  safety,
  frame,     // low-passed accelerations
  ride,      // band-passed ones
  weighted,  // by ISO 8041
  unfiltered
};

struct QuantityRow {
  QuantityInfo info;
  Subject subject;
  Samples samples;
  Value value;
  double (*limit)(const LimitInput&);
  bool in_curves_only = false;
  std::optional<PointKind> point = {};
};

constexpr const char* kUic = "UIC 518, EN 14363 (not verified against their text)";

/// The one place of quantities and limits, but for those of named laws.
const QuantityRow kRows[] = {
    {{"Q", "N", "vertical wheel force, low pass 20 Hz", "99.85 %",
      "min(90 kN + Q0, 200 kN; 190, 180, 170, 160 kN above 160, 200, 250, 300 km/h)", kUic},
     Subject::wheel,
     Samples::q,
     Value::high,
     wheel_force_limit},
    {{"Q_qst", "N", "quasi-static vertical wheel force in curves, low pass 20 Hz", "50 %", "145 kN", kUic},
     Subject::wheel,
     Samples::q,
     Value::middle,
     fixed_limit<145'000'000>,
     true},
    {{"Y", "N", "guiding force, positive outwards, low pass 20 Hz", "larger of |0.15 %| and |99.85 %|", "", ""},
     Subject::wheel,
     Samples::y_outward,
     Value::magnitude,
     nullptr},
    {{"Y_qst", "N", "quasi-static guiding force in curves, positive outwards, low pass 20 Hz", "|50 %|", "60 kN", kUic},
     Subject::wheel,
     Samples::y_outward,
     Value::middle,
     fixed_limit<60'000'000>,
     true},
    {{"YQ_2m", "1", "Y/Q, positive outwards, low pass 20 Hz, mean over 2 m", "larger of |0.15 %| and |99.85 %|", "0.8",
      "UIC 518, EN 14363 for radii from 250 m on (not verified against their text)"},
     Subject::wheel,
     Samples::ratio_means,
     Value::magnitude,
     fixed_limit<800>},
    {{"Tgamma", "J/m", "wear number: power of friction over speed", "mean", "", ""},
     Subject::worn_wheel,
     Samples::wear,
     Value::mean,
     nullptr},
    {{"sumY_2m", "N", "sum of the guiding forces of a wheelset, positive to the right, low pass 20 Hz, mean over 2 m",
      "larger of |0.15 %| and |99.85 %|", "k (10 kN + 2 Q0/3), k = 1, freight 0.85",
      "Prud'homme 1967; k after UIC 518, EN 14363 (not verified against their text)"},
     Subject::wheelset,
     Samples::sum_means,
     Value::magnitude,
     shifting_limit},
    {{"ay_safety", "m/s2", "lateral acceleration of the car body, low pass 6 Hz", "larger of |0.15 %| and |99.85 %|",
      "3 m/s2, not for freight", kUic},
     Subject::lateral,
     Samples::safety,
     Value::magnitude,
     no_freight_limit<3000>,
     false,
     PointKind::car_body},
    {{"ay_ride", "m/s2", "lateral acceleration of the car body, band pass 0.4 to 10 Hz",
      "larger of |0.15 %| and |99.85 %|", "2.5 m/s2, not for freight", kUic},
     Subject::lateral,
     Samples::ride,
     Value::magnitude,
     no_freight_limit<2500>,
     false,
     PointKind::car_body},
    {{"az_ride", "m/s2", "vertical acceleration of the car body, band pass 0.4 to 10 Hz",
      "larger of |0.15 %| and |99.85 %|", "2.5 m/s2, not for freight", kUic},
     Subject::vertical,
     Samples::ride,
     Value::magnitude,
     no_freight_limit<2500>,
     false,
     PointKind::car_body},
    {{"ay_Wd", "m/s2", "lateral acceleration of the car body, weighted by Wd of ISO 8041", "root mean square", "", ""},
     Subject::lateral,
     Samples::weighted,
     Value::rms,
     nullptr,
     false,
     PointKind::car_body},
    {{"az_Wb", "m/s2", "vertical acceleration of the car body, weighted by Wb of ISO 8041", "root mean square", "", ""},
     Subject::vertical,
     Samples::weighted,
     Value::rms,
     nullptr,
     false,
     PointKind::car_body},
    {{"ay_frame", "m/s2", "lateral acceleration of the bogie frame, low pass 10 Hz", "larger of |0.15 %| and |99.85 %|",
      "", ""},
     Subject::lateral,
     Samples::frame,
     Value::magnitude,
     nullptr,
     false,
     PointKind::bogie_frame},
    {{"ay_box", "m/s2", "lateral acceleration of the axle box, not filtered", "root mean square", "", ""},
     Subject::lateral,
     Samples::unfiltered,
     Value::rms,
     nullptr,
     false,
     PointKind::axle_box},
    {{"az_box", "m/s2", "vertical acceleration of the axle box, not filtered", "root mean square", "", ""},
     Subject::vertical,
     Samples::unfiltered,
     Value::rms,
     nullptr,
     false,
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
      const QuantityInfo info{law.name, wear ? "m3/m" : "1", meaning, "mean", "", law.source};
      list.push_back({info, Subject::law, Samples::wear, Value::mean, nullptr});
    }
    return list;
  }();
  return all;
}

/// Lowest and highest corner of a filter [Hz]; 0: none.
std::pair<double, double> corners(Samples samples) {
  switch (samples) {
    case Samples::q:
    case Samples::y_outward:
    case Samples::ratio_means:
    case Samples::sum_means:
      return {kForceCorner, kForceCorner};
    case Samples::safety:
      return {kSafetyCorner, kSafetyCorner};
    case Samples::frame:
      return {kFrameCorner, kFrameCorner};
    case Samples::ride:
      return {kRideLow, kRideHigh};
    case Samples::weighted:
      return {kWeightingLow, kWeightingHigh};
    default:
      return {0.0, 0.0};
  }
}

bool means_of_windows(Samples samples) { return samples == Samples::ratio_means || samples == Samples::sum_means; }

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
  }
}

class Assessor {
 public:
  Assessor(const RunSignals& run, std::span<const AssessmentSection> sections, VehicleKind vehicle)
      : run_(run), sections_(sections), vehicle_(vehicle) {
    check();
    place_ = even(run.place);
    for (const AssessmentSection& section : sections) parts_.push_back(part_of(section));
  }

  std::vector<Assessed> take() {
    for (const WheelSignal& wheel : run_.wheels) assess(wheel);
    for (std::size_t set = 0; set < run_.wheelsets.size(); ++set) assess_set(set);
    for (const PointSignal& point : run_.points) assess(point);
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
    for (const PointSignal& p : run_.points) good = good && is_long(p.acceleration);
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
    return part;
  }

  AssessedStatus status_of(Samples samples, const AssessmentSection& section, const Part& part) const {
    constexpr double kSlack = 1e-3;  // [m]
    if (section.from < run_.place.front() - kSlack || section.to > run_.place.back() + kSlack ||
        !(section.to > section.from))
      return AssessedStatus::outside;
    const auto [lowest, highest] = corners(samples);
    if (part.end < part.first + 2 || (lowest > 0.0 && part.duration < 1.0 / lowest) ||
        (means_of_windows(samples) && section.to - section.from < kMeansWidth))
      return AssessedStatus::too_short;
    if (highest > 0.0 && part.longest_step > 1.0 / (kStepsOfPeriod * highest)) return AssessedStatus::too_coarse;
    return AssessedStatus::ok;
  }

  /// values: samples of the whole run.
  void add(const QuantityRow& row, const std::string& name, double load, const std::vector<double>& values,
           const std::function<bool(const Part&)>& unloaded = {}) {
    for (std::size_t s = 0; s < sections_.size(); ++s) {
      const AssessmentSection& section = sections_[s];
      if (row.in_curves_only && section.kind != SectionKind::curve) continue;
      Assessed one{section.name, name, row.info.key};
      const Part& part = parts_[s];
      one.status = status_of(row.samples, section, part);
      if (one.status == AssessedStatus::ok && unloaded && unloaded(part)) one.status = AssessedStatus::unloaded;
      if (one.status == AssessedStatus::ok) {
        std::vector<double> samples;
        if (means_of_windows(row.samples))
          samples = sliding_means(place_, values, section.from, section.to, kMeansWidth, kMeansStep).values;
        else
          samples.assign(values.begin() + static_cast<std::ptrdiff_t>(part.first),
                         values.begin() + static_cast<std::ptrdiff_t>(part.end));
        if (samples.empty())
          one.status = AssessedStatus::too_short;
        else
          describe(one, samples, row.value);
      }
      if (one.status == AssessedStatus::ok && row.limit) one.limit = row.limit({vehicle_, load, part.speed});
      found_.emplace_back(s, std::move(one));
    }
  }

  double load_of(std::size_t wheelset) const {
    return wheelset < run_.wheelsets.size() ? run_.wheelsets[wheelset].load : kUnknown;
  }

  void assess(const WheelSignal& wheel) {
    const double outward = wheel.left ? -1.0 : 1.0, load = load_of(wheel.wheelset);
    const std::vector<double> q = forces(wheel.q);
    std::vector<double> y = forces(wheel.y), ratio(q.size());
    for (std::size_t i = 0; i < q.size(); ++i) {
      y[i] *= outward;
      ratio[i] = y[i] / q[i];
    }
    const double least = kUnloaded * 0.5 * (std::isfinite(load) ? load : 2.0 * percentile(q, 0.5));
    const auto unloaded = [&](const Part& part) {
      return std::any_of(q.begin() + static_cast<std::ptrdiff_t>(part.first),
                         q.begin() + static_cast<std::ptrdiff_t>(part.end), [&](double v) { return !(v > least); });
    };
    for (const QuantityRow& row : quantity_rows()) {
      if (row.subject == Subject::worn_wheel && !wheel.wear.empty()) add(row, wheel.name, load, even(wheel.wear));
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
    sum = forces(sum);
    for (const QuantityRow& row : kRows)
      if (row.subject == Subject::wheelset) add(row, run_.wheelsets[set].name, run_.wheelsets[set].load, sum);
  }

  void assess(const PointSignal& point) {
    const Subject subject = point.lateral ? Subject::lateral : Subject::vertical;
    const std::vector<double> samples = even(point.acceleration);
    const auto shown = [&](Samples kind) -> std::vector<double> {
      switch (kind) {
        case Samples::safety:
          return low_passed(samples, kRunStep, kSafetyCorner);
        case Samples::frame:
          return low_passed(samples, kRunStep, kFrameCorner);
        case Samples::ride:
          return low_passed(high_passed(samples, kRunStep, kRideLow), kRunStep, kRideHigh);
        case Samples::weighted:
          return filtered(samples, weighting_sections(point.lateral ? Weighting::d : Weighting::b, kRunStep));
        default:
          return samples;
      }
    };
    for (const QuantityRow& row : kRows)
      if (row.subject == subject && row.point == point.kind) add(row, point.name, kUnknown, shown(row.samples));
  }

  const RunSignals& run_;
  std::span<const AssessmentSection> sections_;
  VehicleKind vehicle_;
  std::vector<double> place_;
  std::vector<Part> parts_;  // of the sections
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
      return "the run ends before the section does";
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
      if (row.point == point.kind && row.subject == (point.lateral ? Subject::lateral : Subject::vertical))
        corner = std::max(corner, corners(row.samples).second);
  return 1.0 / (kStepsOfPeriod * corner);
}

std::vector<Assessed> assess_run(const RunSignals& run, std::span<const AssessmentSection> sections,
                                 VehicleKind vehicle) {
  return Assessor(run, sections, vehicle).take();
}

}  // namespace treadmark::measures
