// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/measure/measure_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "treadmark/analysis/measures/bands.hpp"
#include "treadmark/app/measure/read_measured.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/number_text.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;
using measures::Measure;
using measures::Section;

constexpr double kFullCircle = 2.0 * std::numbers::pi;

/// Nominal sections, read once for all files.
struct Nominals {
  std::vector<measures::NominalWheel> wheels;
  std::optional<Section> rail;
};

Nominals read_nominals(const MeasureRequest& request) {
  Nominals out;
  if (request.nominal.empty()) return out;
  if (request.body == Body::rail) {
    out.rail = nominal_section(request.nominal, Body::rail);
    return out;
  }
  std::vector<std::string> names{request.nominal};
  std::error_code ignored;
  if (!fs::exists(request.nominal, ignored) && library_body(request.nominal)) names = thinner_flanges(request.nominal);
  for (const std::string& name : names) out.wheels.push_back({name, nominal_section(name, Body::wheel)});
  return out;
}

/// The middle one of several, with the uncertainty of one: they need not be alike.
Measure median_of(std::vector<Measure> all) {
  std::vector<Measure> known;
  for (const Measure& m : all)
    if (m.known()) known.push_back(m);
  if (known.size() * 2 < all.size() || known.empty()) {
    const auto why = std::find_if(all.begin(), all.end(), [](const Measure& m) { return !m.known(); });
    return {measures::kUnknown, measures::kUnknown, why == all.end() ? "" : why->reason};
  }
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end(),
                   [](const Measure& a, const Measure& b) { return a.value < b.value; });
  return *middle;
}

/// The doubts that most stations have, as one of them says them.
template <class Numbers>
std::vector<measured::Doubt> doubts_of_most(const std::vector<MeasuredStation<Numbers>>& stations) {
  const auto doubted = [](const auto& station) { return !station.numbers.doubts.empty(); };
  if (2 * ranges::count_if(stations, doubted) <= static_cast<std::ptrdiff_t>(stations.size())) return {};
  return ranges::find_if(stations, doubted)->numbers.doubts;
}

template <class Numbers>
Numbers median_numbers(const std::vector<MeasuredStation<Numbers>>& stations) {
  Numbers out = stations[stations.size() / 2].numbers;
  for (const auto& row : number_rows(out)) {
    std::vector<Measure> all;
    all.reserve(stations.size());
    for (const auto& station : stations) all.push_back(station.numbers.*row.at);
    out.*row.at = median_of(std::move(all));
  }
  out.doubts = doubts_of_most(stations);
  return out;
}

Section section_of(const ReadMeasured& read, const Profile& points) {
  if (!read.error) return Section(points, read.kind == "library profile" ? 0.0 : -1.0);
  Section section(points, std::isnan(*read.error) ? -1.0 : 0.0);
  section.claim_error(*read.error);
  return section;
}

constexpr double kSectionStep = 0.1e-3;  // [m]
constexpr double kHalfBand = 1e-3;       // about lines round a wheel and along a rail [m]

/// What the fit of a scan smoothed away of the scatter of means over the band and a step along it: it is still there in
/// whatever is long against the knots.
double scatter_of_points(const ReadMeasured& read, double step) {
  const double area = 2.0 * kHalfBand * step;
  return area > 0.0 ? read.point_noise * std::min(1.0, read.point_distance / std::sqrt(area)) : 0.0;
}

FittingStandard against_nominal(const WheelNumbers& n) { return {"", n.area_lost.value, n.area_gained.value}; }
FittingStandard against_nominal(const RailNumbers& n) { return {"", n.loss.value, n.lip.value}; }

/// Doubts about the nominal section, with the standard profile that fits better; and one where the section is another
/// standard profile as new.
template <class Numbers>
void tell_doubts(const Section& section, const Numbers& numbers, const std::string& nominal, MeasuredFile& out) {
  constexpr double kAsNew = 15e-6, kWorn = 3.0, kBetter = 0.5;  // [m^2]; of what another one leaves
  if (nominal.empty()) return;
  std::vector<std::string> doubts;
  for (const measured::Doubt& doubt : numbers.doubts) doubts.push_back(fmt::format("{}: {}", doubt.name, doubt.text));
  const FittingStandard own = against_nominal(numbers);
  const bool doubted = !doubts.empty(), worn = own.lost + own.gained > kWorn * kAsNew;
  if (!doubted && !worn) return;
  const auto fits = fitting_standard(section, !doubted);
  const auto areas = [](const FittingStandard& one) {
    return fmt::format("{:.3g} mm2 lost, {:.3g} mm2 beyond", 1e6 * one.lost, 1e6 * one.gained);
  };
  if (fits && doubted && !(fits->badness() > kBetter * own.badness()))
    doubts.back() += fmt::format("; laid upon it by what does not wear {} fits better: {}", fits->name, areas(*fits));
  if (fits && !doubted && fits->lost + fits->gained < kAsNew)
    doubts.push_back(
        fmt::format("nominal_profile: the section is {} as new ({}), against {} it would have {}: is it "
                    "worn, or another {}?",
                    fits->name, areas(*fits), nominal, areas(own), body_name(section.body())));
  for (const std::string& doubt : doubts) out.notes.push_back("warning: " + doubt);
  out.doubtful = out.doubtful || !doubts.empty();
}

// --- wheels

class WheelFile {
 public:
  WheelFile(const ReadMeasured& read, const MeasureRequest& request, const Nominals& nominals, MeasuredFile& out)
      : read_(read), request_(request), nominals_(nominals), out_(out) {}

  void measure() {
    const std::string one = "needs a scan of the full circumference";
    if (read_.points) {
      const Section section = section_of(read_, *read_.points);
      out_.noise = section.noise();
      numbers_ = section_numbers(section);
      draw(section, numbers_);
      tell_doubts(section, numbers_, request_.nominal, out_);
      for (Measure* m : {&numbers_.runout, &numbers_.axial_runout, &numbers_.eccentricity, &numbers_.flat_depth,
                         &numbers_.flat_length})
        m->reason = one;
      wheelset();
      out_.numbers = numbers_;
      return;
    }
    stations();
    revolution(one);
    wheelset();
    out_.numbers = numbers_;
  }

 private:
  WheelNumbers section_numbers(const Section& section) const {
    measures::WheelGauge gauge;
    gauge.from_flange_back = !request_.as_in_file;
    gauge.placed = read_.placed;
    gauge.back = read_.flange_back;
    WheelNumbers n;
    static_cast<measures::WheelMeasures&>(n) =
        measures::measure_wheel(section, gauge, read_.nominal_radius, nominals_.wheels);
    return n;
  }

  /// Both tips at one height, tape lines at y = 0.
  void draw(const Section& section, const WheelNumbers& n) const {
    for (std::size_t i = 0; i < section.size(); ++i)
      out_.section.emplace_back(section.point(i) + Vec2(n.shift_y, n.shift_z));
    if (nominals_.wheels.empty()) return;
    const Section& nominal = nominals_.wheels.front().section;
    for (std::size_t i = 0; i < nominal.size(); ++i)
      out_.nominal.emplace_back(nominal.point(i) + Vec2(0.0, n.tread_wear.known() ? n.tread_wear.value : 0.0));
  }

  /// With the other wheel, whose axes are those of this one, y from the middle of the axle.
  void wheelset() {
    Measure& between = numbers_.back_to_back;
    if (request_.mate.empty()) {
      between.reason = numbers_.active_faces.reason = "the other wheel of the axle is not given: --mate";
      return;
    }
    const measures::WheelMeasures mate = measures::measure_wheel(mirrored_section(request_.mate, request_));
    if (!numbers_.back_seen || !mate.back_seen) {
      between.reason = numbers_.active_faces.reason = "a flange back is not in its section";
      return;
    }
    // shift_y leads from the file's axes to those that have the back at -70 mm
    const double back = measures::WheelGauge{}.tape_line;
    between.value = -back - numbers_.shift_y - back - mate.shift_y;
    constexpr double kLeast = 0.4, kMost = 2.0;  // [m]
    if (!(between.value > kLeast && between.value < kMost))
      throw Error(ErrorKind::input_data,
                  fmt::format("the flange backs would lie {:.4g} mm from each other", 1e3 * between.value), {},
                  "both wheels must lie in the axes of the wheelset, y from the middle of the axle to the right");
    between.uncertainty = std::hypot(numbers_.flange_height.uncertainty, mate.flange_height.uncertainty);
    const Measure &own = numbers_.flange_thickness, &other = mate.flange_thickness;
    if (own.known() && other.known())
      numbers_.active_faces = {between.value + own.value + other.value,
                               std::hypot(between.uncertainty, own.uncertainty, other.uncertainty),
                               {}};
    else
      numbers_.active_faces.reason = own.known() ? other.reason : own.reason;
  }

  void stations() {
    const int count = read_.surface->constant_profile() ? 1 : request_.stations;
    std::optional<Error> trouble;
    std::optional<Section> middle;
    for (int i = 0; i < count; ++i) {
      const double theta = -std::numbers::pi + kFullCircle * (i + 0.5) / count;
      try {
        const Profile points = measures::section_points(*read_.surface, Body::wheel, read_.nominal_radius,
                                                        count == 1 ? 0.0 : theta, kSectionStep);
        const Section section = section_of(read_, points);
        out_.round.push_back({count == 1 ? 0.0 : theta, section_numbers(section)});
        if (out_.section.empty() && 2 * i + 1 >= count) {
          draw(section, out_.round.back().numbers);
          middle = section;
        }
      } catch (const Error& error) {
        trouble = error;
      }
    }
    if (out_.round.empty()) throw *trouble;
    if (const std::size_t lost = static_cast<std::size_t>(count) - out_.round.size(); lost > 0)
      out_.notes.push_back(fmt::format("{} of {} sections could not be measured: {}", lost, count, trouble->message()));
    numbers_ = median_numbers(out_.round);
    if (middle) tell_doubts(*middle, numbers_, request_.nominal, out_);
  }

  measures::RoundGauge gauge(std::size_t samples) const {
    measures::RoundGauge g;
    g.scatter = scatter_of_points(read_, kFullCircle * read_.nominal_radius / static_cast<double>(samples));
    return g;
  }

  /// Mean radius over a narrow band of lines, per angle.
  std::vector<double> radii(const std::vector<double>& theta, double y) const {
    std::vector<double> out(theta.size(), measures::kUnknown);
    const std::vector<double> lines{y - kHalfBand, y - 0.5 * kHalfBand, y, y + 0.5 * kHalfBand, y + kHalfBand};
    std::vector<double> r(lines.size());
    HeightsOut heights;
    heights.z = r;
    for (std::size_t i = 0; i < theta.size(); ++i) {
      section_heights(*read_.surface, Body::wheel, theta[i], lines, heights);
      double sum = 0.0;
      for (const double v : r) sum += v / static_cast<double>(r.size());
      out[i] = sum;
    }
    return out;
  }

  void revolution(const std::string& one) {
    const auto unknown = [&](const std::string& why) {
      for (Measure* m : {&numbers_.runout, &numbers_.axial_runout, &numbers_.eccentricity, &numbers_.flat_depth,
                         &numbers_.flat_length})
        *m = {measures::kUnknown, measures::kUnknown, why};
    };
    unknown(one);
    if (read_.surface->constant_profile()) return;
    constexpr std::size_t kSamples = 2048;
    std::vector<double> theta(kSamples);
    for (std::size_t i = 0; i < kSamples; ++i)
      theta[i] = -std::numbers::pi + kFullCircle * static_cast<double>(i) / kSamples;
    const double tape = -numbers_.shift_y;
    try {
      out_.theta = theta;
      out_.tape_radius = radii(theta, tape);
      out_.revolution = measures::measure_round(theta, out_.tape_radius, gauge(kSamples));
    } catch (const Error& error) {
      unknown(error.message());
      return;
    }
    const measures::RoundMeasures& round = *out_.revolution;
    const double error = 1.96 * read_.error.value_or(0.0);
    numbers_.runout = round.runout;
    numbers_.runout.uncertainty = std::hypot(numbers_.runout.uncertainty, std::numbers::sqrt2 * error);
    numbers_.eccentricity = round.eccentricity;
    if (read_.kind == "scan") {
      // order 1 is then how far the flats and scatter drew the axis
      numbers_.runout.uncertainty = std::hypot(numbers_.runout.uncertainty, 2.0 * round.eccentricity.value);
      numbers_.eccentricity = {
          measures::kUnknown, measures::kUnknown,
          "the axis is the one that fits the scanned wheel: where the bore lies is not in the scan"};
    }
    numbers_.diameter = {2.0 * round.radius, 2.0 * error, {}};
    flats(theta, tape, error);
    for (const double y : {-20e-3, 20e-3, 40e-3}) {
      const std::vector<double> r = radii(theta, tape + y);
      const auto is_gap = [](double v) { return std::isnan(v); };
      if (std::any_of(r.begin(), r.end(), is_gap)) continue;
      const auto [low, high] = std::minmax_element(r.begin(), r.end());
      out_.further_runouts.emplace_back(y, Measure{*high - *low, std::numbers::sqrt2 * error, {}});
    }
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const auto& station : out_.round)
      if (station.numbers.back_seen) {
        least = std::min(least, station.numbers.shift_y);
        most = std::max(most, station.numbers.shift_y);
      }
    if (most >= least)
      numbers_.axial_runout = {most - least, std::numbers::sqrt2 * error, {}};
    else
      numbers_.axial_runout.reason = "the flange back is not in the scan";
  }

  /// Flats of several lines of the running band: of those at one place the middle one, or the deepest where that is
  /// deeper by more than scatter makes the deepest of several.
  void flats(const std::vector<double>& theta, double tape, double error) {
    std::vector<measures::RoundFlat>& all = out_.revolution->flats;
    std::vector<std::vector<measures::RoundFlat>> places;
    const auto add = [&](const measures::RoundFlat& flat) {
      const auto same = ranges::find_if(places, [&](const std::vector<measures::RoundFlat>& place) {
        return std::fabs(std::remainder(place.front().theta - flat.theta, kFullCircle)) * out_.revolution->radius <
               std::max(place.front().length.value, flat.length.value);
      });
      (same == places.end() ? places.emplace_back() : *same).push_back(flat);
    };
    for (const measures::RoundFlat& flat : all) add(flat);
    for (const double y : {-10e-3, -5e-3, 5e-3, 10e-3, 15e-3}) {
      try {
        for (const measures::RoundFlat& flat :
             measures::measure_round(theta, radii(theta, tape + y), gauge(theta.size())).flats)
          add(flat);
      } catch (const Error&) {
        continue;  // the line leaves the surface
      }
    }
    all.clear();
    for (std::vector<measures::RoundFlat>& place : places) {
      ranges::sort(place, std::greater<>(), [](const measures::RoundFlat& f) { return f.depth.value; });
      const measures::RoundFlat &deepest = place.front(), &middle = place[place.size() / 2];
      const bool alike = deepest.depth.value - middle.depth.value <
                         std::hypot(deepest.depth.uncertainty, std::isnan(error) ? 0.0 : error);
      all.push_back(alike ? middle : deepest);
    }
    for (measures::RoundFlat& flat : all) {
      flat.depth.uncertainty = std::hypot(flat.depth.uncertainty, error);
      // an error in depth moves both ends by its part of their slope, length/(2 R)
      flat.length.uncertainty =
          std::hypot(flat.length.uncertainty, 4.0 * error * out_.revolution->radius / flat.length.value);
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.depth.value > b.depth.value; });
    if (all.empty()) {
      numbers_.flat_depth = {0.0, error, {}};
      numbers_.flat_length = {0.0, measures::kUnknown, {}};
    } else {
      numbers_.flat_depth = all.front().depth;
      numbers_.flat_length = all.front().length;
    }
  }

  const ReadMeasured& read_;
  const MeasureRequest& request_;
  const Nominals& nominals_;
  MeasuredFile& out_;
  WheelNumbers numbers_;
};

// --- rails

class RailFile {
 public:
  RailFile(const ReadMeasured& read, const MeasureRequest& request, const Nominals& nominals, MeasuredFile& out)
      : read_(read), request_(request), nominals_(nominals), out_(out) {}

  void measure() {
    if (!read_.points && !read_.surface->constant_profile() &&
        !(std::isfinite(read_.x_min) && std::isfinite(read_.x_max))) {
      read_.x_min = -kDefaultHalfLength, read_.x_max = kDefaultHalfLength;
      out_.notes.push_back(fmt::format("the rail has no ends: measured from {:g} to {:g} m", read_.x_min, read_.x_max));
    }
    if (read_.points) {
      const Section section = section_of(read_, *read_.points);
      out_.noise = section.noise();
      numbers_ = section_numbers(section);
      draw(section, numbers_);
      tell_doubts(section, numbers_, request_.nominal, out_);
      numbers_.roughness_exceedance.reason = "needs a scan along the rail";
      judge_sides();
      out_.numbers = numbers_;
      return;
    }
    stations();
    roughness();
    judge_sides();
    out_.numbers = numbers_;
  }

 private:
  RailNumbers section_numbers(const Section& section) const {
    measures::RailGauge gauge;
    gauge.alignment =
        request_.alignment.value_or(read_.placed && read_.kind != "library profile" ? measures::RailAlignment::none
                                                                                    : measures::RailAlignment::unworn);
    // a head from the library has nothing to be laid by, and lies already
    if (!request_.alignment && read_.kind == "library profile" && section.z_max() < 50e-3)
      gauge.alignment = measures::RailAlignment::none;
    RailNumbers n;
    static_cast<measures::RailMeasures&>(n) =
        measures::measure_rail(section, nominals_.rail ? &*nominals_.rail : nullptr, gauge);
    return n;
  }

  /// Metal that is missing on the field side, which does not wear, and not on the gauge side is that of a left rail.
  void judge_sides() const {
    constexpr double kMore = 1e-3, kUpon = 0.5e-3;
    const double gauge = numbers_.lost_gauge, more = numbers_.lost_field - gauge;
    if (read_.kind == "library profile" || !(more > kMore)) return;
    // a section in other axes lies aside of both sides; one that was laid on a worn side sticks out on the other one
    if (gauge < -kUpon && numbers_.alignment != measures::RailAlignment::unworn) return;
    const auto known = [](const std::string& note) { return note.starts_with("warning: gauge_side"); };
    if (ranges::any_of(out_.notes, known)) return;
    out_.notes.push_back(fmt::format(
        "warning: gauge_side: against {} the side of great y has lost {:.2g} mm more than that of small y, and field "
        "sides do not wear: is the gauge side the other one? {}; or is the nominal section another one?",
        request_.nominal, 1e3 * more, read_.kind == "profile" ? "set mirror_y = true" : "mirror it"));
    out_.doubtful = true;
  }

  /// Laid upon the nominal section as the numbers are.
  void draw(Section section, const RailNumbers& n) const {
    section.move(n.inclination.known() ? n.inclination.value : 0.0, {n.shift_y, n.shift_z});
    for (std::size_t i = 0; i < section.size(); ++i) out_.section.push_back(section.point(i));
    for (std::size_t i = 0; nominals_.rail && i < nominals_.rail->size(); ++i)
      out_.nominal.push_back(nominals_.rail->point(i));
  }

  void stations() {
    const bool one = read_.surface->constant_profile();
    const int count = one ? 1 : request_.stations;
    std::optional<Error> trouble;
    std::optional<Section> middle;
    for (int i = 0; i < count; ++i) {
      const double x = one ? 0.0 : read_.x_min + (read_.x_max - read_.x_min) * (i + 0.5) / count;
      try {
        const Profile points = measures::section_points(*read_.surface, Body::rail, 0.0, x, kSectionStep);
        const Section section = section_of(read_, points);
        out_.along.push_back({x, section_numbers(section)});
        if (out_.section.empty() && 2 * i + 1 >= count) {
          draw(section, out_.along.back().numbers);
          middle = section;
        }
      } catch (const Error& error) {
        trouble = error;
      }
    }
    if (out_.along.empty()) throw *trouble;
    if (const std::size_t lost = static_cast<std::size_t>(count) - out_.along.size(); lost > 0)
      out_.notes.push_back(fmt::format("{} of {} sections could not be measured: {}", lost, count, trouble->message()));
    numbers_ = median_numbers(out_.along);
    if (middle) tell_doubts(*middle, numbers_, request_.nominal, out_);
  }

  void roughness() {
    Measure& worst = numbers_.roughness_exceedance;
    worst = {};
    const double length = read_.x_max - read_.x_min;
    const auto count = to_whole<std::size_t>(std::isfinite(length) ? length / request_.line_step : 0.0);
    if (read_.surface->constant_profile() || count < 64) {
      worst.reason = "needs a scan along the rail";
      return;
    }
    std::vector<Vec2> line(count);
    for (std::size_t i = 0; i < count; ++i)
      line[i] = {read_.x_min + request_.line_step * (static_cast<double>(i) + 0.5), request_.line};
    std::vector<double> z(count);
    HeightsOut heights;
    heights.z = z;
    read_.surface->heights_at(natural_plane(Body::rail, 0.0), line, heights);
    for (double& h : z) h = -h;
    measures::RoughnessGauge gauge;
    gauge.noise = std::max(scatter_of_points(read_, request_.line_step), read_.error.value_or(0.0));
    try {
      out_.roughness = measures::measure_roughness(z, request_.line_step, gauge, request_.limits.roughness);
    } catch (const Error& error) {
      worst.reason = error.message();
      return;
    }
    double untold = 0.0;  // shortest wavelength beyond those that the line tells
    for (const measures::RoughnessBand& band : out_.roughness->bands)
      if (std::isnan(band.level) && band.limit == band.limit && band.wavelength > 8.0 * request_.line_step)
        untold = untold == 0.0 ? band.wavelength : std::min(untold, band.wavelength);
    if (untold > 0.0)
      out_.notes.push_back(fmt::format("the line of {:.2f} m is too short for roughness with waves of {:g} mm and more",
                                       out_.roughness->length, 1e3 * untold));
    for (const measures::RoughnessBand& band : out_.roughness->bands)
      if (const double over = band.level - band.limit; over == over && !(over <= worst.value)) worst.value = over;
    if (!worst.known()) worst.reason = "no band with a limit can be told from so short a line";
  }

  ReadMeasured read_;
  const MeasureRequest& request_;
  const Nominals& nominals_;
  MeasuredFile& out_;
  RailNumbers numbers_;
};

/// What the instrument wrote into the file, where it differs from what the points say.
void note_own_numbers(const WheelNumbers& wheel, MeasuredFile& out) {
  const auto own = std::find_if(out.said.begin(), out.said.end(), [](const auto& s) { return s.first == "Sd Sh qR"; });
  if (own == out.said.end()) return;
  const Measure* const measured[] = {&wheel.flange_thickness, &wheel.flange_height, &wheel.flange_gradient};
  std::istringstream words(own->second);
  for (const Measure* m : measured) {
    std::string word;
    words >> word;
    const std::optional<double> said_mm = finite_number(word);
    if (!said_mm) return;
    const double said = 1e-3 * *said_mm;
    constexpr double kResolution = 0.05e-3;  // of what such instruments say
    if (m->known() && std::fabs(m->value - said) > kResolution + m->uncertainty) {
      out.notes.push_back(fmt::format(
          "the file's own Sd, Sh, qR ({}) are not those of its points ({:.2f} {:.2f} {:.2f}): another profile's, or "
          "measured from another tape line",
          own->second, 1e3 * measured[0]->value, 1e3 * measured[1]->value, 1e3 * measured[2]->value));
      return;
    }
  }
}

MeasuredFile measure_with(const std::string& name, const MeasureRequest& request, const Nominals& nominals) {
  MeasuredFile out;
  out.file = name;
  if (request.body == Body::rail) out.numbers = RailNumbers{};
  const ReadMeasured read = read_measured(name, request);
  out.kind = read.kind;
  out.notes = read.notes;
  out.doubtful = read.doubtful;
  out.said = read.said;
  try {
    if (request.body == Body::wheel)
      WheelFile(read, request, nominals, out).measure();
    else
      RailFile(read, request, nominals, out).measure();
  } catch (const Error& error) {
    if (!error.where().file.empty()) throw;
    throw Error(error.kind(), error.message(), {name, 0, 0}, error.advice());
  }
  if (const auto* wheel = std::get_if<WheelNumbers>(&out.numbers)) note_own_numbers(*wheel, out);
  out.limits = compare_limits(out.numbers, request.limits);
  return out;
}

/// Of what read_measured reads.
bool can_be_measured(const fs::path& file, Body body) {
  const auto row = io::shape_extension(file);
  return row && (row->kinds & ~(io::kCadFile | io::kSplineFile)) != 0 && row->body.value_or(body) == body;
}

}  // namespace

Verdict MeasuredFile::verdict() const {
  Verdict worst = Verdict::no_limits;
  for (const LimitResult& result : limits) worst = std::max(worst, result.verdict);
  return worst;
}

double MeasuredFile::badness() const {
  double worst = std::nan("");
  for (const LimitResult& l : limits) {
    if (l.verdict == Verdict::not_measured) continue;
    const double scale =
        std::max(1e-9, l.limit.min && l.limit.max ? *l.limit.max - *l.limit.min
                                                  : std::fabs(l.limit.max ? *l.limit.max : *l.limit.min));
    if (l.limit.max) worst = std::fmax(worst, (l.value - *l.limit.max) / scale);
    if (l.limit.min) worst = std::fmax(worst, (*l.limit.min - l.value) / scale);
  }
  return worst;
}

std::vector<std::string> measured_names(const std::vector<std::string>& given, Body body) {
  std::vector<std::string> names;
  for (const std::string& name : given) {
    if (name.starts_with('@')) {
      const fs::path list = name.substr(1);
      std::string text = io::profiles::read_text(list, "list", {});
      for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        std::string line = text.substr(start, end - start);
        start = end + 1;
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
        if (line.empty() || line.front() == '#') continue;
        const fs::path file = line;
        const fs::path beside = file.is_absolute() ? file : list.parent_path() / file;
        std::error_code ignored;
        names.push_back(!fs::exists(io::profiles::portable_path(beside.string()), ignored) && library_body(line)
                            ? line
                            : beside.string());
      }
    } else if (fs::is_directory(name)) {
      std::vector<std::string> inside;
      for (const fs::directory_entry& entry : fs::directory_iterator(name))
        if (entry.is_regular_file() && can_be_measured(entry.path(), body)) inside.push_back(entry.path().string());
      std::sort(inside.begin(), inside.end());
      if (inside.empty())
        throw Error(ErrorKind::input_data, "there are no files in the folder that can be measured", {name, 0, 0});
      names.insert(names.end(), inside.begin(), inside.end());
    } else {
      names.push_back(name);
    }
  }
  return names;
}

MeasuredFile measure_file(const std::string& name, const MeasureRequest& request) {
  return measure_with(name, request, read_nominals(request));
}

namespace {

/// What the numbers of a list depend on beside its files.
std::string settings_of(const MeasureRequest& request) {
  std::string out = io::settings_text(measure_keys(), request, MeasureRequest{});
  for (const std::string& key : request.overrides) out += ", " + key;
  const Limits& limits = request.limits;
  for (const Limit& limit : request.body == Body::wheel ? limits.wheel : limits.rail)
    out += fmt::format(", {} {}..{}", limit.key, limit.min.value_or(-HUGE_VAL), limit.max.value_or(HUGE_VAL));
  for (const double level : limits.roughness) out += fmt::format(", {} dB", level);
  return out;
}

/// Columns of a list: those with limits are shown, then the first others.
template <class Numbers>
std::vector<ListColumn> columns_of(const std::vector<Limit>& limits) {
  constexpr std::size_t kShown = 6;
  std::vector<ListColumn> out;
  for (const auto& row : number_rows(Numbers{})) {
    ListColumn column{std::string(row.key)};
    for (const Limit& limit : limits) {
      if (limit.key != row.key) continue;
      column.shown = true;
      if (limit.min) column.levels.push_back({*limit.min, "least"});
      if (limit.max) column.levels.push_back({*limit.max, "greatest"});
    }
    out.push_back(std::move(column));
    out.push_back({std::string(row.key) + "_uncertainty"});
  }
  auto shown = static_cast<std::size_t>(ranges::count_if(out, &ListColumn::shown));
  for (std::size_t k = 0; k < out.size() && shown < kShown; k += 2)
    if (!out[k].shown) out[k].shown = true, ++shown;
  return out;
}

std::string words_of_doubts(const MeasuredFile& file) {
  constexpr std::string_view kWarning = "warning: ";
  std::string out;
  for (const std::string& note : file.notes)
    if (note.starts_with(kWarning)) out += (out.empty() ? "" : "; ") + note.substr(kWarning.size());
  return out;
}

ListRow row_of(const MeasuredFile& file) {
  ListRow row{file.file,
              file.error.empty() ? word_of(file.verdict()) : "failed",
              file.error,
              {file.kind, words_of_doubts(file)}};
  if (file.error.empty()) {
    row.badness = file.badness();
    std::visit(
        [&](const auto& numbers) {
          for (const auto& r : number_rows(numbers))
            row.numbers.insert(row.numbers.end(), {r.in_file(numbers), r.uncertainty_in_file(numbers)});
        },
        file.numbers);
  }
  row.document = file_document(file);
  return row;
}

/// Without rows.
ResultList list_for(const MeasureRequest& request) {
  ResultList list;
  list.title = request.body == Body::wheel ? "Measures of wheels" : "Measures of rails";
  list.things = "files";
  list.settings = settings_of(request);
  list.words = {"kind", "doubts"};
  list.numbers = request.body == Body::wheel ? columns_of<WheelNumbers>(request.limits.wheel)
                                             : columns_of<RailNumbers>(request.limits.rail);
  return list;
}

}  // namespace

ResultList list_of(const MeasuredFile& file, const MeasureRequest& request) {
  ResultList list = list_for(request);
  list.rows = {row_of(file)};
  return list;
}

ResultList measure_files(const std::vector<std::string>& names, const MeasureRequest& request, const fs::path& kept,
                         const Progress& progress) {
  const Nominals nominals = read_nominals(request);
  ResultList list = list_for(request);
  ListWork work;
  work.count = names.size();
  work.name = [&](std::size_t i) { return names[i]; };
  work.sources = [&](std::size_t i) { return std::vector<std::string>{names[i], request.nominal}; };
  work.make = [&](std::size_t i) {
    MeasuredFile file;
    try {
      file = measure_with(names[i], request, nominals);
    } catch (const Cancelled&) {
      throw;
    } catch (const std::exception& error) {
      file.file = names[i];
      file.error = error.what();
      if (request.body == Body::rail) file.numbers = RailNumbers{};
    }
    return row_of(file);
  };
  make_rows(list, work, kept, progress);
  return list;
}

}  // namespace treadmark::app
