// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/profile_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cad/read_cad.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/measured/nominal.hpp"
#include "treadmark/measures/rail.hpp"
#include "treadmark/measures/wheel.hpp"
#include "treadmark/model/body_name.hpp"

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
                    fmt::format("wear W1 {}, W2 {}, laid upon it {}", in_mm(m.w1), in_mm(m.w2),
                                alignment == measures::RailAlignment::unworn ? "by what does not wear"
                                : alignment == measures::RailAlignment::none ? "as in the file"
                                                                             : "by its top, which hides wear there")};
  };
  try {
    return by(measures::RailAlignment::unworn);
  } catch (const Error&) {
    // a head alone has not enough of it
  }
  constexpr double kHeadBeside = 10e-3, kWorn = 20e-3;
  const bool in_its_axes =
      std::fabs(section.y_min() + section.y_max()) < kHeadBeside && std::fabs(section.z_min()) < kWorn;
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
  const Nearness best = std::ranges::min_element(all, {}, badness)->first;
  std::string names;
  std::size_t count = 0;
  for (const auto& [one, name] : all)
    if (one.badness() <= kAboutAsNear * best.badness() + kAlike && ++count <= kNamed)
      names += (count > 1 ? ", " : "") + name;
  if (count > kNamed) names += fmt::format(" and {} more", count - kNamed);
  to.facts.emplace_back("standard", fmt::format("nearest to {}: {}; {:.3g} mm2 lost, {:.3g} mm2 beyond", names,
                                                best.wear, kMicro * best.lost, kMicro * best.gained));
}

/// A section that fits a nominal one much better when it is rolled was measured in a frame that is tilted; a rail that
/// is worn on the side of great y alone shows the gauge side there.
void judge_against_nominal(const io::SourcedProfile& sourced, io::ProfileJudgement& to) {
  constexpr double kTimesBetter = 3.0, kBadUpright = 0.05e-3, kWorn = 1e-3, kAsNew = 0.3e-3;
  constexpr double kFits = 0.3e-3;  // a worse fit shows nothing
  const Profile& profile = sourced.profile;
  std::vector<measured::NominalOutline> outlines;
  for (const Standard& standard : standards(profile.body))
    if (standard.upright) outlines.push_back(standard.outline);
  const std::optional<measured::Lean> lean = measured::lean_of(profile, outlines);
  if (!lean || lean->residual > kFits) return;
  if (std::fabs(lean->roll) > measured::kUsualRoll && lean->upright > kBadUpright &&
      lean->upright > kTimesBetter * lean->residual)
    to.remarks.push_back(
        {"rolled",
         fmt::format("the section is rolled by {:.0f} mrad ({:.1f} degrees) against {}: {:.2g} mm off it when "
                     "rolled back, {:.2g} mm as it is; was the measuring frame upright? turn the points",
                     kMilli * lean->roll, lean->roll * 180.0 / kPi, lean->name, kMilli * lean->residual,
                     kMilli * lean->upright)});
  if (profile.body == Body::rail && !sourced.source.mirrored_y && lean->lost_high > kWorn && lean->lost_low < kAsNew)
    to.remarks.push_back(
        {"gauge_side",
         fmt::format("the side of great y is worn by {:.2g} mm against {} and that of small y, where the gauge "
                     "is measured, by {:.2g} mm: is the gauge side there? set mirror_y = true",
                     kMilli * lean->lost_high, lean->name, kMilli * lean->lost_low)});
}

enum class Nearest { no, yes };

CheckedProfile checked(const io::SourcedProfile& profile, const std::filesystem::path& file,
                       const io::ExpectedProfile& expected, Nearest nearest) {
  CheckedProfile out{fmt::format("{} profile {}", body_name(profile.profile.body), file.string()), profile.profile.body,
                     io::judge_profile(profile, expected)};
  judge_against_nominal(profile, out.judgement);
  if (nearest == Nearest::yes) add_nearest(profile.profile, out.judgement);
  return out;
}

/// One use of a file: the same file may be turned or scaled otherwise elsewhere.
struct ProfileUse {
  io::GeometryFile file;
  Body body;
  io::ExpectedProfile expected;
  SourcePosition where;

  bool same_as(const ProfileUse& other) const {
    return file.file == other.file.file && file.options == other.file.options && body == other.body &&
           expected.flange_back == other.expected.flange_back &&
           expected.nominal_radius == other.expected.nominal_radius && expected.by_gauge == other.expected.by_gauge;
  }
};

void collect(const io::SurfaceSource& source, Body body, const io::ExpectedProfile& expected,
             std::vector<ProfileUse>& uses) {
  for (const io::SurfaceSource& part : source.parts) collect(part, body, expected, uses);
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (!source.parts.empty() || file == nullptr) return;
  if (is_offset_file(file->file) || io::is_mesh_file(file->file) || io::is_cad_file(file->file) ||
      io::is_slices_file(file->file) || io::is_spline_file(file->file))
    return;
  ProfileUse use{*file, body, expected, source.where};
  if (std::none_of(uses.begin(), uses.end(), [&](const ProfileUse& u) { return u.same_as(use); }))
    uses.push_back(std::move(use));
}

std::vector<ProfileUse> uses_of(const io::Case& c) {
  std::vector<ProfileUse> uses;
  const auto* input = std::get_if<io::WheelRailCase>(&c.content);
  if (input == nullptr) return uses;
  collect(input->rail, Body::rail, {{}, {}, input->track.gauge_based}, uses);
  collect(input->wheel, Body::wheel, {input->wheelset.flange_back_position, profile_radius(*input, Body::wheel), true},
          uses);
  return uses;
}

/// Every profile of the cases once.
std::vector<std::pair<ProfileUse, CheckedProfile>> checked_uses(const io::CaseFile& file, Nearest nearest) {
  std::vector<std::pair<ProfileUse, CheckedProfile>> out;
  for (const io::Case& c : file.cases)
    for (ProfileUse& use : uses_of(c)) {
      if (std::ranges::any_of(out, [&](const auto& known) { return known.first.same_as(use); })) continue;
      CheckedProfile one = checked(io::read_sourced_profile(use.file.file, use.body, use.file.options, use.where),
                                   use.file.file, use.expected, nearest);
      out.emplace_back(std::move(use), std::move(one));
    }
  return out;
}

}  // namespace

bool is_profile_file(const std::filesystem::path& file) {
  if (io::profile_body(file) || io::profile_format(file) != io::ProfileFormat::two_column) return true;
  const std::string extension = io::profiles::lower(file.extension().string());
  for (const char* known : {".csv", ".txt", ".dat", ".asc", ".rail"})
    if (extension == known) return true;
  return false;
}

CheckedProfile check_profile(const std::filesystem::path& file, std::optional<Body> body,
                             const io::ProfileOptions& options) {
  if (!body) body = io::profile_body(file);
  if (body) return checked(io::read_sourced_profile(file, *body, options, {}), file, {}, Nearest::yes);
  // as rails are half as wide as wheels, and few files can be read as both
  std::optional<io::SourcedProfile> rail, wheel;
  std::optional<Error> trouble;
  for (const Body b : {Body::rail, Body::wheel}) {
    try {
      (b == Body::rail ? rail : wheel) = io::read_sourced_profile(file, b, options, {});
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
  CheckedProfile out = checked(is_wheel ? *wheel : *rail, file, {}, Nearest::yes);
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

std::vector<io::ProfileRemark> doubts_of(const io::SourcedProfile& profile) {
  return checked(profile, {}, {{}, {}, false}, Nearest::no).judgement.remarks;
}

std::vector<CheckedProfile> check_profiles(const io::CaseFile& file) {
  std::vector<CheckedProfile> out;
  for (auto& [use, profile] : checked_uses(file, Nearest::yes)) out.push_back(std::move(profile));
  return out;
}

std::vector<std::string> source_doubts(const io::SurfaceSource& source, Body body,
                                       const io::ExpectedProfile& expected) {
  std::vector<ProfileUse> uses;
  collect(source, body, expected, uses);
  std::vector<std::string> out;
  for (const ProfileUse& use : uses) {
    const CheckedProfile one = checked(io::read_sourced_profile(use.file.file, body, use.file.options, use.where),
                                       use.file.file, expected, Nearest::no);
    for (const io::ProfileRemark& remark : one.judgement.remarks)
      out.push_back(fmt::format("{}: {}: {}", one.name, remark.name, remark.text));
  }
  return out;
}

namespace {

/// Slices lie as they are in their file: a section in their middle shows whether that is the place of a wheel or rail.
std::string doubt_of_slices(const io::SurfaceSource& source, Body body, double radius, SurfaceStore& store) {
  const auto* file = std::get_if<io::GeometryFile>(&source.geometry);
  if (!source.parts.empty() || file == nullptr || !io::is_slices_file(file->file)) return {};
  const std::shared_ptr<const NaturalSurface> natural = store.natural(source, body, radius);
  const auto* slices = std::get_if<SliceSet>(&natural->spec.shape);
  if (slices == nullptr || slices->profiles.empty()) return {};
  const Profile& middle = slices->profiles[slices->profiles.size() / 2];
  measured::SectionPoints points{body, middle.y, middle.z};
  const measured::Understanding seen = measured::understand(points, {});
  std::string what;
  if (seen.mirrored_z && seen.z.sure())
    what = "upside_down: turned over a section shows " + seen.z.evidence;
  else if (seen.mirrored_y)
    what = "flange_side: " + seen.y.evidence + ", on the side of great y, as that of a left wheel";
  else if (seen.shift_y != 0.0)
    what = fmt::format("tape_line: y = 0 lies {:.2f} mm from the tape line, 70 mm from the back of the flange",
                       kMilli * std::fabs(seen.shift_y));
  return what.empty() ? what
                      : fmt::format("{} slices {}: {}; slices are taken as they lie", body_name(body),
                                    file->file.string(), what);
}

}  // namespace

void add_profile_doubts(const io::CaseFile& file, SurfaceStore& store, io::RunResult& run) {
  const auto known = checked_uses(file, Nearest::no);
  for (io::CaseResult& result : run.cases) {
    const auto given = std::ranges::find(file.cases, result.number, &io::Case::number);
    if (given == file.cases.end()) continue;
    const auto* input = std::get_if<io::WheelRailCase>(&given->content);
    if (input == nullptr) continue;
    for (const Body body : {Body::rail, Body::wheel})
      if (std::string doubt = doubt_of_slices(body == Body::wheel ? input->wheel : input->rail, body,
                                              profile_radius(*input, body), store);
          !doubt.empty())
        result.remarks.push_back({RemarkKind::profile_doubtful, 0, std::move(doubt)});
    for (const ProfileUse& use : uses_of(*given))
      for (const auto& [same, profile] : known) {
        if (!same.same_as(use)) continue;
        for (const io::ProfileRemark& remark : profile.judgement.remarks)
          if (remark.name != "gauge_point")
            result.remarks.push_back(
                {RemarkKind::profile_doubtful, 0, fmt::format("{}: {}: {}", profile.name, remark.name, remark.text)});
      }
  }
}

std::vector<std::string> profile_doubts(const io::CaseFile& file) {
  std::vector<std::string> doubts;
  for (const auto& [use, profile] : checked_uses(file, Nearest::no)) {
    for (const io::ProfileRemark& remark : profile.judgement.remarks)
      doubts.push_back(fmt::format("{}: {}: {}", profile.name, remark.name, remark.text));
    for (const std::string& note : profile.judgement.notes) doubts.push_back(fmt::format("{}: {}", profile.name, note));
  }
  return doubts;
}

}  // namespace treadmark::app
