// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <charconv>
#include <optional>

#include "treadmark/io/meshes/mesh_builder.hpp"
#include "treadmark/io/meshes/parse_mesh.hpp"
#include "treadmark/io/profiles/line_scanner.hpp"

namespace treadmark::io::meshes {

namespace {

using profiles::LineScanner;
using profiles::printable;
using profiles::Word;

/// "7", "7/1", "7//3", "7/1/3" or negative, counted back from the newest vertex. The number before the first stroke.
std::uint32_t corner_of(const LineScanner& scanner, const Word& word, std::size_t vertices) {
  const std::string_view text = word.text.substr(0, word.text.find('/'));
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty())
    scanner.fail("a vertex number is expected, this is " + printable(word.text), word.column);
  const auto count = static_cast<std::int64_t>(vertices);
  if (index == 0 || index > count || index < -count)
    scanner.fail(fmt::format("a face names the vertex {}, so far there are {}", index, vertices), word.column,
                 "numbers count from 1, or back from -1");
  return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
}

}  // namespace

TriangleMesh parse_obj(std::string_view text, const std::string& file, double scale) {
  LineScanner scanner(text, file);
  MeshBuilder builder(file, scale);
  const MeshBuilder::Fail fail = [&](const std::string& message, const std::string& advice) {
    scanner.fail(message, 0, advice);
  };
  std::vector<std::uint32_t> corners;
  while (scanner.next_line()) {
    if (const std::size_t comment = scanner.line().find('#'); comment != std::string_view::npos) scanner.cut(comment);
    const std::optional<Word> key = scanner.next_word();
    if (!key || (key->text != "v" && key->text != "f")) continue;  // normals, textures, groups, materials
    if (scanner.line().ends_with('\\'))
      scanner.fail("continued lines are not read", 0, "write each vertex and face on a line of its own");
    if (key->text == "v") {
      double p[3];
      for (double& c : p) {
        const std::optional<Word> word = scanner.next_word();
        if (!word) scanner.fail("a vertex needs three coordinates");
        c = to_number(scanner, *word);
      }
      builder.add_vertex(p[0], p[1], p[2], fail);
    } else {
      corners.clear();
      while (const std::optional<Word> word = scanner.next_word())
        corners.push_back(corner_of(scanner, *word, builder.vertex_count()));
      builder.add_polygon(corners, fail);
    }
  }
  return builder.finish();
}

}  // namespace treadmark::io::meshes
