// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <utility>

#include "treadmark/io/cases/shared_keys.hpp"

namespace treadmark::io {

namespace {

using W = WheelRailCase;
using Part = CrossingInput::Part;
using Key = ElementKey<SurfaceSource>;

constexpr KeyLimits kSlope{{}, -1.0, 1.0};

Part crossing_part(const CaseValue& v) {
  return v.text() == "nose" ? Part::nose : v.text() == "wing" ? Part::wing : Part::none;
}

std::string crossing_text(const SurfaceSource& s) {
  return s.crossing.part == Part::nose ? "\"nose\"" : s.crossing.part == Part::wing ? "\"wing\"" : "\"none\"";
}

KeyInfo crossing_key(std::string path) {
  KeyInfo info = key_info(std::move(path), KeyType::choice,
                          "the section moves along the track: \"nose\" rises and levels off, \"wing\" moves aside, see "
                          "[crossings.md](crossings.md)");
  info.choices = {"none", "nose", "wing"};
  info.default_text = "\"none\"";
  return info;
}

struct CrossingNumber {
  const char* name;
  KeyLimits limits;
  const char* doc;
  double CrossingInput::*member;
};
const CrossingNumber kCrossingNumbers[] = {
    {"crossing_x_mm", kAnyNumber, "where the nose levels off, or the wing starts to move (middle of the rounding)",
     &CrossingInput::x},
    {"crossing_slope", kSlope, "rise of the nose, or movement of the wing towards +y, per length of track",
     &CrossingInput::slope},
    {"crossing_length_mm", kPositive, "length over which it rises or moves; beyond it the section stays as it is",
     &CrossingInput::length},
    {"crossing_rounding_mm", kPositive, "length over which the slope changes, less than twice crossing_length_mm",
     &CrossingInput::rounding},
    {"crossing_y_mm", kAnyNumber, "lateral offset of the section before a wing moves; of a nose everywhere",
     &CrossingInput::y},
    {"crossing_z_mm", kAnyNumber, "height of a wing; final height of a nose, positive down", &CrossingInput::z},
};

void add_crossing_keys(KeyList& list) {
  KeyInfo crossing = crossing_key("rail.shape.crossing");
  crossing.scope = KeyScope::wheel_rail;
  CaseKey& moving = list.add(std::move(crossing));
  moving.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    content_of<W>(c).rail.crossing.part = crossing_part(v);
  };
  moving.text = [](const Case& c) { return crossing_text(std::get<W>(c.content).rail); };
  for (const CrossingNumber& n : kCrossingNumbers)
    list.number<W>(fmt::format("rail.shape.{}", n.name), n.limits, n.doc,
                   [m = n.member](W& c) -> double& { return c.rail.crossing.*m; });
}

Key geometry_key(std::string name, KeyType type, std::string doc) {
  KeyInfo info = key_info(name, type, std::move(doc));
  info.group = "shape";
  info.alternative = std::move(name);
  return {std::move(info), {}};
}

GeometryFile& file_of(SurfaceSource& s, const CaseValue& v, const char* key) {
  auto* file = std::get_if<GeometryFile>(&s.geometry);
  if (file == nullptr)
    throw Error(ErrorKind::configuration, fmt::format("{} belongs to a part given by a file", key), v.where);
  return *file;
}

Key arcs_key() {
  using Segment = ArcChain::Segment;
  const auto keys = arc_keys<Segment>();
  Key arcs = geometry_key("arcs", KeyType::table_list, "chain of arcs and straight lines with increasing y");
  for (const auto& key : keys) arcs.info.elements.push_back(key.info);
  const KeyInfo shared = arcs.info;
  arcs.set = [keys](SurfaceSource& s, const CaseValue& v) {
    if (!std::holds_alternative<ArcChain>(s.geometry)) s.geometry = ArcChain{};
    std::get<ArcChain>(s.geometry).segments = make_elements(keys, v);
  };
  arcs.set_nested = [keys, shared](SurfaceSource& s, std::string_view rest, const CaseEntry& entry) {
    const ElementPath place = split_element_path(shared, rest, entry.key_where);
    auto* chain = std::get_if<ArcChain>(&s.geometry);
    change_element(keys, chain == nullptr ? nullptr : &chain->segments, shared.path, place.index,
                   {{place.key, entry.key_where, entry.value}}, entry.key_where);
  };
  arcs.written = [keys](const SurfaceSource& s) {
    const auto* chain = std::get_if<ArcChain>(&s.geometry);
    return chain == nullptr ? std::string() : written_elements(keys, chain->segments);
  };
  return arcs;
}

std::vector<Key> geometry_keys() {
  std::vector<Key> keys;
  Key file =
      geometry_key("file", KeyType::path, "profile, slices or triangles file, relative to the folder of the case file");
  file.set = [](SurfaceSource& s, const CaseValue& v) {
    if (!std::holds_alternative<GeometryFile>(s.geometry)) s.geometry = GeometryFile{};
    std::string name = v.text();
    std::replace(name.begin(), name.end(), '\\', '/');
    std::get<GeometryFile>(s.geometry).file = name;
    s.where = v.where;
  };
  Key standard = geometry_key("standard", KeyType::text, "standard profile by its name: treadmark list profiles");
  standard.set = [](SurfaceSource& s, const CaseValue& v) {
    s.geometry = StandardProfile{v.text()};
    s.where = v.where;
  };
  // The list of parts knows the folder that files count from.
  file.written = [](const SurfaceSource& s) {
    const auto* given = std::get_if<GeometryFile>(&s.geometry);
    return given == nullptr || given->file.empty() ? std::string() : toml_text(given->file.generic_string());
  };
  standard.written = [](const SurfaceSource& s) {
    const auto* given = std::get_if<StandardProfile>(&s.geometry);
    return given == nullptr ? std::string() : toml_text(given->name);
  };
  keys = {file, standard, arcs_key()};
  const auto start = [&](const char* name, const char* doc, double ArcChain::*member) {
    keys.push_back(with_default(
        element_number<SurfaceSource>(name, kAnyNumber, doc, [](SurfaceSource& s) -> double& { return s.offset.x(); }),
        "0"));
    keys.back().set = [name, member, unit = unit_of_key(name)](SurfaceSource& s, const CaseValue& v) {
      auto* chain = std::get_if<ArcChain>(&s.geometry);
      if (chain == nullptr)
        throw Error(ErrorKind::configuration, fmt::format("{} belongs to a part given by arcs", name), v.where);
      chain->*member = v.number() * unit;
    };
    keys.back().written = [member, unit = unit_of_key(name)](const SurfaceSource& s) {
      const auto* chain = std::get_if<ArcChain>(&s.geometry);
      return chain == nullptr || chain->*member == 0.0 ? std::string() : exact_text(chain->*member, unit);
    };
  };
  start("start_y_mm", "y where the chain of arcs starts", &ArcChain::start_y);
  start("start_z_mm", "z where the chain of arcs starts", &ArcChain::start_z);
  start("start_angle_deg", "inclination atan(dz/dy) where the chain of arcs starts", &ArcChain::start_angle);
  KeyInfo mirror = key_info("mirror_y", KeyType::flag, "negate y of the file");
  mirror.default_text = "false";
  keys.push_back(
      {mirror,
       [](SurfaceSource& s, const CaseValue& v) { file_of(s, v, "mirror_y").options.mirror_y = v.flag() ? 1 : -1; },
       {},
       [](const SurfaceSource& s) {
         const auto* given = std::get_if<GeometryFile>(&s.geometry);
         return std::string(given != nullptr && given->options.mirror_y == 1 ? "true" : "");
       }});
  KeyInfo scale = key_info("scale_to_mm", KeyType::number, "factor from file units to mm (1000 for a file in m)");
  scale.at_least = 1e-6;
  scale.default_text = "1";
  keys.push_back({scale,
                  [](SurfaceSource& s, const CaseValue& v) { file_of(s, v, "scale_to_mm").options.scale = v.number(); },
                  {},
                  [](const SurfaceSource& s) {
                    const auto* given = std::get_if<GeometryFile>(&s.geometry);
                    return given == nullptr || given->options.scale == 1.0 ? std::string()
                                                                           : exact_text(given->options.scale, 1.0);
                  }});
  return keys;
}

std::vector<Key> part_keys() {
  std::vector<Key> keys = geometry_keys();
  const char* axes[] = {"x_mm", "y_mm", "z_mm"};
  for (int axis = 0; axis < 3; ++axis)
    keys.push_back(with_default(
        element_number<SurfaceSource>(axes[axis], kAnyNumber, "offset of the part in the frame of the rail",
                                      [axis](SurfaceSource& s) -> double& { return s.offset[axis]; }),
        "0"));
  KeyInfo backend = backend_key("backend", "surface representation of this part; without it that of the rail");
  keys.push_back({backend,
                  [](SurfaceSource& s, const CaseValue& v) { s.backend = v.text(); },
                  {},
                  [](const SurfaceSource& s) { return s.backend.empty() ? s.backend : toml_text(s.backend); }});
  keys.push_back(element_number<SurfaceSource>("resolution_mm", kPositive,
                                               "spacing of samples of this part; without it that of the rail",
                                               &SurfaceSource::resolution));
  keys.push_back({crossing_key("crossing"),
                  [](SurfaceSource& s, const CaseValue& v) { s.crossing.part = crossing_part(v); },
                  {},
                  crossing_text});
  const CrossingInput fresh;
  for (const CrossingNumber& n : kCrossingNumbers)
    keys.push_back(with_default(
        element_number<SurfaceSource>(n.name, n.limits, n.doc,
                                      [m = n.member](SurfaceSource& s) -> double& { return s.crossing.*m; }),
        fmt::format("{:.10g}", fresh.*n.member / unit_of_key(n.name))));
  return keys;
}

/// Names of files are relative to the folder of the case file, which only the whole list knows.
void add_parts(KeyList& list) {
  KeyInfo info = key_info("rail.parts", KeyType::table_list,
                          "surfaces that together are the rail, instead of one shape: the outermost counts");
  info.scope = KeyScope::wheel_rail;
  add_list<SurfaceSource>(list, std::move(info), part_keys(), [](W& c, bool) { return &c.rail.parts; });
  CaseKey& added = list.keys.back();
  added.set = [set = added.set](Case& c, const CaseValue& v, const std::filesystem::path& folder) {
    set(c, v, folder);
    for (SurfaceSource& part : content_of<W>(c).rail.parts)
      if (auto* file = std::get_if<GeometryFile>(&part.geometry); file != nullptr && !file->file.empty())
        file->file = (folder / file->file).lexically_normal();
  };
  added.written = [written = added.written](const Case& c, const std::filesystem::path& folder) {
    Case relative = c;
    for (SurfaceSource& part : std::get<W>(relative.content).rail.parts)
      if (auto* file = std::get_if<GeometryFile>(&part.geometry); file != nullptr && !file->file.empty())
        file->file = relative_to(file->file, folder);
    return written(relative, folder);
  };
  added.set_element = [set = added.set_element](Case& c, std::size_t index, const CaseTable& entries,
                                                const SourcePosition& where) {
    for (const CaseEntry& entry : entries)
      if (entry.key == "file" && std::filesystem::path(entry.value.text()).is_relative())
        throw Error(ErrorKind::configuration, "the file of a part can only be replaced by one with its full path",
                    where);
    set(c, index, entries, where);
  };
}

}  // namespace

void add_part_keys(KeyList& list) {
  add_crossing_keys(list);
  add_parts(list);
}

}  // namespace treadmark::io
