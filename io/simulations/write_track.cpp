// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/write_track.hpp"

#include <fmt/format.h>

#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/io/simulations/vehicle_keys.hpp"

namespace treadmark::io {
namespace {

std::string body_text(const BodySpec& body) { return "\n[[bodies]]\n" + written_lines(body_keys(), body); }

std::string spring_text(const SpringSpec& spring) {
  return fmt::format("\n[[springs]]\nname = {}\n", toml_text(spring.name)) +
         written_lines(spring_place_keys(), Places{{spring.body_a, spring.body_b}, {spring.position}, {}}) +
         written_lines(spring_keys(), spring);
}

}  // namespace

std::string track_text(const TrackModel& track, const std::string& source, const std::vector<std::string>& comments) {
  std::string text;
  for (const std::string& line : comments) text += line.empty() ? "#\n" : "# " + line + '\n';
  text += fmt::format("\n[track]\nname = {}\n", toml_text(track.name));
  if (!source.empty()) text += fmt::format("source = {}\n", toml_text(source));
  text += fmt::format("rails = [{}, {}]\n", toml_text(track.left_rail), toml_text(track.right_rail));
  for (const BodySpec& body : track.bodies) text += body_text(body);
  for (const SpringSpec& spring : track.springs) text += spring_text(spring);
  return text;
}

}  // namespace treadmark::io
