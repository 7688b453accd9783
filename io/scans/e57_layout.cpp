// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/e57_layout.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/points/fields.hpp"

namespace treadmark::io::scans {

unsigned E57Field::bits() const {
  if (kind == Kind::single) return 32;
  if (kind == Kind::real) return 64;
  return static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(most) - static_cast<std::uint64_t>(least)));
}

// Errors are kept until Expat has returned: it is C, through which nothing may be thrown.
struct E57Xml::State {
  std::string file, error, advice;
  XML_Parser parser = nullptr;
  std::vector<std::string> path;
  std::string text;
  E57Layout layout;
  std::size_t elements = 0;

  void fail(const std::string& message, const std::string& help = {}) {
    if (!error.empty()) return;
    error = message;
    advice = help;
    XML_StopParser(parser, XML_FALSE);
  }

  /// Whether the path is e57Root/data3D/vectorChild/ and these.
  bool in_scan(std::initializer_list<std::string_view> names, bool deeper = false) const {
    constexpr std::string_view kScan[] = {"e57Root", "data3D", "vectorChild"};
    const std::size_t length = std::size(kScan) + names.size();
    return (deeper ? path.size() > length : path.size() == length) &&
           std::equal(std::begin(kScan), std::end(kScan), path.begin()) &&
           std::equal(names.begin(), names.end(), path.begin() + std::size(kScan));
  }

  static std::string_view find(const char** attributes, std::string_view name) {
    for (; *attributes != nullptr; attributes += 2)
      if (name == *attributes) return attributes[1];
    return {};
  }

  template <class Number>
  Number whole(std::string_view word, Number otherwise) {
    if (word.empty()) return otherwise;
    Number value = 0;
    const auto [end, code] = from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc{} || end != word.data() + word.size())
      fail("a whole number is expected, this is " + profiles::printable(word));
    return value;
  }

  double real(std::string_view word, double otherwise) {
    while (!word.empty() && (profiles::is_blank(word.front()) || word.front() == '\n' || word.front() == '\r'))
      word.remove_prefix(1);
    while (!word.empty() && (profiles::is_blank(word.back()) || word.back() == '\n' || word.back() == '\r'))
      word.remove_suffix(1);
    if (word.empty()) return otherwise;
    double value = 0.0;
    if (!points::parse_number(word, false, value) || !std::isfinite(value))
      fail("a number is expected, this is " + profiles::printable(word));
    return value;
  }

  void begin(const char* name, const char** attributes) {
    constexpr std::size_t kDeepest = 100;
    if (path.size() == kDeepest) return fail("elements are nested too deeply");
    path.emplace_back(name);
    text.clear();
    if (path.size() == 1 && path[0] != "e57Root") return fail("the XML of an E57 file begins with e57Root");
    if (in_scan({})) layout.scans.emplace_back();
    if (in_scan({"points"})) {
      if (find(attributes, "type") != "CompressedVector") return fail("the points are no CompressedVector");
      E57Scan& scan = layout.scans.back();
      scan.file_offset = whole<std::uint64_t>(find(attributes, "fileOffset"), 0);
      scan.records = whole<std::uint64_t>(find(attributes, "recordCount"), 0);
    } else if (in_scan({"points", "prototype"}, true)) {
      add_field(attributes);
    } else if (in_scan({"points", "codecs"}, true) && path.back().ends_with("Codec") && path.back() != "bitPackCodec") {
      fail("the points are packed with " + profiles::printable(path.back()), "only bitPackCodec is read");
    }
  }

  void add_field(const char** attributes) {
    const std::string_view type = find(attributes, "type");
    if (type == "Structure" || type == "Vector") return;
    E57Field field;
    constexpr std::size_t kDirect = 6;
    if (path.size() == kDirect) field.name = path.back();
    if (type == "Float") {
      field.kind = find(attributes, "precision") == "single" ? E57Field::Kind::single : E57Field::Kind::real;
    } else if (type == "Integer" || type == "ScaledInteger") {
      field.kind = type == "Integer" ? E57Field::Kind::integer : E57Field::Kind::scaled;
      field.least = whole<std::int64_t>(find(attributes, "minimum"), std::numeric_limits<std::int64_t>::min());
      field.most = whole<std::int64_t>(find(attributes, "maximum"), std::numeric_limits<std::int64_t>::max());
      field.scale = real(find(attributes, "scale"), 1.0);
      field.offset = real(find(attributes, "offset"), 0.0);
      if (field.most < field.least)
        return fail("the maximum of " + profiles::printable(path.back()) + " is below its minimum");
      if (field.scale == 0.0) return fail("the scale of " + profiles::printable(path.back()) + " is 0");
    } else if (type == "String") {
      field.kind = E57Field::Kind::text;
    } else {
      return fail("unknown type " + profiles::printable(type) + " of " + profiles::printable(path.back()));
    }
    layout.scans.back().fields.push_back(std::move(field));
  }

  void end() {
    const bool of_pose = in_scan({"pose"}, true) && path.size() == 6;
    if (of_pose) {
      E57Scan& scan = layout.scans.back();
      scan.has_pose = true;
      const std::string& group = path[4];
      const std::size_t k = std::string_view("wxyz").find(path[5]);
      if (path[5].size() == 1 && k != std::string_view::npos) {
        if (group == "rotation") scan.quaternion[k] = real(text, 0.0);
        if (group == "translation" && k > 0) scan.translation[static_cast<Eigen::Index>(k) - 1] = real(text, 0.0);
      }
    }
    if (path.size() == 2 && path[1] == "coordinateMetadata") {
      const auto blank = [](char c) { return profiles::is_blank(c) || c == '\n' || c == '\r'; };
      if (!std::all_of(text.begin(), text.end(), blank)) layout.reference = text;
    }
    path.pop_back();
    text.clear();
  }

  void add_text(std::string_view piece) {
    constexpr std::size_t kLongest = 100'000;
    if (text.size() < kLongest) text += piece;
  }
};

E57Xml::E57Xml(std::string file) : state_(std::make_unique<State>()) {
  state_->file = std::move(file);
  state_->parser = XML_ParserCreate(nullptr);
  if (state_->parser == nullptr) throw std::bad_alloc();
  XML_SetUserData(state_->parser, state_.get());
  XML_SetElementHandler(
      state_->parser,
      [](void* data, const XML_Char* name, const XML_Char** attributes) {
        static_cast<State*>(data)->begin(name, attributes);
      },
      [](void* data, const XML_Char*) { static_cast<State*>(data)->end(); });
  XML_SetCharacterDataHandler(state_->parser, [](void* data, const XML_Char* piece, int length) {
    static_cast<State*>(data)->add_text({piece, static_cast<std::size_t>(length)});
  });
  XML_SetStartDoctypeDeclHandler(
      state_->parser, [](void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
        static_cast<State*>(data)->fail("a document type is declared, which no E57 file does");
      });
}

E57Xml::~E57Xml() { XML_ParserFree(state_->parser); }

void E57Xml::feed(std::string_view piece, bool last) {
  const XML_Status status = XML_Parse(state_->parser, piece.data(), static_cast<int>(piece.size()), last ? 1 : 0);
  if (status == XML_STATUS_OK) return;
  const bool own = !state_->error.empty();
  throw Error(ErrorKind::input_data,
              fmt::format("in the XML at line {}, column {}: {}", XML_GetCurrentLineNumber(state_->parser),
                          XML_GetCurrentColumnNumber(state_->parser) + 1,
                          own ? state_->error : std::string(XML_ErrorString(XML_GetErrorCode(state_->parser)))),
              {state_->file, 0, 0}, own ? state_->advice : "is the file damaged?");
}

E57Layout& E57Xml::layout() { return state_->layout; }

}  // namespace treadmark::io::scans
