// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/cases/read_toml.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/case_rows.hpp"
#include "treadmark/io/cases/combination_rules.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/validate_case.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/settings/key_schema.hpp"

namespace treadmark::io {

namespace {

constexpr std::size_t kMostCases = 100000;

bool is_scalar_key(const std::string& path) {
  for (const CaseKey& key : case_keys())
    if (key.info.path == path) return !is_list(key.info);
  return false;
}

/// A list that stands where one value is expected. at: that value, in a table that outlives this.
struct ValueList {
  CaseValue* at;
  CaseValue values;
};

/// Takes the list that stands for one value of a key; all of one entry must have the same length.
void take_list(CaseValue& value, const std::string& path, std::vector<ValueList>& lists) {
  const std::size_t count = value.list().size();
  if (count == 0) throw Error(ErrorKind::configuration, fmt::format("the list of {} is empty", path), value.where);
  if (const std::size_t other = lists.empty() ? count : lists.front().values.list().size(); other != count)
    throw Error(ErrorKind::configuration,
                fmt::format("the list of {} has {} values, another one of the same entry has {}", path, count, other),
                value.where, "lists of one [[cases]] entry advance together");
  lists.push_back({&value, std::move(value)});
}

/// Takes these lists out of a table, but for those of keys that overrides set.
void take_lists(CaseTable& table, const std::string& prefix, std::vector<ValueList>& lists) {
  for (CaseEntry& entry : table) {
    const std::string path = prefix.empty() ? entry.key : prefix + '.' + entry.key;
    if (entry.value.is_table())
      take_lists(std::get<CaseTable>(entry.value.data), path, lists);
    else if (entry.value.is_list() && is_scalar_key(path))
      take_list(entry.value, path, lists);
  }
}

/// Removes the list of values of a key.
void drop_list(CaseTable& table, std::string_view path) {
  const std::size_t dot = path.find('.');
  for (auto entry = table.begin(); entry != table.end(); ++entry) {
    if (entry->key != path.substr(0, dot)) continue;
    if (dot != std::string_view::npos && entry->value.is_table())
      drop_list(std::get<CaseTable>(entry->value.data), path.substr(dot + 1));
    else if (dot == std::string_view::npos && entry->value.is_list())
      table.erase(entry);
    return;
  }
}

/// A value for comparison only.
std::string as_words(const CaseValue& value) {
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value.data)) return '"' + *text + '"';
  std::string words;
  if (value.is_list()) {
    for (const CaseValue& one : value.list()) words += as_words(one) + ',';
    return '[' + words + ']';
  }
  if (!value.is_table()) return fmt::format("{}", value.number());
  for (const CaseEntry& one : value.table()) words += one.key + '=' + as_words(one.value) + ',';
  return '{' + words + '}';
}

/// Keys and values of a table but for those that overrides set, a line each, for comparison only.
void add_words(const CaseTable& table, const std::string& prefix, std::span<const CaseOverride> changes,
               std::set<std::string>& words) {
  for (const CaseEntry& entry : table) {
    const std::string path = prefix.empty() ? entry.key : prefix + '.' + entry.key;
    if (entry.value.is_table())
      add_words(entry.value.table(), path, changes, words);
    else if (ranges::find(changes, path, &CaseOverride::path) == changes.end())
      words.insert(path + '=' + as_words(entry.value));
  }
}

/// Puts the i-th value of every list into its place.
void take_values(const std::vector<ValueList>& lists, std::size_t i) {
  for (const ValueList& list : lists) *list.at = list.values.list().at(i);
}

std::vector<CaseOverride> parse_overrides(std::span<const std::string> overrides) {
  std::vector<CaseOverride> parsed;
  for (const std::string& one : overrides) parsed.push_back(parse_override(one));
  return parsed;
}

/// Paths of all keys that a table gives.
void collect_paths(const CaseTable& table, const std::string& prefix, std::set<std::string, std::less<>>& paths) {
  for (const CaseEntry& entry : table) {
    const std::string path = prefix.empty() ? entry.key : prefix + '.' + entry.key;
    paths.insert(path);
    if (entry.value.is_table()) collect_paths(entry.value.table(), path, paths);
  }
}

/// What all entries of a file share while they become cases.
struct Expansion {
  const Case& defaults;
  const std::filesystem::path& folder;
  std::vector<CaseOverride> changes;
  std::vector<Case>& out;
  std::map<int, std::size_t> last = {};                   ///< of every sequence, in out
  std::set<std::set<std::string>> given = {}, kept = {};  ///< what cases say, and what overrides leave of it

  void add(Case next, const SourcePosition& where) {
    if (out.size() >= kMostCases)
      throw Error(ErrorKind::configuration, fmt::format("more than {} cases", kMostCases), where);
    last[next.sequence] = out.size();
    out.push_back(std::move(next));
  }

  /// The next case of a table, overridden.
  Case changed(const CaseTable& table, const SourcePosition& where) const {
    Case next = defaults;
    next.where = where;
    apply_table(next, table, folder);
    for (const CaseOverride& change : changes) apply_assignment(next, change, folder);
    return next;
  }

  void expand(CaseTable table, const SourcePosition& where) {
    std::set<std::string, std::less<>> paths;
    collect_paths(table, "", paths);
    for (const CaseOverride& change : changes) paths.insert(change.path);
    std::vector<ValueList> lists;
    const std::vector<CaseOverride> as_given = changes;
    for (CaseOverride& change : changes)
      if (change.value.is_list() && is_scalar_key(change.path)) {
        drop_list(table, change.path);
        take_list(change.value, change.path, lists);
      }
    take_lists(table, "", lists);
    take_values(lists, 0);
    const std::size_t length = lists.empty() ? 1 : lists.front().values.list().size();
    const auto steps = static_cast<std::size_t>(changed(table, where).steps);
    if (steps > 0 && !lists.empty() && length != steps)
      throw Error(ErrorKind::configuration,
                  fmt::format("case.steps is {}, but a list of the same table has {} values", steps, length), where,
                  "a list gives one value for each step");
    for (std::size_t i = 0; i < (steps > 0 ? steps : length); ++i) {
      if (i < length) take_values(lists, i);
      Case next = changed(table, where);
      if (steps > 0) step(next, i > 0, [&](std::string_view key) { return paths.contains(key); });
      if (!changes.empty()) note_words(table, steps > 0 ? i : 0);
      next.steps = 0;
      add(std::move(next), where);
    }
    changes = as_given;
  }

 private:
  void note_words(const CaseTable& table, std::size_t step) {
    std::set<std::string> words;
    add_words(table, "", {}, words);
    words.insert(fmt::format("step {}", step));
    given.insert(words);
    words.clear();
    add_words(table, "", changes, words);
    words.insert(fmt::format("step {}", step));
    for (const CaseOverride& change : changes) words.insert(change.path + '=' + as_words(change.value));
    kept.insert(std::move(words));
  }

  void step(Case& next, bool goes_on, const std::function<bool(std::string_view)>& given) const {
    HistoryUse& history = std::visit([](auto& content) -> HistoryUse& { return content.history; }, next.content);
    if (goes_on && history == HistoryUse::start) history = HistoryUse::keep_going;
    settle_rolling_step(next);
    const auto previous = last.find(next.sequence);
    if (previous != last.end() && history != HistoryUse::start && history != HistoryUse::same_instant)
      move_on(next, out[previous->second], given);
  }
};

void refuse_steps(const std::vector<CaseOverride>& changes) {
  for (const CaseOverride& change : changes)
    if (change.path == "case.steps" || change.path == "case.time_step_s")
      throw Error(ErrorKind::configuration,
                  change.path + " makes cases while a .toml file is read, these are made already", change.value.where);
}

}  // namespace

CaseFile all_cases(ListedCases listed) {
  CaseFile& file = listed.file;
  if (listed.rows == nullptr) return std::move(file);
  if (listed.rows->size() > kMostCases)
    throw Error(ErrorKind::configuration, fmt::format("more than {} cases", kMostCases), {listed.rows->file().string()},
                "treadmark run takes tables of any length, but for --fields, --report, --vtk and --verbose");
  file.cases.clear();
  for (std::size_t k = 0; k < listed.rows->blocks(); ++k)  // a check point in each
    for (CaseRow& row : listed.rows->block(k)) file.cases.push_back(std::move(row.content));
  return std::move(file);
}

void take_as_told(Case& c) {
  constexpr double kSame = 1e-6;
  auto* input = std::get_if<WheelRailCase>(&c.content);
  if (input == nullptr) return;
  if (auto* file = std::get_if<GeometryFile>(&input->wheel.geometry))
    file->options.back_told =
        std::fabs(input->wheelset.flange_back_position - WheelsetDimensions{}.flange_back_position) > kSame;
}

ListedCases listed_cases_of(const CaseTable& document, const std::filesystem::path& name,
                            std::span<const std::string> overrides) {
  ListedCases listed;
  CaseFile& result = listed.file;
  result.path = name;
  result.title = name.stem().string();
  const std::vector<CaseOverride> changes = parse_overrides(overrides);
  const std::filesystem::path folder = name.parent_path();

  // Title and cases apart, everything at the top is common to all cases.
  CaseTable common;
  const CaseEntry *entries = nullptr, *table = nullptr;
  Case defaults = case_without_keys(false);
  defaults.where = {name.string(), 1, 1};
  for (const CaseEntry& entry : document) {
    if (entry.key == "title") {
      if (!std::holds_alternative<std::string>(entry.value.data))
        throw Error(ErrorKind::configuration, fmt::format("title must be text, found {}", entry.value.kind()),
                    entry.value.where);
      result.title = entry.value.text();
    } else if (entry.key == "cases") {
      if (!entry.value.is_list() || entry.value.list().empty())
        throw Error(ErrorKind::configuration, "cases must be a list of tables, [[cases]]", entry.value.where);
      entries = &entry;
    } else if (entry.key == "cases_file") {
      if (!std::holds_alternative<std::string>(entry.value.data))
        throw Error(ErrorKind::configuration, fmt::format("cases_file must be text, found {}", entry.value.kind()),
                    entry.value.where, "give the name of a table: cases_file = \"places.csv\"");
      table = &entry;
    } else {
      if (entry.key == "patch") defaults.content = case_without_keys(true).content;
      common.push_back(entry);
    }
  }
  apply_table(defaults, common, folder);

  const auto note_motion = [&] {
    const auto still = [](const Case& c) { return !doubt_about_motion(c).empty(); };
    if (const auto first = ranges::find_if(result.cases, still); first != result.cases.end())
      result.notes.push_back(fmt::format("case {}: {}", first->number, doubt_about_motion(*first)));
  };
  if (table != nullptr) {
    if (entries != nullptr)
      throw Error(ErrorKind::configuration, "cases and cases_file exclude each other", table->key_where,
                  "give one of them");
    listed.rows = std::make_shared<const CaseRows>(folder / profiles::portable_path(table->value.text()), defaults,
                                                   folder, changes);
    result.cases.push_back(std::move(listed.rows->block(0).front().content));
    for (const std::string& column : listed.rows->overridden())
      result.notes.push_back(fmt::format("the column {} of {} has no effect: an override takes its place", column,
                                         listed.rows->file().string()));
    note_motion();
    return listed;
  }

  Expansion expansion{defaults, folder, changes, result.cases, {}, {}, {}};
  if (entries == nullptr) {
    expansion.expand({}, defaults.where);
  } else {
    for (const CaseValue& entry : entries->value.list()) {
      if (!entry.is_table())
        throw Error(ErrorKind::configuration, fmt::format("[[cases]] must be tables, found {}", entry.kind()),
                    entry.where);
      expansion.expand(entry.table(), entry.where);
    }
  }

  if (expansion.kept.size() < expansion.given.size())
    result.notes.push_back(
        fmt::format("only {} of {} different cases still differ: overrides set what the others had of "
                    "their own",
                    expansion.kept.size(), expansion.given.size()));

  int number = 0;
  for (Case& c : result.cases) {
    c.number = ++number;
    take_as_told(c);
    validate_case(c);
  }
  settle_sequences(result.cases, &result.notes);
  note_motion();
  return listed;
}

CaseFile case_file_of(const CaseTable& document, const std::filesystem::path& name,
                      std::span<const std::string> overrides) {
  return all_cases(listed_cases_of(document, name, overrides));
}

namespace {

void refuse_other_kinds(const CaseTable& document, const std::filesystem::path& name) {
  const auto refuse = [&](const char* what, const char* advice) {
    throw Error(ErrorKind::configuration, fmt::format("{} is {}", name.string(), what), {}, advice);
  };
  switch (kind_of(document)) {
    case FileKind::study:
      return refuse("a study", "use treadmark sweep");
    case FileKind::evolution:
      return refuse("an evolution", "use treadmark evolve");
    case FileKind::design:
      return refuse("a design", "use treadmark design");
    case FileKind::simulation:
      return refuse("a simulation", "use treadmark simulate");
    default:
      return;
  }
}

}  // namespace

ListedCases parse_listed_cases(std::string_view text, const std::filesystem::path& name,
                               std::span<const std::string> overrides) {
  const CaseTable document = parse_toml(text, name.string());
  refuse_other_kinds(document, name);
  ListedCases result = listed_cases_of(document, name, overrides);
  result.file.sha256 = sha256_hex(text);
  return result;
}

CaseFile parse_case_text(std::string_view text, const std::filesystem::path& name,
                         std::span<const std::string> overrides) {
  return all_cases(parse_listed_cases(text, name, overrides));
}

void apply_overrides(CaseFile& target, std::span<const std::string> overrides) {
  const std::vector<CaseOverride> changes = parse_overrides(overrides);
  if (changes.empty()) return;
  refuse_steps(changes);
  std::vector<Case> changed = target.cases;
  for (Case& c : changed) {
    for (const CaseOverride& change : changes) apply_assignment(c, change, target.path.parent_path());
    take_as_told(c);
    validate_case(c);
  }
  settle_sequences(changed);
  target.cases = std::move(changed);
}

CaseFile read_case_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_case_text(read_text(file), file, overrides);
}

void apply_override(Case& target, std::string_view assignment) {
  const CaseOverride change = parse_override(assignment);
  refuse_steps({change});
  Case changed = target;
  apply_assignment(changed, change, std::filesystem::path(target.where.file).parent_path());
  take_as_told(changed);
  validate_case(changed);
  target = std::move(changed);
}

namespace {

using KeyNames = std::array<std::string_view, 2>;  // in two units, or one and none

struct TrackMotion {
  KeyNames keys;
  double Track::*position;
  double Track::*rate;
};

constexpr TrackMotion kTrack[] = {
    {{"track.irregularity_y_mm"}, &Track::dy, &Track::vy},
    {{"track.irregularity_z_mm"}, &Track::dz, &Track::vz},
    {{"track.irregularity_roll_deg", "track.irregularity_roll_rad"}, &Track::roll, &Track::vroll},
};

constexpr double SixMotion::*kAxes[] = {&SixMotion::x,    &SixMotion::y,   &SixMotion::z,
                                        &SixMotion::roll, &SixMotion::yaw, &SixMotion::pitch};
constexpr KeyNames kWheelset[] = {{"wheelset.s_mm"},
                                  {"wheelset.y_mm"},
                                  {"wheelset.z_mm"},
                                  {"wheelset.roll_deg", "wheelset.roll_rad"},
                                  {"wheelset.yaw_deg", "wheelset.yaw_rad"},
                                  {"wheelset.pitch_deg", "wheelset.pitch_rad"}};
constexpr KeyNames kDeviation[] = {{"wheelset.deviation_x_mm"},
                                   {"wheelset.deviation_y_mm"},
                                   {"wheelset.deviation_z_mm"},
                                   {"wheelset.deviation_roll_deg", "wheelset.deviation_roll_rad"},
                                   {"wheelset.deviation_yaw_deg", "wheelset.deviation_yaw_rad"},
                                   {"wheelset.deviation_pitch_deg", "wheelset.deviation_pitch_rad"}};

/// Forward; on a roller that of its surface.
double rolling_velocity(const WheelRailCase& c) {
  return c.roller ? std::abs(c.roller->pitch_rate * c.roller->nominal_radius) : std::abs(c.state.velocity.x);
}

double step_in_time(const WheelRailCase& c, const Case& whole) {
  if (c.regime == Regime::shift) return 1.0;
  if (whole.time_step > 0.0) return whole.time_step;
  const double velocity = rolling_velocity(c);
  if (!(velocity > 0.0))
    throw Error(ErrorKind::configuration, "case.steps needs a velocity to know where the next case is", whole.where,
                "give wheelset.velocity_m_s, roller.pitch_rate_rad_s or case.time_step_s");
  return c.discretisation.dq_relative * c.discretisation.dx / velocity;
}

using Given = std::function<bool(std::string_view)>;

void move(SixMotion& to, const SixMotion& from, const SixMotion& rate, const KeyNames (&keys)[6], double dt,
          const Given& given) {
  for (std::size_t i = 0; i < std::size(kAxes); ++i)
    if (ranges::none_of(keys[i], given)) to.*kAxes[i] = from.*kAxes[i] + rate.*kAxes[i] * dt;
}

}  // namespace

void settle_rolling_step(Case& c) {
  auto* rail = std::get_if<WheelRailCase>(&c.content);
  if (rail == nullptr || !(c.time_step > 0.0) || rail->regime != Regime::transient) return;
  const double rolled = rolling_velocity(*rail) * c.time_step;
  if (rolled > 0.0) rail->discretisation.dq_relative = rolled / rail->discretisation.dx;
}

void move_on(Case& next, const Case& previous, const std::function<bool(std::string_view)>& given) {
  auto* to = std::get_if<WheelRailCase>(&next.content);
  const auto* from = std::get_if<WheelRailCase>(&previous.content);
  if (to == nullptr || from == nullptr) return;
  const double dt = step_in_time(*to, next);
  SixMotion rates = to->state.velocity;
  // The rate that a force will ask for is not known yet, but it is close to that of free rolling.
  if (to->longitudinal_force && rates.pitch == 0.0) rates.pitch = rolling_rate(*to);
  move(to->state.position, from->state.position, rates, kWheelset, dt, given);
  move(to->state.wheel_offset, from->state.wheel_offset, to->state.wheel_velocity, kDeviation, dt, given);
  for (const TrackMotion& m : kTrack)
    if (ranges::none_of(m.keys, given)) to->track.*m.position = from->track.*m.position + to->track.*m.rate * dt;
}

}  // namespace treadmark::io
