// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark::io::splines {

/// An element of a file with where it stands.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  ///< all of it, without that of elements inside
  int line = 0, column = 0;
  /// From which character of the text on it stands where in the file (bytes).
  struct Piece {
    std::size_t text, file;
  };
  std::vector<Piece> pieces;
  std::vector<XmlElement> inside;

  /// Nothing where there is none of that name.
  const std::string* attribute(std::string_view wanted) const;
  const XmlElement* first(std::string_view wanted) const;
};

/// A text that is XML, as a tree. Entities are not declared and document types are refused, so that nothing grows.
class XmlTree {
 public:
  /// Holds a view: the text must outlive the tree. Errors: Error(input_data) with file:line:column for what is no XML,
  /// has a document type, is nested deeper than 32 or has more than 5 million elements; Error(configuration) in a build
  /// without Expat.
  XmlTree(std::string_view text, std::string file);

  const XmlElement& root() const { return root_; }
  const std::string& file() const { return file_; }
  SourcePosition where(const XmlElement& element) const { return {file_, element.line, element.column}; }
  /// Of a character of its text.
  SourcePosition where(const XmlElement& element, std::size_t in_text) const;

 private:
  std::string_view content_;
  std::string file_;
  XmlElement root_;
};

}  // namespace treadmark::io::splines
