// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/io/results/xml_reader.hpp"

#include <cctype>
#include <stdexcept>

namespace treadmark::testing {
namespace {

class Reader {
 public:
  explicit Reader(const std::string& document) : text_(document) {}

  XmlElement document() {
    if (text_.starts_with("<?xml")) at_ = text_.find("?>") + 2;
    space();
    XmlElement root = element();
    space();
    if (at_ != text_.size()) fail("text after the root");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error("XML at " + std::to_string(at_) + ": " + why);
  }
  char peek() const {
    if (at_ >= text_.size()) fail("unexpected end");
    return text_[at_];
  }
  void space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  void expect(const std::string& word) {
    if (text_.compare(at_, word.size(), word) != 0) fail("expected " + word);
    at_ += word.size();
  }
  std::string name() {
    const std::size_t start = at_;
    while (std::isalnum(static_cast<unsigned char>(peek())) || peek() == '-' || peek() == '_' || peek() == ':') ++at_;
    if (at_ == start) fail("expected a name");
    return text_.substr(start, at_ - start);
  }
  void check_entities(const std::string& part) const {
    for (std::size_t i = part.find('&'); i != std::string::npos; i = part.find('&', i + 1))
      if (part.compare(i, 5, "&amp;") != 0 && part.compare(i, 4, "&lt;") != 0 && part.compare(i, 4, "&gt;") != 0)
        fail("bare &");
  }

  XmlElement element() {
    XmlElement out;
    expect("<");
    out.name = name();
    for (space(); peek() != '>' && peek() != '/'; space()) {
      const std::string key = name();
      expect("=\"");
      const std::size_t start = at_;
      while (peek() != '"') {
        if (peek() == '<') fail("< in an attribute");
        ++at_;
      }
      check_entities(text_.substr(start, at_ - start));
      if (!out.attributes.emplace(key, text_.substr(start, at_ - start)).second) fail("attribute given twice");
      ++at_;
    }
    if (peek() == '/') {
      expect("/>");
      return out;
    }
    expect(">");
    while (true) {
      const std::size_t start = at_;
      while (peek() != '<') ++at_;
      out.text += text_.substr(start, at_ - start);
      if (text_.compare(at_, 2, "</") == 0) break;
      out.children.push_back(element());
    }
    check_entities(out.text);
    expect("</" + out.name + ">");
    return out;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

void collect(const XmlElement& element, const std::string& wanted, const std::string& attribute,
             const std::string& value, std::vector<const XmlElement*>& found) {
  for (const XmlElement& child : element.children) {
    const auto it = child.attributes.find(attribute);
    if (child.name == wanted && (attribute.empty() || (it != child.attributes.end() && it->second == value)))
      found.push_back(&child);
    collect(child, wanted, attribute, value, found);
  }
}

}  // namespace

std::vector<const XmlElement*> XmlElement::find(const std::string& wanted, const std::string& attribute,
                                                const std::string& value) const {
  std::vector<const XmlElement*> found;
  collect(*this, wanted, attribute, value, found);
  return found;
}

XmlElement read_xml(const std::string& document) { return Reader(document).document(); }

}  // namespace treadmark::testing
