// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <string>
#include <vector>

namespace treadmark::testing {

struct XmlElement {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;

  /// All elements below with this name (and value of an attribute), in document order.
  std::vector<const XmlElement*> find(const std::string& wanted, const std::string& attribute = "",
                                      const std::string& value = "") const;
};

/// Reads a document; throws std::runtime_error unless it is well-formed (tags nested and closed, attributes quoted and
/// unique, no bare & or < in texts, one root).
XmlElement read_xml(const std::string& document);

}  // namespace treadmark::testing
