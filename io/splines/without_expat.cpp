// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/io/splines/xml_tree.hpp"

namespace treadmark::io::splines {

XmlTree::XmlTree(std::string_view, std::string) { left_out("expat", "files of splines (.xml)"); }

}  // namespace treadmark::io::splines
