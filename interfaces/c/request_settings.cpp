// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/c/request_settings.hpp"

#include <functional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/settings/key_info.hpp"
#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::c {
namespace {

/// One setting of a Root: what it takes, and where that goes.
template <class Root>
struct Setting {
  io::KeyInfo info;
  double si = 1.0;
  std::function<void(Root&, const io::CaseOverride&)> set;
};

double si_of(std::string_view key) {
  constexpr double kKilo = 1e3, kMilli = 1e-3;
  return key.ends_with("_kN") ? kKilo : key.ends_with("_mrad") ? kMilli : io::unit_of_key(key);
}

/// The value as it was written: "60E1" and "1:40" look like numbers to some.
std::string written_text(const io::CaseOverride& given) {
  const auto* text = std::get_if<std::string>(&given.value.data);
  return text != nullptr ? *text : given.raw;
}

template <class Root>
class SettingList {
 public:
  std::vector<Setting<Root>> all;

  /// place: Root& -> double& or std::optional<double>&, or the member.
  template <class Place>
  void number(std::string name, io::KeyLimits limits, Place place) {
    const double si = si_of(name);
    all.push_back(
        {io::key_info(std::move(name), io::KeyType::number, "", limits), si,
         [place, si](Root& root, const io::CaseOverride& v) { std::invoke(place, root) = si * v.value.number(); }});
  }
  /// A list, one number, or a text as the program takes it.
  template <class Place>
  void lengths(std::string name, Place place) {
    const double si = si_of(name);
    const io::KeyInfo info = io::key_info(std::move(name), io::KeyType::number_list, "", io::kPositive);
    Setting<Root> setting{info, si, {}};
    setting.info.type = io::KeyType::value_list;  // checked below: it has several forms
    setting.set = [place, si, info](Root& root, const io::CaseOverride& v) {
      if (v.value.is_list()) {
        io::check_value(info, v.value);
        if (v.value.list().empty())
          throw Error(ErrorKind::configuration, fmt::format("{} holds nothing", info.path), v.value.where);
        std::invoke(place, root) = io::numbers_of(v.value, si);
        return;
      }
      io::CaseValue list{v.value.where, std::vector<io::CaseValue>{}};
      std::vector<double> lengths = app::parse_lengths_mm(written_text(v));
      for (const double length : lengths)
        std::get<std::vector<io::CaseValue>>(list.data).push_back({v.value.where, length / si});
      io::check_value(info, list);
      std::invoke(place, root) = std::move(lengths);
    };
    all.push_back(std::move(setting));
  }
  void text(std::string name, std::function<void(Root&, const std::string&)> set) {
    all.push_back({io::key_info(std::move(name), io::KeyType::text, ""), 1.0,
                   [set = std::move(set)](Root& root, const io::CaseOverride& v) { set(root, v.value.text()); }});
  }
  void word(std::string name, const std::vector<std::string>& choices,
            std::function<void(Root&, const std::string&)> set) {
    text(std::move(name), std::move(set));
    all.back().info.type = io::KeyType::choice;
    all.back().info.choices = choices;
  }
};

std::vector<Setting<GeometryAsked>> list_geometry_settings() {
  using R = app::GeometryRequest;
  using S = geometry::AnalysisSettings;
  SettingList<GeometryAsked> list;
  const auto request = [](auto R::*member) {
    return [member](GeometryAsked& g) -> decltype(auto) { return (g.request.*member); };
  };
  const auto setting = [](auto S::*member) {
    return [member](GeometryAsked& g) -> decltype(auto) { return (g.request.settings.*member); };
  };
  const auto name = [&](const char* key, std::string R::*member) {
    list.text(key, [member](GeometryAsked& g, const std::string& text) { g.request.*member = text; });
  };
  const auto length = [&](const char* key, std::optional<double> R::*member) {
    list.number(key, io::kPositive, request(member));
  };
  name("case", &R::case_file);
  name("wheel", &R::wheel);
  name("wheel_left", &R::wheel_left);
  name("rail", &R::rail);
  name("rail_left", &R::rail_left);
  name("new_wheel", &R::new_wheel);
  name("new_rail", &R::new_rail);
  length("diameter_mm", &R::diameter);
  length("diameter_left_mm", &R::diameter_left);
  length("gauge_mm", &R::gauge);
  length("gauge_height_mm", &R::gauge_height);
  length("rail_origins_mm", &R::rail_origins);
  length("wheel_origins_mm", &R::wheel_origins);
  list.text("cant", [](GeometryAsked& g, const std::string& text) { g.request.cant = app::parse_cant(text); });
  list.lengths("amplitudes_mm", setting(&S::amplitudes));
  list.number("amplitude_mm", io::kPositive, setting(&S::wanted_amplitude));
  list.lengths("gauges_mm", &GeometryAsked::gauges);
  list.word("roll", {"none", "free"}, [](GeometryAsked& g, const std::string& word) {
    g.request.settings.roll = word == "free" ? geometry::Roll::free : geometry::Roll::none;
  });
  // limits are those of the program's options
  list.number("axle_load_kN", {{}, 1e-3, 1e4}, request(&R::axle_load));
  list.number("yaw_mrad", {{}, -50.0, 50.0}, setting(&S::yaw));
  list.number("step_mm", {{}, 0.005, 2.0}, setting(&S::step));
  list.number("second_mm", {{}, 0.0, 5.0}, setting(&S::second));
  list.number("pitch_deg", io::kAnyNumber, request(&R::pitch));
  list.number("position_mm", io::kAnyNumber, request(&R::x));
  list.number("scale", io::kPositive, request(&R::scale_to_mm));
  name("backend", &R::backend);
  list.number("resolution_mm", io::kPositive, request(&R::resolution));
  return std::move(list.all);
}

std::vector<Setting<app::MeasureRequest>> list_measure_settings() {
  using R = app::MeasureRequest;
  SettingList<R> list;
  const auto name = [&](const char* key, std::string R::*member) {
    list.text(key, [member](R& r, const std::string& text) { r.*member = text; });
  };
  name("nominal", &R::nominal);
  list.number("nominal_radius_mm", io::kPositive, &R::nominal_radius);
  list.text("limits", [](R& r, const std::string& file) { r.limits = app::read_limits(file); });
  list.word("alignment", {"unworn", "top", "none"}, [](R& r, const std::string& word) {
    for (const measures::RailAlignment a :
         {measures::RailAlignment::unworn, measures::RailAlignment::top, measures::RailAlignment::none})
      if (word == measures::name_of(a)) r.alignment = a;
  });
  name("mate", &R::mate);
  list.all.push_back({io::key_info("as_in_file", io::KeyType::flag, ""), 1.0,
                      [](R& r, const io::CaseOverride& v) { r.from_flange_back = !v.value.flag(); }});
  list.number("scale", io::kPositive, &R::scale_to_mm);
  constexpr double kMostStations = 100000.0;
  list.all.push_back({io::key_info("stations", io::KeyType::integer, "", {{}, 1.0, kMostStations}), 1.0,
                      [](R& r, const io::CaseOverride& v) { r.stations = static_cast<int>(v.value.integer()); }});
  list.number("line_mm", io::kAnyNumber, &R::line);
  list.number("line_step_mm", io::kPositive, &R::line_step);
  return std::move(list.all);
}

const std::vector<Setting<GeometryAsked>>& geometry_settings() {
  static const auto all = list_geometry_settings();
  return all;
}
const std::vector<Setting<app::MeasureRequest>>& measure_settings() {
  static const auto all = list_measure_settings();
  return all;
}

template <class Root>
std::vector<RequestKey> keys_of(const std::vector<Setting<Root>>& settings) {
  std::vector<RequestKey> keys;
  keys.reserve(settings.size());
  for (const Setting<Root>& setting : settings) keys.push_back({setting.info.path, setting.si});
  return keys;
}

template <class Root>
void apply_setting(Root& root, std::vector<std::string>& overrides, const std::vector<Setting<Root>>& settings,
                   const std::string& assignment) {
  io::CaseOverride given = io::parse_override(assignment);
  if (given.path.find('.') != std::string::npos) {
    overrides.push_back(assignment);
    return;
  }
  for (const Setting<Root>& setting : settings) {
    if (setting.info.path != given.path) continue;
    if (setting.info.type == io::KeyType::text) given.value.data = written_text(given);
    io::check_value(setting.info, given.value);
    setting.set(root, given);
    return;
  }
  std::vector<std::string> known;
  known.reserve(settings.size());
  for (const Setting<Root>& setting : settings) known.push_back(setting.info.path);
  const std::string nearest = io::nearest_key(given.path, known);
  throw Error(ErrorKind::configuration, fmt::format("there is no setting '{}'", given.path.substr(0, 100)),
              given.value.where,
              nearest.empty() ? fmt::format("there are {}", fmt::join(known, ", "))
                              : fmt::format("did you mean '{}'?", nearest));
}

[[noreturn]] void refuse_request(const char* what, const char* advice = "") {
  throw Error(ErrorKind::configuration, what, {}, advice);
}

}  // namespace

const std::vector<RequestKey>& geometry_keys() {
  static const std::vector<RequestKey> keys = keys_of(geometry_settings());
  return keys;
}

const std::vector<RequestKey>& measure_keys() {
  static const std::vector<RequestKey> keys = keys_of(measure_settings());
  return keys;
}

GeometryAsked geometry_asked(std::span<const std::string> settings) {
  GeometryAsked asked;
  app::GeometryRequest& r = asked.request;
  for (const std::string& one : settings) apply_setting(asked, r.overrides, geometry_settings(), one);
  if (r.settings.amplitudes.empty()) r.settings.amplitudes = app::parse_lengths_mm("1:7:0.1");  // as the program's
  // What the program says in the words of its command line.
  if (r.case_file.empty()) {
    if (r.wheel.empty()) refuse_request("no profile: wheel is missing", "name a file or a profile that is built in");
    if (r.rail.empty()) refuse_request("no profile: rail is missing", "name a file or a profile that is built in");
    if (!r.gauge && !r.rail_origins)
      refuse_request("where the rails are is not said",
                     "give the gauge with the cant, or the distance of rail_origins");
    if (!r.overrides.empty()) refuse_request("there is no case whose keys could change", "name its file as case");
  }
  if (r.gauge && r.rail_origins) refuse_request("gauge and rail_origins say the same thing twice", "give one of them");
  return asked;
}

app::MeasureRequest measure_asked(Body body, std::span<const std::string> settings) {
  app::MeasureRequest r;
  r.body = body;
  for (const std::string& one : settings) apply_setting(r, r.overrides, measure_settings(), one);
  if (body == Body::wheel && r.alignment)
    refuse_request("alignment belongs to rails", "wheels count from the flange back");
  if (body == Body::rail && !r.from_flange_back) refuse_request("as_in_file belongs to wheels", "say alignment none");
  if (body == Body::rail && !r.mate.empty()) refuse_request("mate is the other wheel of one wheel");
  return r;
}

std::string GeometryAnswer::json() const { return app::geometry_json(result, sweep ? &*sweep : nullptr); }

GeometryAnswer answer_geometry(const GeometryAsked& asked) {
  app::SectionStore store;
  GeometryAnswer answer{app::run_geometry(asked.request, store), {}};
  if (!asked.gauges.empty()) answer.sweep = app::sweep_gauge(answer.result, asked.gauges);
  return answer;
}

}  // namespace treadmark::c
