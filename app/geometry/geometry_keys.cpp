// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::app {
namespace {

using Request = GeometryRequest;
using Keys = io::KeyRows<Request>;
constexpr const char* kUsualAmplitudes = "1:7:0.1";  // [mm]

/// A length that may not be given.
void add_length(Keys& keys, const char* name, const char* doc, std::optional<double> Request::*member,
                unsigned marks = 0) {
  keys.number(name, io::kPositive, doc, member, marks).written([=](const Request& r) {
    return r.*member ? io::exact_text(*(r.*member), kMillimetre) : std::string();
  });
}

/// A list, one number, or from:to:step.
template <class Place>
Keys::Row add_lengths(Keys& keys, const char* name, const char* doc, Place place) {
  const io::KeyInfo list = io::key_info(name, io::KeyType::number_list, doc, io::kPositive);
  return keys.value(io::key_info(name, io::KeyType::value_list, doc), place)
      .read_by([place, list](Request& r, const io::CaseValue& given) {
        io::CaseValue lengths = given;
        if (!given.is_list()) {
          std::vector<io::CaseValue> numbers;
          for (const double number : parse_numbers(given.text())) numbers.push_back({given.where, number});
          lengths.data = std::move(numbers);
        }
        io::check_value(list, lengths);
        if (lengths.list().empty())
          throw Error(ErrorKind::configuration, fmt::format("{} holds nothing", list.path), given.where);
        std::invoke(place, r) = io::numbers_of(lengths, kMillimetre);
      })
      .written([place](const Request& r) {
        return io::exact_list(std::invoke(place, const_cast<Request&>(r)), kMillimetre);
      });
}

io::KeyTable<Request> list_geometry_keys() {
  using S = geometry::AnalysisSettings;
  const auto setting = [](auto S::*member) {
    return [member](Request& r) -> decltype(auto) { return (r.settings.*member); };
  };
  Keys keys;
  keys.text("case", "Case file (.toml or .inp): wheel, rail and track of its first case", &Request::case_file)
      .option("CASE");
  keys.text("wheel", "Profile, slices, triangles or offsets of both wheels, or of the right one; or a built-in name",
            &Request::wheel, kFileOfPair);
  keys.text("wheel_left", "Of the left wheel, given as for the right side", &Request::wheel_left, kFileOfPair)
      .option("--wheel-left FILE");
  keys.text("rail", "Of both rails, or of the right one", &Request::rail, kFileOfPair);
  keys.text("rail_left", "Of the left rail, given as for the right side", &Request::rail_left, kFileOfPair)
      .option("--rail-left FILE");
  keys.text("new_wheel", "The conicity with this profile in place of both wheels' too: effect of wear",
            &Request::new_wheel)
      .option("--new-wheel NAME");
  keys.text("new_rail", "The same with this profile in place of both rails'", &Request::new_rail)
      .option("--new-rail NAME");
  add_length(keys, "diameter_mm", "At the tape lines, 920 mm unless given", &Request::diameter, kOfPair);
  add_length(keys, "diameter_left_mm", "Of the left wheel", &Request::diameter_left, kOfPair);
  add_length(keys, "gauge_mm", "Distance of the rails' gauge points", &Request::gauge, kOfPair);
  add_length(keys, "gauge_height_mm",
             "Depth below the rail's top down to which the gauge is measured, 14 mm unless given",
             &Request::gauge_height);
  add_length(keys, "rail_origins_mm", "In place of the gauge: distance of the origins of the rails' profiles",
             &Request::rail_origins, kOfPair);
  add_length(keys, "wheel_origins_mm",
             "Distance of the origins of the wheels' profiles (tape lines), 1500 mm unless given",
             &Request::wheel_origins, kOfPair);
  keys.value(io::key_info("cant", io::KeyType::text,
                          "Inclination of the rails, 1:40 for example; 0 where the profile contains it"),
             &Request::cant, kOfPair)
      .option("--cant 1:N")
      .read_by([](Request& r, const io::CaseValue& given) { r.cant = parse_cant(given.text()); })
      .written([](const Request& r) { return r.cant ? io::exact_text(*r.cant, 1.0) : std::string(); });
  add_lengths(keys, "amplitudes_mm", "Of the conicity: 3, or 1,2,3, or 1:7.5:0.1 (from:to:step)",
              setting(&S::amplitudes))
      .shown(kUsualAmplitudes);
  keys.number("amplitude_mm", io::kPositive, "Of the single value, in place of the rule by the clearance",
              setting(&S::wanted_amplitude))
      .written([](const Request& r) {
        return r.settings.wanted_amplitude ? io::exact_text(*r.settings.wanted_amplitude, kMillimetre) : std::string();
      });
  add_lengths(keys, "gauges_mm", "The conicity at these gauges too: 1430:1440:1", &Request::gauges);
  keys.choice("roll", {{"none", geometry::Roll::none}, {"free", geometry::Roll::free}},
              "none: each side by itself, as EN 15302; free: rolls until both sides touch", setting(&S::roll));
  keys.number("axle_load_kN", {{}, 1e-3, 1e4},
              "What both wheels carry: normal forces by statics, Hertz' ellipses and pressures too",
              &Request::axle_load);
  keys.number("yaw_mrad", {{}, -50.0, 50.0}, "Of the wheelset", setting(&S::yaw), kEchoed);
  keys.number("step_mm", {{}, 0.005, 2.0}, "Of the shift", setting(&S::step), kEchoed);
  keys.number("second_mm", {{}, 0.0, 5.0}, "Gap up to which further contacts are listed; 0: none", setting(&S::second));
  keys.number("pitch_deg", io::kAnyNumber, "Angle of the wheels, which need not be round", &Request::pitch, kEchoed);
  keys.number("position_mm", io::kAnyNumber, "Place along rails that vary", &Request::x, kEchoed);
  keys.number("scale", io::kPositive, "Factor from units of profile files to mm", &Request::scale_to_mm);
  keys.text("backend", "Surface backend (see: treadmark list backends)", &Request::backend);
  keys.number("resolution_mm", io::kPositive, "Spacing of the data of that backend", &Request::resolution)
      .option("--resolution MM");
  return std::move(keys).done();
}

}  // namespace

const io::KeyTable<GeometryRequest>& geometry_keys() {
  static const io::KeyTable<GeometryRequest> keys = list_geometry_keys();
  return keys;
}

GeometryRequest geometry_request(const io::GivenSettings& given) {
  GeometryRequest request;
  for (const double mm : parse_numbers(kUsualAmplitudes)) request.settings.amplitudes.push_back(kMillimetre * mm);
  io::set_given(request, geometry_keys(), given);
  return request;
}

}  // namespace treadmark::app
