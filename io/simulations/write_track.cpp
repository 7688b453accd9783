// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/write_track.hpp"

#include <fmt/format.h>

#include <span>

#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"

namespace treadmark::io {
namespace {

std::string number_list(std::span<const double> values) { return fmt::format("[{}]", fmt::join(values, ", ")); }
std::string point_list(const Vec3& p) { return number_list(std::span(p.data(), 3)); }

/// The first or last three values of a spring as a key, nothing where all are zero.
std::string spring_line(const std::string& key, const SixValues& values, bool rotations) {
  const auto part = std::span(values).subspan(rotations ? 3 : 0, 3);
  for (const double value : part)
    if (value != 0.0) return fmt::format("{} = {}\n", key, number_list(part));
  return {};
}

std::string body_text(const BodySpec& body) {
  std::string free;
  for (int f = 0; f < kFreedoms; ++f)
    if (body.free.at(static_cast<std::size_t>(f)))
      free += fmt::format("{}\"{}\"", free.empty() ? "" : ", ", freedom_word(f));
  std::string text = fmt::format("\n[[bodies]]\nname = {}\nmass_kg = {}\n", toml_text(body.name), body.mass);
  if (!body.inertia.isZero(0.0)) text += fmt::format("inertia_kg_m2 = {}\n", point_list(body.inertia));
  return text + fmt::format("position_m = {}\nfree = [{}]\n", point_list(body.position), free);
}

std::string spring_text(const SpringSpec& spring) {
  return fmt::format("\n[[springs]]\nname = {}\nbetween = [{}, {}]\nat_m = [{}]\n", toml_text(spring.name),
                     toml_text(spring.body_a), toml_text(spring.body_b), point_list(spring.position)) +
         spring_line("stiffness_N_per_m", spring.stiffness, false) +
         spring_line("damping_N_s_per_m", spring.damping, false) +
         spring_line("damper_stiffness_N_per_m", spring.damper_stiffness, false) +
         spring_line("rotational_stiffness_N_m_per_rad", spring.stiffness, true) +
         spring_line("rotational_damping_N_m_s_per_rad", spring.damping, true) +
         spring_line("rotational_damper_stiffness_N_m_per_rad", spring.damper_stiffness, true);
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
