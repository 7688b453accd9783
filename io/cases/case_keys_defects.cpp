// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <utility>

#include "treadmark/io/cases/shared_keys.hpp"

namespace treadmark::io {

namespace {

using W = WheelRailCase;

template <class Element>
using Keys = std::vector<ElementKey<Element>>;

template <class Element>
void append(Keys<Element>& keys, Keys<Element> more) {
  for (auto& key : more) keys.push_back(std::move(key));
}

/// What case files say of one kind of defect.
template <class Element>
struct DefectKeys {
  const char* doc;
  Keys<Element> keys;
};

/// y_center_mm and width_mm of the shapes that fade sideways.
template <class Element>
Keys<Element> band_keys(const std::string& body) {
  return {
      with_default(element_number<Element>("y_center_mm", kAnyNumber,
                                           "lateral middle in " + body + " profile coordinates", &Element::y_center),
                   "0"),
      with_default(element_number<Element>("width_mm", kNotNegative,
                                           "lateral width over which it fades to 0; 0 = whole width", &Element::width),
                   "0")};
}

/// x_start_mm, x_end_mm and ramp_mm of a stretch of rail.
template <class Element>
Keys<Element> stretch_keys() {
  return {
      required(element_number<Element>("x_start_mm", kAnyNumber, "where it begins along the rail", &Element::x_start)),
      required(element_number<Element>("x_end_mm", kAnyNumber, "where it ends", &Element::x_end)),
      required(
          element_number<Element>("ramp_mm", kPositive, "length of the run-in and of the run-out", &Element::ramp))};
}

/// edge_radius_mm of the shapes that end in edges.
template <class Element>
ElementKey<Element> edge_key(const std::string& edges) {
  return with_default(
      element_number<Element>("edge_radius_mm", kNotNegative,
                              "radius of " + edges + "; 0 = sharp, where the largest pressure has no limit",
                              &Element::edge_radius),
      "0");
}

DefectKeys<WheelFlat> keys_of(const std::vector<WheelFlat>&) {
  using Shape = WheelFlat::Shape;
  KeyInfo shape = key_info("shape", KeyType::choice,
                           "rounded: cosine dent; fresh: straight chord whose depth follows from the length");
  shape.choices = {"rounded", "fresh"};
  shape.default_text = "\"rounded\"";
  Keys<WheelFlat> keys{
      {shape,
       [](WheelFlat& f, const CaseValue& v) { f.shape = v.text() == "fresh" ? Shape::fresh : Shape::rounded; },
       {},
       [](const WheelFlat& f) { return toml_text(f.shape == Shape::fresh ? "fresh" : "rounded"); }},
      required(element_number<WheelFlat>("length_mm", kPositive, "length along the circumference", &WheelFlat::length)),
      element_number<WheelFlat>("depth_mm", kPositive, "greatest radial depth; required for rounded flats only",
                                &WheelFlat::depth)};
  append(keys, element_angle<WheelFlat>("theta_center", "angle of the middle on the wheel", &WheelFlat::theta_center));
  append(keys, band_keys<WheelFlat>("wheel"));
  keys.push_back(edge_key<WheelFlat>("the edges of a fresh flat"));
  return {"flats worn into the wheel", std::move(keys)};
}

DefectKeys<Polygonization> keys_of(const std::vector<Polygonization>&) {
  using Harmonic = Polygonization::Harmonic;
  constexpr double kHighestOrder = 10000.0;
  KeyInfo order = key_info("order", KeyType::integer, "waves round the circumference");
  order.required = true;
  order.at_least = 1.0;
  order.at_most = kHighestOrder;
  Keys<Harmonic> harmonic{
      {order,
       [](Harmonic& h, const CaseValue& v) { h.order = static_cast<int>(v.integer()); },
       {},
       [](const Harmonic& h) { return std::to_string(h.order); }},
      required(element_number<Harmonic>("amplitude_um", kAnyNumber, "half of peak to peak, of the radius",
                                        &Harmonic::amplitude))};
  append(harmonic, element_angle<Harmonic>("phase", "the radius is greatest at theta = phase/order", &Harmonic::phase));
  Keys<Polygonization> keys{element_list<Polygonization, Harmonic>("harmonics", "waves that add up",
                                                                   std::move(harmonic), &Polygonization::harmonics)};
  append(keys, band_keys<Polygonization>("wheel"));
  return {"out-of-roundness of the wheel as waves of its radius", std::move(keys)};
}

DefectKeys<Squat> keys_of(const std::vector<Squat>&) {
  const auto number = [](const char* name, KeyLimits limits, const char* doc, double Squat::*member) {
    return element_number<Squat>(name, limits, doc, member);
  };
  return {
      "squats: depressions of the running band with one dip or two",
      {required(number("length_mm", kPositive, "length of the first dip", &Squat::length)),
       required(number("width_mm", kPositive, "width of the first dip", &Squat::width)),
       required(number("depth_mm", kPositive, "depth of the first dip", &Squat::depth)),
       with_default(number("x_center_mm", kAnyNumber, "middle of the first dip along the rail", &Squat::x_center), "0"),
       with_default(
           number("y_center_mm", kAnyNumber, "middle of the first dip in rail profile coordinates", &Squat::y_center),
           "0"),
       with_default(number("second_depth_mm", kNotNegative, "depth of the second dip; 0 = none", &Squat::second_depth),
                    "0"),
       number("second_length_mm", kPositive, "length of the second dip; without it that of the first",
              &Squat::second_length),
       number("second_width_mm", kPositive, "width of the second dip; without it that of the first",
              &Squat::second_width),
       with_default(number("second_distance_mm", kNotNegative,
                           "from the first middle back (towards -x) to the second one", &Squat::second_distance),
                    "0"),
       with_default(
           number("second_y_offset_mm", kAnyNumber, "lateral shift of the second middle", &Squat::second_y_offset),
           "0")}};
}

DefectKeys<Corrugation> keys_of(const std::vector<Corrugation>&) {
  using Wave = Corrugation::Wave;
  Keys<Wave> wave{required(element_number<Wave>("wavelength_mm", kPositive, "wavelength", &Wave::wavelength)),
                  required(element_number<Wave>("amplitude_um", kAnyNumber, "half of peak to peak", &Wave::amplitude))};
  append(wave,
         element_angle<Wave>("phase", "the rail is deepest at x = x_start + phase/(2 pi) wavelength", &Wave::phase));
  Keys<Corrugation> keys{
      element_list<Corrugation, Wave>("waves", "waves that add up", std::move(wave), &Corrugation::waves)};
  append(keys, stretch_keys<Corrugation>());
  append(keys, band_keys<Corrugation>("rail"));
  return {"corrugated stretches of the rail", std::move(keys)};
}

DefectKeys<GaugeCornerCollapse> keys_of(const std::vector<GaugeCornerCollapse>&) {
  using Collapse = GaugeCornerCollapse;
  KeyInfo towards =
      key_info("towards", KeyType::choice, "side of the corner: \"-y\" is the gauge side, also of a left rail");
  towards.choices = {"-y", "+y"};
  towards.default_text = "\"-y\"";
  return {"stretches where the gauge corner has sunk",
          {required(element_number<Collapse>("length_mm", kPositive, "length of the trough along the rail",
                                             &Collapse::length)),
           required(element_number<Collapse>("depth_mm", kPositive, "greatest depth", &Collapse::depth)),
           required(element_number<Collapse>("width_mm", kPositive, "lateral distance over which the depth grows",
                                             &Collapse::width)),
           with_default(
               element_number<Collapse>("x_center_mm", kAnyNumber, "middle along the rail", &Collapse::x_center), "0"),
           required(element_number<Collapse>("y_start_mm", kAnyNumber, "where it begins, in rail profile coordinates",
                                             &Collapse::y_start)),
           {towards,
            [](Collapse& g, const CaseValue& v) { g.gauge_side = v.text() == "+y" ? 1 : -1; },
            {},
            [](const Collapse& g) { return toml_text(g.gauge_side > 0 ? "+y" : "-y"); }}}};
}

/// What spalls of both bodies have.
template <class Pit>
Keys<Pit> pit_keys(const char* length_doc) {
  return {required(element_number<Pit>("length_mm", kPositive, length_doc, &Pit::length)),
          required(element_number<Pit>("width_mm", kPositive, "width over the rims", &Pit::width)),
          required(element_number<Pit>("depth_mm", kPositive, "depth of the floor", &Pit::depth)),
          required(element_number<Pit>("edge_mm", kPositive, "width of the edge, over which the floor is reached",
                                       &Pit::edge))};
}

DefectKeys<Spall> keys_of(const std::vector<Spall>&) {
  Keys<Spall> keys = pit_keys<Spall>("length over the rims");
  append(
      keys,
      {with_default(element_number<Spall>("x_center_mm", kAnyNumber, "middle along the rail", &Spall::x_center), "0"),
       with_default(
           element_number<Spall>("y_center_mm", kAnyNumber, "middle in rail profile coordinates", &Spall::y_center),
           "0")});
  return {"spalls: chips broken out of the running band, pits with a flat floor", std::move(keys)};
}

DefectKeys<WheelSpall> keys_of(const std::vector<WheelSpall>&) {
  Keys<WheelSpall> keys = pit_keys<WheelSpall>("length over the rims, along the circumference");
  append(keys,
         element_angle<WheelSpall>("theta_center", "angle of the middle on the wheel", &WheelSpall::theta_center));
  append(keys, {with_default(element_number<WheelSpall>("y_center_mm", kAnyNumber,
                                                        "middle in wheel profile coordinates", &WheelSpall::y_center),
                             "0")});
  return {"spalls: chips broken out of the tread, pits with a flat floor", std::move(keys)};
}

DefectKeys<FlattenedHead> keys_of(const std::vector<FlattenedHead>&) {
  Keys<FlattenedHead> keys = stretch_keys<FlattenedHead>();
  keys.push_back(required(element_number<FlattenedHead>(
      "depth_mm", kPositive, "depth of the plane below the highest point of the rail", &FlattenedHead::depth)));
  append(keys, element_angle<FlattenedHead>("roll", "inclination of the plane about x", &FlattenedHead::roll));
  keys.push_back(edge_key<FlattenedHead>("the edges across the rail"));
  return {"stretches where the head is worn down to a plane", std::move(keys)};
}

DefectKeys<MillingPath> keys_of(const std::vector<MillingPath>&) {
  using Station = MillingPath::Station;
  using Segment = MillingPath::Segment;
  Keys<Station> station{
      required(element_number<Station>("x_mm", kAnyNumber, "position along the rail, increasing", &Station::x)),
      with_default(element_number<Station>("y_mm", kAnyNumber, "where the origin of the section passes", &Station::y),
                   "0"),
      with_default(element_number<Station>("z_mm", kAnyNumber, "where the origin of the section passes, positive down",
                                           &Station::z),
                   "0")};
  append(station, element_angle<Station>("roll", "roll of the cutter about x", &Station::roll));
  Keys<MillingPath> keys{
      element_list<MillingPath, Station>("stations",
                                         "path of the cutter, at least two; natural cubic splines run through them",
                                         std::move(station), &MillingPath::stations),
      element_list<MillingPath, Segment>("section", "section of the cutter, a chain of arcs with increasing y",
                                         arc_keys<Segment>(), &MillingPath::section),
      with_default(element_number<MillingPath>("start_y_mm", kAnyNumber, "y where the section starts, from its origin",
                                               &MillingPath::start_y),
                   "0"),
      with_default(element_number<MillingPath>("start_z_mm", kAnyNumber, "z where the section starts, from its origin",
                                               &MillingPath::start_z),
                   "0")};
  append(keys, element_angle<MillingPath>("start_angle", "inclination atan(dz/dy) where the section starts",
                                          &MillingPath::start_angle));
  return {"cutters that remove what lies above their section along a path", std::move(keys)};
}

template <class Element>
std::vector<Element>* list_of(Defects& defects, const std::string& path) {
  std::vector<Element>* found = nullptr;
  Defects::each(defects, [&](const char* key, Body, auto& list) {
    if constexpr (std::is_same_v<decltype(list), std::vector<Element>&>)
      if (path == key) found = &list;
  });
  return found;
}

}  // namespace

void add_defect_keys(KeyList& list) {
  Defects::each(Defects{}, [&list]<class Element>(const char* path, Body body, const std::vector<Element>& kind) {
    DefectKeys<Element> keys = keys_of(kind);
    KeyInfo info = key_info(path, KeyType::table_list, keys.doc);
    info.scope = KeyScope::wheel_rail;
    add_list<Element>(list, std::move(info), std::move(keys.keys), [path, body](W& c, bool) {
      return list_of<Element>(body == Body::wheel ? c.wheel.defects : c.rail.defects, path);
    });
  });
}

}  // namespace treadmark::io
