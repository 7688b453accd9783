// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/table_of.hpp"
#include "treadmark/io/simulations/vehicle_keys.hpp"

namespace treadmark::io {

namespace {

constexpr std::array<std::string_view, kFreedoms> kFreedomWords{"x", "y", "z", "roll", "pitch", "yaw"};

bool is_part_name(std::string_view text) {
  const auto good = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; };
  return std::isalpha(static_cast<unsigned char>(text.front())) && std::all_of(text.begin(), text.end(), good);
}

std::array<bool, kFreedoms> free_directions(const TableOf<BodySpec>& part) {
  const std::array<bool, kFreedoms> free = directions_of(part, part.key(&BodySpec::free));
  if (std::find(free.begin(), free.end(), true) == free.end())
    part.refuse(&BodySpec::free, fmt::format("{} is empty", part.path_of(&BodySpec::free)),
                "leave the body out, and connect with \"ground\" instead");
  return free;
}

void check_inertia(const TableOf<BodySpec>& part, const BodySpec& body) {
  const CaseValue* given = part.find(&BodySpec::inertia);
  for (int axis = 0; axis < 3; ++axis) {
    const auto rotation = static_cast<std::size_t>(axis + 3);
    if (!body.free.at(rotation) || body.inertia[axis] > 0.0) continue;
    const std::string what =
        fmt::format("the moment of inertia about {}", kFreedomWords.at(static_cast<std::size_t>(axis)));
    if (given == nullptr)
      part.fail(fmt::format("{}: {} is missing, but the body can {}", part.path(), what, kFreedomWords.at(rotation)),
                fmt::format("give {}", part.key(&BodySpec::inertia)));
    throw Error(
        ErrorKind::configuration,
        fmt::format("{}: {} must be positive, as the body can {}", part.path(), what, kFreedomWords.at(rotation)),
        given->where);
  }
}

void add_bodies(const CaseValue& table, std::vector<BodySpec>& bodies) {
  const std::string name = part_name(TableOf(table, "bodies", body_keys()));
  const TableOf part(table, "bodies." + name, body_keys());
  BodySpec body = part.read();
  body.where = part.where();
  body.free = free_directions(part);
  check_inertia(part, body);
  part.need(&BodySpec::position);
  const std::string_view key = part.key(&BodySpec::position);
  if (part.type_of(key) == KeyType::triple) {
    bodies.push_back(std::move(body));
    return;
  }
  int number = 0;
  for (const Vec3& position : part.points(key)) {
    body.name = fmt::format("{}{}", name, ++number);
    body.position = position;
    bodies.push_back(body);
  }
}

}  // namespace

std::array<bool, kFreedoms> directions_of(const TableReader& part, std::string_view key) {
  std::array<bool, kFreedoms> named{};
  const std::vector<std::string> words = part.words(key), known(kFreedomWords.begin(), kFreedomWords.end());
  const std::string path = part.path_of(key);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const SourcePosition& where = part.need(key).list()[i].where;
    check_name(fmt::format("the direction in {}", path), words[i], known, where);
    bool& direction =
        named.at(static_cast<std::size_t>(std::find(known.begin(), known.end(), words[i]) - known.begin()));
    if (direction) throw Error(ErrorKind::configuration, fmt::format("{} names '{}' twice", path, words[i]), where);
    direction = true;
  }
  return named;
}

std::string_view freedom_word(int freedom) { return kFreedomWords.at(static_cast<std::size_t>(freedom)); }

std::string part_name(const TableReader& part) {
  const std::string name = part.text("name");
  if (!is_part_name(name))
    throw Error(ErrorKind::configuration,
                fmt::format("{} = '{}' is no name of a part", part.path_of("name"), name.substr(0, 100)),
                part.need("name").where, "start with a letter, go on with letters, digits, '_' or '-'");
  return name;
}

std::vector<std::string> names_of(const std::vector<BodySpec>& bodies) {
  std::vector<std::string> names;
  for (const BodySpec& body : bodies) names.push_back(body.name);
  return names;
}

std::vector<BodySpec> read_bodies(const TableReader& document) {
  constexpr std::size_t kMostBodies = 200;
  std::vector<BodySpec> bodies;
  for (const CaseValue* table : document.tables("bodies")) add_bodies(*table, bodies);
  if (bodies.empty()) document.fail("there are no [[bodies]]");
  if (bodies.size() > kMostBodies) document.fail(fmt::format("{} bodies are more than {}", bodies.size(), kMostBodies));
  std::set<std::string> seen{kGround};
  for (const BodySpec& body : bodies)
    if (!seen.insert(body.name).second)
      throw Error(ErrorKind::configuration, fmt::format("there are two bodies named '{}'", body.name), body.where,
                  body.name == kGround ? "that is the name of what does not move" : "equal bodies are numbered from 1");
  return bodies;
}

}  // namespace treadmark::io
