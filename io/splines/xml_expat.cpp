// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/splines/xml_tree.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>

namespace treadmark::io::splines {
namespace {

constexpr std::size_t kDeepest = 32, kMostElements = 5'000'000;

// Errors are kept until Expat has returned: it is C, through which nothing may be thrown.
struct Building {
  XML_Parser parser = nullptr;
  XmlElement* root = nullptr;
  std::vector<XmlElement*> open;
  std::size_t elements = 0;
  std::string error, advice;
  bool no_memory = false;

  void fail(const char* message, const char* help = "") {
    if (!error.empty()) return;
    error = message, advice = help;
    XML_StopParser(parser, XML_FALSE);
  }

  template <class Work>
  void guarded(const Work& work) {
    try {
      if (error.empty() && !no_memory) work();
    } catch (const std::bad_alloc&) {
      no_memory = true;
      XML_StopParser(parser, XML_FALSE);
    }
  }

  void begin(const char* name, const char** attributes) {
    if (open.size() == kDeepest) return fail("elements are nested too deeply");
    if (++elements > kMostElements) return fail("there are more than 5 million elements");
    XmlElement* element = root;
    if (!open.empty()) element = &open.back()->inside.emplace_back();
    element->name = name;
    element->line = static_cast<int>(XML_GetCurrentLineNumber(parser));
    element->column = static_cast<int>(XML_GetCurrentColumnNumber(parser)) + 1;
    for (; *attributes != nullptr; attributes += 2) element->attributes.emplace_back(attributes[0], attributes[1]);
    open.push_back(element);
  }

  void add_text(const char* piece, std::size_t length) {
    XmlElement& element = *open.back();
    const auto at = static_cast<std::size_t>(std::max<XML_Index>(0, XML_GetCurrentByteIndex(parser)));
    if (element.pieces.empty() || at != element.pieces.back().file + (element.text.size() - element.pieces.back().text))
      element.pieces.push_back({element.text.size(), at});
    element.text.append(piece, length);
  }
};

Building& of(void* data) { return *static_cast<Building*>(data); }

}  // namespace

XmlTree::XmlTree(std::string_view text, std::string file) : content_(text), file_(std::move(file)) {
  Building building;
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), &XML_ParserFree);
  if (parser == nullptr) throw std::bad_alloc();
  building.parser = parser.get();
  building.root = &root_;
  XML_SetUserData(parser.get(), &building);
  XML_SetElementHandler(
      parser.get(),
      [](void* data, const XML_Char* name, const XML_Char** attributes) {
        of(data).guarded([&] { of(data).begin(name, attributes); });
      },
      [](void* data, const XML_Char*) {
        if (of(data).error.empty() && !of(data).no_memory) of(data).open.pop_back();
      });
  XML_SetCharacterDataHandler(parser.get(), [](void* data, const XML_Char* piece, int length) {
    of(data).guarded([&] { of(data).add_text(piece, static_cast<std::size_t>(length)); });
  });
  XML_SetStartDoctypeDeclHandler(parser.get(), [](void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
    of(data).fail("a document type is declared, which files of splines do not need",
                  "leave out <!DOCTYPE ...>; entities are not expanded");
  });
  // in parts, since Expat counts bytes in int
  constexpr std::size_t kPart = 1 << 24;
  XML_Status status = XML_STATUS_OK;
  for (std::size_t at = 0; status == XML_STATUS_OK;) {
    const std::size_t size = std::min(kPart, text.size() - at);
    const bool last = at + size == text.size();
    status = XML_Parse(parser.get(), text.data() + at, static_cast<int>(size), last ? 1 : 0);
    at += size;
    if (last) break;
  }
  if (building.no_memory) throw std::bad_alloc();
  if (status == XML_STATUS_OK) return;
  const bool own = !building.error.empty();
  throw Error(ErrorKind::input_data,
              own ? building.error : fmt::format("this is no XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get()))),
              {file_, static_cast<int>(XML_GetCurrentLineNumber(parser.get())),
               static_cast<int>(XML_GetCurrentColumnNumber(parser.get())) + 1},
              own ? building.advice : "is the file complete?");
}

}  // namespace treadmark::io::splines
