// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::app {
namespace {

io::KeyTable<MeasureRequest> list_measure_keys() {
  using R = MeasureRequest;
  using Alignment = measures::RailAlignment;
  io::KeyRows<R> keys;
  keys.text("nominal", "Profile that wear is counted against: a name of 'treadmark list profiles' or a file",
            &R::nominal)
      .option("--nominal PROFILE");
  keys.value(io::key_info("limits", io::KeyType::text, "TOML file of limits: tables [wheel], [rail] and [roughness]"),
             &R::limits)
      .option("--limits FILE")
      .read_by([](R& r, const io::CaseValue& file) { r.limits = read_limits(file.text()); })
      .written([](const R& r) { return io::toml_text(r.limits.file); });
  keys.number("nominal_radius_mm", io::kPositive, "Wheel radius at profile z = 0", &R::nominal_radius)
      .option("--nominal-radius MM");
  std::vector<std::pair<std::string, std::optional<Alignment>>> alignments;
  for (const Alignment a : {Alignment::unworn, Alignment::top, Alignment::none})
    alignments.emplace_back(measures::name_of(a), a);
  keys.choice(
      "alignment", std::move(alignments),
      "Of a rail upon its nominal section: unworn (field side, underside, web, foot), top, none; default unworn "
      "for profiles, none for surfaces and scans",
      &R::alignment);
  keys.text("mate", "Profile of the other wheel of the axle, in the same axes: back to back", &R::mate)
      .option("--mate PROFILE");
  keys.flag("as_in_file", "y = 0 of a wheel's file is the tape line, wherever the flange back is", &R::as_in_file);
  keys.flag("mirror_y", "Negate y of a profile's file, as of a left rail, whose gauge side is that of great y",
            &R::mirror_y);
  keys.number("scale", io::kPositive, "From the numbers of profile and triangle files to mm", &R::scale_to_mm);
  keys.integer("stations", 1, 100000, "Sections along a rail or round a wheel", &R::stations);
  keys.number("line_mm", io::kAnyNumber, "y of the line along a rail whose roughness is told", &R::line)
      .option("--line MM");
  keys.number("line_step_mm", io::kPositive, "Distance of its samples", &R::line_step).option("--line-step MM");
  return std::move(keys).done();
}

}  // namespace

const io::KeyTable<MeasureRequest>& measure_keys() {
  static const io::KeyTable<MeasureRequest> keys = list_measure_keys();
  return keys;
}

MeasureRequest measure_request(Body body, const io::GivenSettings& given) {
  MeasureRequest request;
  request.body = body;
  io::set_given(request, measure_keys(), given);
  const auto refuse = [](const char* what, const char* advice = "") {
    throw Error(ErrorKind::configuration, what, {}, advice);
  };
  if (body == Body::wheel && request.alignment)
    refuse("alignment belongs to rails", "wheels count from the flange back");
  if (body == Body::rail && request.as_in_file) refuse("as_in_file belongs to wheels", "say alignment none");
  if (body == Body::rail && !request.mate.empty()) refuse("mate is the other wheel of one wheel");
  if (body == Body::rail && request.nominal_radius > 0.0) refuse("nominal_radius_mm belongs to wheels", "leave it out");
  const MeasureRequest usual;
  if (body == Body::wheel && (request.line != usual.line || request.line_step != usual.line_step))
    refuse("line_mm and line_step_mm belong to rails", "leave them out");
  return request;
}

}  // namespace treadmark::app
