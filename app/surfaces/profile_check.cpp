// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/profile_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "treadmark/analysis/measured/lumps.hpp"
#include "treadmark/analysis/measured/noise.hpp"
#include "treadmark/analysis/measured/nominal.hpp"
#include "treadmark/analysis/measured/side_wear.hpp"
#include "treadmark/analysis/measures/rail.hpp"
#include "treadmark/analysis/measures/wheel.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/offset/file.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/files/surface_errors.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/tables/number.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

constexpr double kLibraryPoints = 0.25e-3;  // [m]

/// A standard profile: as a section to measure by, and as an outline to lay others upon.
struct Standard {
  std::string name;
  measures::Section section;
  measured::NominalOutline outline;
  bool upright = true;  ///< false: inclined in its own axes
};

std::vector<Standard> standards_of(Body body) {
  std::vector<Standard> list;
  for (const LibraryProfile& row : profile_library()) {
    const std::string& name = row.name;
    if (row.family || row.body != body) continue;
    const std::vector<Vec2> outline = library_outline(name, kLibraryPoints);
    Profile points;
    points.body = body;
    for (const Vec2& p : outline) points.y.push_back(p.x()), points.z.push_back(p.y());
    list.push_back({name, measures::Section(points, 0.0), measured::nominal_outline(name, body, outline),
                    row.shape.find("inclined") == std::string::npos});
  }
  return list;
}

const std::vector<Standard>& standards(Body body) {
  static const std::vector<Standard> rails = standards_of(Body::rail), wheels = standards_of(Body::wheel);
  return body == Body::wheel ? wheels : rails;
}

/// What lies between a section and a standard one [m^2]: metal that is missing, and metal that should not be there,
/// which no wear explains.
struct Nearness {
  double lost = 0.0, gained = 0.0;
  std::string wear;
  double badness() const { return lost + 20.0 * gained; }
};

std::string in_mm(const measures::Measure& m) {
  return m.known() ? fmt::format("{:.3f} mm", kMilli * m.value) : "unknown";
}

Nearness nearness(const measures::Section& section, const Standard& standard) {
  if (section.body() == Body::wheel) {
    measures::WheelGauge gauge;
    gauge.placed = true;
    const measures::WheelMeasures m = measures::measure_wheel(section, gauge, 0.0, {{standard.name, standard.section}});
    return {m.area_lost.value, m.area_gained.value,
            fmt::format("wear {} at the tape line, {} of the flange", in_mm(m.tread_wear), in_mm(m.flange_wear))};
  }
  measures::RailGauge gauge;
  const auto by = [&](measures::RailAlignment alignment) {
    gauge.alignment = alignment;
    const measures::RailMeasures m = measures::measure_rail(section, &standard.section, gauge);
    return Nearness{m.loss.value, m.lip.value,
                    fmt::format("wear W1 {}, W2 {}, aligned with it {}", in_mm(m.w1), in_mm(m.w2),
                                alignment == measures::RailAlignment::unworn ? "by what does not wear"
                                : alignment == measures::RailAlignment::none ? "as in the file"
                                                                             : "by its top, which hides wear there")};
  };
  try {
    return by(measures::RailAlignment::unworn);
  } catch (const Error&) {
    // a head alone has not enough of it
  }
  // the field side does not wear, and the top wears downwards
  constexpr double kBeside = 3e-3, kAbove = 0.5e-3, kWorn = 20e-3;
  const bool in_its_axes = (std::fabs(section.y_min() + section.y_max()) < kBeside ||
                            std::fabs(section.y_max() - standard.section.y_max()) < kBeside) &&
                           section.z_min() > -kAbove && section.z_min() < kWorn;
  return by(in_its_axes ? measures::RailAlignment::none : measures::RailAlignment::top);
}

/// The standard profile that a section may have been, with its wear as `measure` finds it.
void add_nearest(const Profile& profile, io::ProfileJudgement& to) {
  constexpr double kAboutAsNear = 1.5, kAlike = 1e-9;  // [1], [m^2]
  constexpr std::size_t kNamed = 6;
  std::vector<std::pair<Nearness, std::string>> all;
  try {
    const measures::Section section(profile);
    for (const Standard& standard : standards(profile.body)) {
      try {
        if (Nearness one = nearness(section, standard); one.badness() == one.badness())
          all.emplace_back(std::move(one), standard.name);
      } catch (const Error&) {
        // they have too little in common
      }
    }
  } catch (const Error&) {
    // too few points
  }
  if (all.empty()) return;
  const auto badness = [](const auto& row) { return row.first.badness(); };
  const Nearness best = ranges::min_element(all, {}, badness)->first;
  std::string names;
  std::size_t count = 0;
  for (const auto& [one, name] : all)
    if (one.badness() <= kAboutAsNear * best.badness() + kAlike && ++count <= kNamed)
      names += (count > 1 ? ", " : "") + name;
  if (count > kNamed) names += fmt::format(" and {} more", count - kNamed);
  to.facts.emplace_back("standard", fmt::format("nearest to {}: {}; {:.3g} mm2 lost, {:.3g} mm2 beyond", names,
                                                best.wear, kMicro * best.lost, kMicro * best.gained));
}

/// How a section is rolled, and what shows it.
struct Roll {
  double roll = 0.0;  ///< [rad]
  bool sure = false;  ///< of the section against a nominal one: it does not fit as it is
  std::string seen;
};

/// By a nominal section where so much is there that it shows: the top of a rail rolls as it is shifted. Where none fits
/// clearly better so, by the flanges of a wheel, and of what has none by the slope of the tread or head.
std::optional<Roll> roll_of(const io::SourcedProfile& sourced, const measured::Lean* lean) {
  constexpr double kRail = 0.05e-3, kWheel = 0.15e-3, kLarge = 0.05, kOfLargeRoll = 0.3e-3, kDeep = 10e-3;
  constexpr double kAlike = 0.02e-3, kFarOff = 0.1e-3;
  constexpr double kTimesBetter = 1.5, kLevelTips = 0.012;
  constexpr double kUprightBack = 0.05, kUprightLongBack = 0.025, kLongBack = 20e-3;  // a burr tilts a short one
  constexpr double kTread = -0.045,
                   kOtherTreads = 0.055;  // treads taper off by 1:10 to level, rails are canted by 1:20
  constexpr double kNoTop = 0.09;         // of a head with its sides, which may be worn or cut
  const Profile& profile = sourced.profile;
  const measured::WheelMarks& marks = sourced.source.understood.wheel;
  const auto [top, bottom] = ranges::minmax(profile.z);
  // of a top alone only a large roll is told from a shift
  const bool shows = bottom - top > kDeep || (lean != nullptr && std::fabs(lean->roll) > kLarge &&
                                              lean->residual < kAlike && lean->upright > kFarOff);
  std::vector<Roll> seen;
  if (lean != nullptr && !marks.second_flange && shows) {
    const double fits = profile.body == Body::rail ? kRail : std::fabs(lean->roll) > kLarge ? kOfLargeRoll : kWheel;
    if (lean->residual <= fits && (profile.body == Body::rail || lean->flange <= fits))
      seen.push_back({lean->roll, lean->upright > kTimesBetter * lean->residual,
                      fmt::format("against {}: {:.2g} mm off it when rolled back, {:.2g} mm as it is", lean->name,
                                  kMilli * lean->residual, kMilli * lean->upright)});
  }
  if (marks.tips_lean)
    seen.push_back({*marks.tips_lean, std::fabs(*marks.tips_lean) > kLevelTips, "by the tips of its flanges"});
  else if (const auto& back = marks.straight)
    seen.push_back({back->lean, std::fabs(back->lean) > (back->length > kLongBack ? kUprightLongBack : kUprightBack),
                    "by the back of its flange"});
  else if (marks.tread && std::fabs(marks.tread->slope - kTread) > kOtherTreads + marks.tread->spread)
    seen.push_back({marks.tread->slope - kTread, true, "by the slope of its tread"});
  else if (const auto& head = sourced.source.understood.head;
           head && std::fabs(head->slope) > (bottom - top < kDeep ? kOtherTreads : kNoTop + head->spread))
    seen.push_back({head->slope, true, "by the slope of its top"});
  if (seen.empty()) return std::nullopt;
  const auto sure = ranges::find(seen, true, &Roll::sure);
  return sure != seen.end() ? *sure : seen.front();
}

/// A section that is rolled was measured in a frame that is tilted, or of a rail that is inclined.
void judge_roll(const Roll& roll, Body body, const io::ExpectedProfile& expected, io::ProfileJudgement& to) {
  constexpr double kMostInclined = 0.055, kUpright = 1e-3;
  const std::string seen =
      fmt::format("by {:.1f} mrad ({:.1f} degrees) {}", kMilli * roll.roll, roll.roll * 180.0 / kPi, roll.seen);
  const bool may_be_inclined = body == Body::rail && std::fabs(roll.roll) < kMostInclined;
  if (!roll.sure || std::fabs(roll.roll) < measured::kLevel)
    to.facts.emplace_back("roll",
                          seen + fmt::format("; up to {:g} mrad are not doubted, though where wheel and rail are "
                                             "nearly alike 2 mrad may change pressures by 15 %",
                                             kMilli * measured::kLevel));
  else if (may_be_inclined && !expected.cant)
    to.facts.emplace_back("roll", seen + "; if the rail is inclined, track.cant is 0");
  else if (!may_be_inclined || std::fabs(*expected.cant) > kUpright)
    to.remarks.push_back({"rolled", fmt::format("the section is rolled {}; {}", seen,
                                                may_be_inclined ? "is its inclination in the points? set cant = 0"
                                                                : "was the measuring frame upright? turn the points")});
}

bool has_remark(const io::ProfileJudgement& judgement, const char* name) {
  return ranges::find(judgement.remarks, name, &io::ProfileRemark::name) != judgement.remarks.end();
}

/// A tread without its flange that is like a nominal one when it is turned, and not as it is; or that is worn so much
/// that both senses of z are as likely.
void judge_tread(const io::SourcedProfile& sourced, std::span<const measured::NominalOutline> outlines,
                 io::ProfileJudgement& to) {
  constexpr double kOff = 0.1e-3, kTurned = 1e-3, kTimesBetter = 3.0, kWorn = 0.5e-3, kAboutAsWell = 1.25;
  const io::ProfileSource& source = sourced.source;
  if (!source.understood.taken_as_it_is || has_remark(to, "upside_down")) return;
  const auto fits = measured::tread_fits(sourced.profile, outlines);
  const measured::TreadFit &as_it_is = fits[0], &over = fits[2].rms < fits[3].rms ? fits[2] : fits[3],
                           &best = fits[1].rms < over.rms ? fits[1] : over;
  if (!std::isfinite(as_it_is.rms)) return;
  const auto mirrored = [&](const measured::TreadFit& fit) {
    return fmt::format(
        "no flange is in the section, and with {}{}{} mirrored it lies {:.2g} mm off {}, as in the file "
        "{:.2g} mm",
        fit.mirror_y ? "y" : "", fit.mirror_y && fit.mirror_z ? " and " : "", fit.mirror_z ? "z" : "", kMilli * fit.rms,
        fit.name, kMilli * as_it_is.rms);
  };
  if (as_it_is.rms > kOff && best.rms < kTurned && kTimesBetter * best.rms < as_it_is.rms) {
    std::string keys = best.mirror_y ? fmt::format("mirror_y = {}", !source.mirrored_y) : std::string();
    if (best.mirror_z)
      keys += fmt::format("{}mirror_z = \"{}\"", keys.empty() ? "" : ", ", source.mirrored_z ? "no" : "yes");
    to.remarks.push_back({best.mirror_z ? "upside_down" : "flange_side", mirrored(best) + ": set " + keys});
  } else if (as_it_is.rms > kWorn && over.rms < kAboutAsWell * as_it_is.rms) {
    to.remarks.push_back(
        {"upside_down", mirrored(over) + ": which way z points is not sure: set mirror_z = \"yes\" or \"no\""});
  }
}

/// By nominal sections: roll, which way a tread points, and the gauge side of a rail, where one side alone is worn.
/// ends: of slices, which agree in that unless they are of a crossing.
void judge_against_nominal(const io::SourcedProfile& sourced, const io::ExpectedProfile& expected,
                           std::span<const Profile* const> ends, io::ProfileJudgement& to) {
  constexpr double kFits = 0.05e-3;  // a worse fit shows nothing
  constexpr double kWorn = 1e-3, kAsNew = 0.3e-3, kShifted = 0.7e-3;
  const measured::WheelMarks& marks = sourced.source.understood.wheel;
  // one with its flange on the wrong side is told apart from all of them
  if (has_remark(to, "flange_side")) return;
  const Profile& profile = sourced.profile;
  std::vector<measured::NominalOutline> outlines;
  for (const Standard& standard : standards(profile.body))
    if (standard.upright) outlines.push_back(standard.outline);
  judge_tread(sourced, outlines, to);
  const std::optional<measured::Lean> lean = measured::lean_of(profile, outlines);
  if (const std::optional<Roll> roll = roll_of(sourced, lean ? &*lean : nullptr))
    judge_roll(*roll, profile.body, expected, to);
  const bool fits = lean && lean->residual <= kFits;
  if (fits && profile.body == Body::wheel && !marks.back_y && lean->flange <= kFits &&
      std::fabs(lean->shift_y) > kShifted && !has_remark(to, "tape_line"))
    to.remarks.push_back(
        {"tape_line", fmt::format("y = 0 lies {:.2f} mm from the tape line of {}, which the section fits, and the back "
                                  "of the flange is not in the section: measure it too, or shift y",
                                  kMilli * std::fabs(lean->shift_y), lean->name)});
  if (profile.body == Body::wheel || has_remark(to, "gauge_side")) return;
  std::optional<std::string> worn;
  if (fits && lean->lost_high > kWorn && lean->lost_low < kAsNew)
    worn = fmt::format("the side of great y is worn by {:.2g} mm against {} and that of small y by {:.2g} mm",
                       kMilli * lean->lost_high, lean->name, kMilli * lean->lost_low);
  else if (ranges::all_of(ends, [&](const Profile* p) { return measured::worn_at_great_y(*p, outlines).has_value(); }))
    worn = measured::worn_at_great_y(sourced.whole ? *sourced.whole : profile, outlines);  // with its web
  if (worn)
    to.remarks.push_back({"gauge_side", fmt::format("{}, and the gauge is measured on that of small y: is the gauge "
                                                    "side the other one? set mirror_y = {}",
                                                    *worn, !sourced.source.mirrored_y)});
}

enum class Nearest { no, yes };

CheckedProfile checked(const io::SourcedProfile& profile, const std::filesystem::path& file,
                       const io::ExpectedProfile& expected, Nearest nearest) {
  CheckedProfile out{fmt::format("{} profile {}", body_name(profile.profile.body), file.string()), profile.profile.body,
                     io::judge_profile(profile, expected)};
  judge_against_nominal(profile, expected, {}, out.judgement);
  if (nearest == Nearest::yes) add_nearest(profile.profile, out.judgement);
  return out;
}

/// The slices that a source names by itself.
const io::GeometryFile* slices_file(const io::SurfaceSource& source) {
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  return source.parts.empty() && file != nullptr && io::is_slices_file(file->file) ? file : nullptr;
}

bool same_use(const ProfileUse& a, const ProfileUse& b) {
  return a.file.file == b.file.file && a.file.options == b.file.options && a.body == b.body &&
         a.expected.flange_back == b.expected.flange_back && a.expected.nominal_radius == b.expected.nominal_radius &&
         a.expected.by_gauge == b.expected.by_gauge && a.expected.cant == b.expected.cant;
}

void collect(const io::SurfaceSource& source, Body body, const io::ExpectedProfile& expected,
             std::vector<ProfileUse>& uses) {
  for (const io::SurfaceSource& part : source.parts) collect(part, body, expected, uses);
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (!source.parts.empty() || file == nullptr) return;
  if (io::can_hold(file->file, ~(io::kProfileFile | io::kPointFile))) return;
  ProfileUse use{*file, body, expected, source.where};
  if (std::none_of(uses.begin(), uses.end(), [&](const ProfileUse& u) { return same_use(u, use); }))
    uses.push_back(std::move(use));
}

std::vector<ProfileUse> uses_of(const io::Case& c) {
  std::vector<ProfileUse> uses;
  const auto* input = std::get_if<io::WheelRailCase>(&c.content);
  if (input == nullptr) return uses;
  collect(input->rail, Body::rail, {{}, {}, input->track.gauge_based, input->track.cant}, uses);
  collect(input->wheel, Body::wheel,
          {input->wheelset.flange_back_position, profile_radius(*input, Body::wheel), true, {}}, uses);
  return uses;
}

/// Every profile of the cases once.
ProfilesOfRun checked_uses(const io::CaseFile& file, Nearest nearest) {
  ProfilesOfRun out;
  for (const io::Case& c : file.cases)
    for (ProfileUse& use : uses_of(c)) {
      if (ranges::any_of(out, [&](const auto& known) { return same_use(known.first, use); })) continue;
      CheckedProfile one = checked(io::read_sourced_profile(use.file.file, use.body, use.file.options, use.where),
                                   use.file.file, use.expected, nearest);
      out.emplace_back(std::move(use), std::move(one));
    }
  return out;
}

}  // namespace

bool is_profile_file(const std::filesystem::path& file) {
  return io::can_hold(io::profile_file(file), io::kProfileFile);
}

CheckedProfile check_profile(const std::filesystem::path& file, std::optional<Body> body,
                             const io::ProfileOptions& options, const io::ExpectedProfile& expected) {
  if (!body) body = io::profile_body(file);
  if (body) return checked(io::read_sourced_profile(file, *body, options, {}), file, expected, Nearest::yes);
  // as rails are half as wide as wheels, and few files can be read as both
  std::optional<io::SourcedProfile> rail, wheel;
  std::optional<Error> trouble;
  for (const Body b : {Body::rail, Body::wheel}) {
    try {
      (b == Body::rail ? rail : wheel) = io::read_sourced_profile(file, b, options, {});
    } catch (const MissingFile&) {
      throw;
    } catch (const Error& error) {
      // a file that names its body tells more when it is read as that
      if (!trouble || trouble->message().find("profile is expected") != std::string::npos) trouble = error;
    }
  }
  if (!rail && !wheel) throw *trouble;
  constexpr double kWidestHead = 0.1;
  const std::vector<double>& y = (rail ? rail : wheel)->profile.y;
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  const bool is_wheel = !rail || (wheel && *high - *low > kWidestHead);
  CheckedProfile out = checked(is_wheel ? *wheel : *rail, file, expected, Nearest::yes);
  out.judgement.notes.insert(
      out.judgement.notes.begin(),
      fmt::format("taken for a {} by its shape: say --body if it is none", is_wheel ? "wheel" : "rail"));
  return out;
}

std::optional<Body> body_by_shape(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!is_profile_file(file) || io::profile_body(file) || !std::filesystem::exists(file, ignored)) return std::nullopt;
  try {
    return check_profile(file, std::nullopt).body;
  } catch (const Error&) {  // told where it is read
    return std::nullopt;
  }
}

std::string profile_check_json(const CheckedProfile& profile) {
  io::Json json{{"body", body_name(profile.body)}};
  json["facts"] = profile.judgement.facts;
  json["notes"] = profile.judgement.notes;
  io::Json& warnings = json["warnings"] = io::Json::array();
  for (const io::ProfileRemark& remark : profile.judgement.remarks) warnings.push_back({remark.name, remark.text});
  return io::dumped(json);
}

std::vector<io::ProfileRemark> doubts_of(const io::SourcedProfile& profile) {
  return checked(profile, {}, {{}, {}, false, {}}, Nearest::no).judgement.remarks;
}

std::optional<FittingStandard> fitting_standard(const measures::Section& section, bool as_new) {
  constexpr double kSameWidth = 0.3e-3, kSameCrown = 0.1;  // [m]; of the radius
  const bool rail = section.body() == Body::rail;
  const measures::RailMeasures own = rail ? measures::measure_rail(section, nullptr) : measures::RailMeasures{};
  std::optional<FittingStandard> best;
  for (const Standard& standard : standards(section.body())) {
    FittingStandard one{standard.name};
    try {
      if (rail) {
        const measures::RailMeasures its = measures::measure_rail(standard.section, nullptr);
        const bool alike = std::fabs(own.head_width.value - its.head_width.value) < kSameWidth &&
                           std::fabs(own.crown_radius.value / its.crown_radius.value - 1.0) < kSameCrown;
        if (as_new && !alike) continue;
        const measures::RailMeasures m = measures::measure_rail(section, &standard.section);
        one.lost = m.loss.value, one.gained = m.lip.value;
      } else {
        const measures::WheelMeasures m =
            measures::measure_wheel(section, {}, 0.0, {{standard.name, standard.section}});
        one.lost = m.area_lost.value, one.gained = m.area_gained.value;
      }
    } catch (const Error&) {
      continue;  // they have too little in common
    }
    if (one.badness() < (best ? best->badness() : kInfinity)) best = std::move(one);
  }
  return best;
}

std::vector<CheckedProfile> check_profiles(const io::CaseFile& file) {
  std::vector<CheckedProfile> out;
  for (auto& [use, profile] : checked_uses(file, Nearest::yes)) out.push_back(std::move(profile));
  return out;
}

namespace {

/// What noise or a tilted frame would do to a section of slices, which are not smoothed.
/// next: the section beside it.
std::optional<io::ProfileRemark> doubt_of_section(const Profile& section, const Profile& next,
                                                  std::span<const Profile* const> ends, measured::Understanding seen,
                                                  const io::ExpectedProfile& expected) {
  constexpr double kFelt = 0.25e-6;  // [m] neighbouring sections take some away
  constexpr double kSamePlace = 2e-3;
  constexpr double kDense = 1e-3;  // [m] points farther apart scatter by the curve between them
  io::SourcedProfile sourced;
  sourced.profile = section;
  sourced.source.understood = std::move(seen);
  sourced.source.understood.taken_as_it_is = false;  // slices say their axes
  io::ProfileJudgement judged;
  judge_against_nominal(sourced, expected, ends, judged);
  if (!judged.remarks.empty()) return std::move(judged.remarks.front());
  const measured::PointNoise noise = measured::profile_noise(section);
  const std::optional<measured::Lump> lump = measured::highest_lump(section, noise.across, true),
                                      beside = measured::highest_lump(next, noise.across, true);
  if (lump && beside && std::fabs(section.y[lump->first] - next.y[beside->first]) < kSamePlace)
    return io::ProfileRemark{
        "lump",
        fmt::format("{} of {:.2g} mm at y = {:.2f} mm: dirt or damage? where it touches, the pressure is that of it",
                    lump->height > 0.0 ? "a lump" : "a notch", kMilli * std::fabs(lump->height),
                    kMilli * section.y[lump->first])};
  const bool rounded = noise.rounding_y > 0.0 || noise.rounding_z > 0.0;
  if (section.smoothing.strength > 0.0 || noise.across < kFelt || (noise.step > kDense && !rounded))
    return std::nullopt;
  return io::ProfileRemark{
      "noise",
      fmt::format("the points scatter by {:.2g} mm and the surface runs through all of them: pressures are too "
                  "large; smooth the sections in the file, or import the points anew",
                  kMilli * noise.across)};
}

}  // namespace

std::optional<io::ProfileRemark> remark_on_slices(const SliceSet& slices, Body body,
                                                  const io::ExpectedProfile& expected) {
  if (slices.profiles.empty()) return std::nullopt;
  // what all sections agree in: those of a crossing are of different rails
  constexpr std::size_t kLooked = 7;
  const std::size_t step = std::max<std::size_t>(1, slices.profiles.size() / kLooked);
  measured::Understanding seen;
  for (std::size_t i = 0; i < slices.profiles.size(); i += step) {
    measured::SectionPoints points{body, slices.profiles[i].y, slices.profiles[i].z};
    measured::Understanding one = measured::understand(points, {});
    const bool agrees = i == 0 || (one.mirrored_z == seen.mirrored_z && one.mirrored_y == seen.mirrored_y &&
                                   (one.shift_y != 0.0) == (seen.shift_y != 0.0));
    if (!agrees) return std::nullopt;
    seen = std::move(one);
  }
  std::optional<io::ProfileRemark> remark;
  const std::size_t middle = slices.profiles.size() / 2;
  if (seen.mirrored_z && seen.z.sure())
    remark = {"upside_down", "mirrored in z a section shows " + seen.z.evidence};
  else if (seen.mirrored_y)
    remark = {"flange_side", seen.y.evidence + ", on the side of great y, as that of a left wheel"};
  else if (seen.shift_y != 0.0)
    remark = {"tape_line", fmt::format("y = 0 lies {:.2f} mm from the tape line, 70 mm from the back of the flange",
                                       kMilli * std::fabs(seen.shift_y))};
  else
    remark = doubt_of_section(slices.profiles[middle], slices.profiles[std::max<std::size_t>(1, middle) - 1],
                              std::array{&slices.profiles.front(), &slices.profiles.back()}, std::move(seen), expected);
  if (remark) remark->text += "; slices are taken as they lie";
  return remark;
}

std::string doubt_of_slices(const SliceSet& slices, const std::string& file, Body body,
                            const io::ExpectedProfile& expected) {
  const std::optional<io::ProfileRemark> remark = remark_on_slices(slices, body, expected);
  return remark ? fmt::format("{} slices {}: {}: {}", body_name(body), file, remark->name, remark->text)
                : std::string();
}

std::vector<std::string> import_doubts(const std::filesystem::path& file, Body body) {
  std::vector<std::string> out;
  const std::vector<SurfaceDoubt> doubts =
      is_offset_file(file) ? offset::read_vdb(file).base.doubts : io::read_surface_doubts(file);
  for (const SurfaceDoubt& doubt : doubts) out.push_back(in_words(doubt, body_name(body), file.string()));
  return out;
}

namespace {

void add_import_doubts(const io::SurfaceSource& source, Body body, std::vector<std::string>& out) {
  for (const io::SurfaceSource& part : source.parts) add_import_doubts(part, body, out);
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (!source.parts.empty() || file == nullptr) return;
  for (std::string& doubt : import_doubts(file->file, body))
    if (ranges::find(out, doubt) == out.end()) out.push_back(std::move(doubt));
}

}  // namespace

std::vector<std::string> import_doubts(const io::SurfaceSource& source, Body body) {
  std::vector<std::string> out;
  add_import_doubts(source, body, out);
  return out;
}

std::vector<std::string> import_doubts(const io::CaseFile& file) {
  std::vector<std::string> out;
  for (const io::Case& c : file.cases)
    if (const auto* pair = std::get_if<io::WheelRailCase>(&c.content)) {
      add_import_doubts(pair->rail, Body::rail, out);
      add_import_doubts(pair->wheel, Body::wheel, out);
    }
  return out;
}

std::vector<std::string> source_doubts(const io::SurfaceSource& source, Body body,
                                       const io::ExpectedProfile& expected) {
  std::vector<std::string> out = import_doubts(source, body);
  if (const io::GeometryFile* file = slices_file(source))
    if (std::string doubt = doubt_of_slices(io::read_slices(file->file, body, file->options, source.where),
                                            file->file.string(), body, expected);
        !doubt.empty())
      out.push_back(std::move(doubt));
  std::vector<ProfileUse> uses;
  collect(source, body, expected, uses);
  for (const ProfileUse& use : uses) {
    const CheckedProfile one = checked(io::read_sourced_profile(use.file.file, body, use.file.options, use.where),
                                       use.file.file, expected, Nearest::no);
    for (const io::ProfileRemark& remark : one.judgement.remarks)
      out.push_back(fmt::format("{}: {}: {}", one.name, remark.name, remark.text));
  }
  return out;
}

ProfilesOfRun check_profiles_of_run(const io::CaseFile& file) { return checked_uses(file, Nearest::no); }

namespace {

/// Whether contact comes near a part of a section; nobody knows without contact.
bool may_touch(const io::CaseResult& result, Side side, Body body, const std::pair<double, double>& place) {
  constexpr double kNear = 3e-3;  // [m] as far as a bridge changes the curve beside it
  return result.patches.empty() || ranges::any_of(result.patches, [&](const io::PatchResult& patch) {
           const Grid2& grid = patch.fields.grid;
           const double y = (side == Side::left ? -1.0 : 1.0) * (body == Body::wheel ? patch.y_wheel : patch.y_rail),
                        half = std::max(std::fabs(grid.y(0) - patch.reference_s),
                                        std::fabs(grid.y(grid.ny - 1) - patch.reference_s));
           return y + half + kNear > place.first && y - half - kNear < place.second;
         });
}

}  // namespace

void add_profile_doubts(const io::Case& given, const ProfilesOfRun& profiles, SurfaceStore& store, SurfaceDoubts& known,
                        io::CaseResult& result) {
  const auto* input = std::get_if<io::WheelRailCase>(&given.content);
  if (input == nullptr) return;
  for (const Body body : {Body::rail, Body::wheel}) {
    const io::SurfaceSource& source = body == Body::wheel ? input->wheel : input->rail;
    const std::shared_ptr<const NaturalSurface> natural = store.natural(source, body, profile_radius(*input, body));
    const std::optional<double> cant = body == Body::rail ? std::optional(input->track.cant) : std::nullopt;
    const auto [doubts, fresh] = known.try_emplace({natural, input->track.gauge_based, cant});
    if (fresh && !natural->spec.doubts.empty()) doubts->second = import_doubts(source, body);
    const io::GeometryFile* file_of = slices_file(source);
    const auto* slices = std::get_if<SliceSet>(&natural->spec.shape);
    if (fresh && file_of != nullptr && slices != nullptr)
      if (std::string doubt =
              doubt_of_slices(*slices, file_of->file.string(), body, {{}, {}, input->track.gauge_based, cant});
          !doubt.empty())
        doubts->second.push_back(std::move(doubt));
    for (const std::string& doubt : doubts->second) result.remarks.push_back({RemarkKind::profile_doubtful, 0, doubt});
  }
  for (const ProfileUse& use : uses_of(given))
    for (const auto& [same, profile] : profiles) {
      if (!same_use(same, use)) continue;
      for (const io::ProfileRemark& remark : profile.judgement.remarks)
        if (remark.name != "gauge_point" && (!remark.place || may_touch(result, input->side, same.body, *remark.place)))
          result.remarks.push_back(
              {RemarkKind::profile_doubtful, 0, fmt::format("{}: {}: {}", profile.name, remark.name, remark.text)});
    }
}

std::vector<std::string> profile_doubts(const ProfilesOfRun& profiles) {
  std::vector<std::string> doubts;
  for (const auto& [use, profile] : profiles) {
    for (const io::ProfileRemark& remark : profile.judgement.remarks)
      doubts.push_back(fmt::format("{}: {}: {}", profile.name, remark.name, remark.text));
    for (const std::string& note : profile.judgement.notes) doubts.push_back(fmt::format("{}: {}", profile.name, note));
  }
  return doubts;
}

}  // namespace treadmark::app
