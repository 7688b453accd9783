// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/splines/xml_tree.hpp"

#include <algorithm>

namespace treadmark::io::splines {

const std::string* XmlElement::attribute(std::string_view wanted) const {
  for (const auto& [key, value] : attributes)
    if (key == wanted) return &value;
  return nullptr;
}

const XmlElement* XmlElement::first(std::string_view wanted) const {
  for (const XmlElement& element : inside)
    if (element.name == wanted) return &element;
  return nullptr;
}

SourcePosition XmlTree::where(const XmlElement& element, std::size_t in_text) const {
  const auto after = std::upper_bound(element.pieces.begin(), element.pieces.end(), in_text,
                                      [](std::size_t at, const XmlElement::Piece& piece) { return at < piece.text; });
  if (after == element.pieces.begin()) return where(element);
  const std::size_t at = std::min((after - 1)->file + in_text - (after - 1)->text, content_.size());
  const std::string_view before = content_.substr(0, at);
  const std::size_t line_begin = before.rfind('\n');
  return {file_, static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(line_begin == std::string_view::npos ? at : at - line_begin - 1) + 1};
}

}  // namespace treadmark::io::splines
