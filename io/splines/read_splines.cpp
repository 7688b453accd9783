// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/splines/read_splines.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/splines/xml_tree.hpp"

namespace treadmark::io {
namespace {

using splines::XmlElement;
using splines::XmlTree;

constexpr std::size_t kMostPoints = 20'000'000;
// Of one direction of a level: memory follows them, not the file.
constexpr std::size_t kMostIntervals = 65'536;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// The words of a text, with where they begin.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  bool next(std::string_view& word, std::size_t& at) {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    if (at_ == text_.size()) return false;
    at = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    word = text_.substr(at, at_ - at);
    return true;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

std::optional<std::string> from_base64(std::string_view text) {
  std::string out;
  std::uint32_t bits = 0;
  int count = 0, padding = 0;
  for (const char c : text) {
    if (is_space(c)) continue;
    int value = 0;
    if (c >= 'A' && c <= 'Z')
      value = c - 'A';
    else if (c >= 'a' && c <= 'z')
      value = c - 'a' + 26;
    else if (c >= '0' && c <= '9')
      value = c - '0' + 52;
    else if (c == '+' || c == '/')
      value = c == '+' ? 62 : 63;
    else if (c == '=' && ++padding <= 2)
      continue;
    else
      return std::nullopt;
    if (padding > 0) return std::nullopt;
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    if ((count += 6) >= 8) out += static_cast<char>((bits >> (count -= 8)) & 0xffu);
  }
  return out;
}

class Reader {
 public:
  Reader(const XmlTree& tree, double scale) : tree_(tree), scale_(scale) {}

  SplineFile read() {
    const XmlElement& root = tree_.root();
    if (root.name != "xml")
      fail(root, fmt::format("the root is {}, but that of G+Smo's files is <xml>", profiles::printable(root.name)),
           "G+Smo's XML is read, nothing else");
    find_geometries();
    const XmlElement* patches = nullptr;
    for (const XmlElement& e : root.inside) {
      if (e.name != "MultiPatch") continue;
      if (patches != nullptr) fail(e, "there is more than one MultiPatch", "keep that of the wheel or rail");
      patches = &e;
    }
    out_.surfaces.reserve(geometries_.size());
    if (patches != nullptr)
      read_patches(*patches);
    else
      for (const XmlElement* g : geometries_) out_.surfaces.push_back(surface(*g));
    if (out_.surfaces.empty()) fail(root, "there is no Geometry", "is it a file of a basis or of boundary conditions?");
    require_size();
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const XmlElement& at, const std::string& what, const std::string& advice = {}) const {
    throw Error(ErrorKind::input_data, said(what), tree_.where(at), advice);
  }
  [[noreturn]] void fail_at(const XmlElement& at, std::size_t in_text, const std::string& what,
                            const std::string& advice = {}) const {
    throw Error(ErrorKind::input_data, said(what), tree_.where(at, in_text), advice);
  }
  /// With the geometry that is being read.
  std::string said(const std::string& what) const { return of_.empty() ? what : fmt::format("{}: {}", of_, what); }

  const std::string& required(const XmlElement& e, const char* attribute) const {
    const std::string* value = e.attribute(attribute);
    if (value == nullptr) fail(e, fmt::format("<{}> has no {}", e.name, attribute));
    return *value;
  }
  int whole(const XmlElement& e, std::string_view word, std::string_view what) const {
    const std::optional<int> value = whole_number(word);
    if (!value) fail(e, fmt::format("{} of <{}> is {}, no whole number", what, e.name, profiles::printable(word)));
    return *value;
  }
  static std::optional<int> whole_number(std::string_view word) {
    while (!word.empty() && is_space(word.front())) word.remove_prefix(1);
    while (!word.empty() && is_space(word.back())) word.remove_suffix(1);
    int value = 0;
    const auto [end, code] = from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || code != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
  }
  const XmlElement& child(const XmlElement& e, const char* name) const {
    const XmlElement* found = e.first(name);
    if (found == nullptr) fail(e, fmt::format("<{}> has no <{}>", e.name, name));
    return *found;
  }
  void require_type(const XmlElement& e, std::string_view wanted) const {
    if (const std::string& type = required(e, "type"); type != wanted)
      fail(e, fmt::format("<{}> is of type {}, not {}", e.name, profiles::printable(type), wanted));
  }

  /// Of an element; finite. expected: how many there must be, 0 = any number.
  std::vector<double> numbers(const XmlElement& e, std::size_t expected) const {
    std::vector<double> out;
    const std::string* format = e.attribute("format");
    const std::string kind = format == nullptr ? "ascii" : profiles::lower(*format);
    const auto wrong_count = [&](std::size_t is) {
      return fmt::format("<{}> has {} numbers, where {} are expected", e.name, is, expected);
    };
    if (kind == "b64float64") {
      const std::optional<std::string> bytes = from_base64(e.text);
      if (!bytes || bytes->size() % sizeof(double) != 0)
        fail(e, fmt::format("<{}> is no list of doubles in Base64", e.name), "is the file damaged?");
      if (expected > 0 && bytes->size() / sizeof(double) != expected)
        fail(e, wrong_count(bytes->size() / sizeof(double)));
      out.resize(bytes->size() / sizeof(double));
      static_assert(std::endian::native == std::endian::little);
      std::memcpy(out.data(), bytes->data(), bytes->size());
      for (std::size_t i = 0; i < out.size(); ++i)
        if (!std::isfinite(out[i])) fail(e, fmt::format("number {} of <{}> is not finite", i + 1, e.name));
      return out;
    }
    if (kind != "ascii")
      fail(e, fmt::format("numbers in the format {} are not read", profiles::printable(*format)),
           "ASCII and B64Float64 are");
    Words words(e.text);
    std::string_view word;
    std::size_t at = 0;
    while (words.next(word, at)) {
      if (expected > 0 && out.size() == expected)
        fail_at(e, at, fmt::format("<{}> has more than the {} numbers that are expected", e.name, expected));
      double value = 0.0;
      if (!points::parse_number(word, false, value))
        fail_at(e, at, "a number is expected, this is " + profiles::printable(word));
      if (!std::isfinite(value)) fail_at(e, at, fmt::format("{} is not finite", profiles::printable(word)));
      out.push_back(value);
    }
    if (expected > 0 && out.size() != expected) fail(e, wrong_count(out.size()));
    return out;
  }

  std::vector<int> whole_numbers(const XmlElement& e) const {
    std::vector<int> out;
    Words words(e.text);
    std::string_view word;
    std::size_t at = 0;
    while (words.next(word, at)) {
      const std::optional<int> value = whole_number(word);
      if (!value) fail_at(e, at, "a whole number is expected, this is " + profiles::printable(word));
      out.push_back(*value);
    }
    return out;
  }

  /// Where a number of a list begins.
  static std::size_t place_of(const XmlElement& e, std::size_t number) {
    Words words(e.text);
    std::string_view word;
    std::size_t at = 0;
    for (std::size_t i = 0; i <= number && words.next(word, at); ++i) {
    }
    return at;
  }

  void find_geometries() {
    int count = 0;
    for (const XmlElement& e : tree_.root().inside) {
      if (e.name != "Geometry") continue;
      ++count;
      geometries_.push_back(&e);
      const std::string* id = e.attribute("id");
      if (id == nullptr) {
        names_[&e] = fmt::format("Geometry {} without id", count);
        continue;
      }
      const int number = whole(e, *id, "id");
      names_[&e] = fmt::format("Geometry {}", number);
      if (!by_id_.emplace(number, &e).second)
        fail(e, fmt::format("there is another Geometry of id {}", number), "give each its own");
    }
  }

  void read_patches(const XmlElement& e) {
    of_ = "MultiPatch";
    if (const int dimension = whole(e, required(e, "parDim"), "parDim"); dimension != 2)
      fail(e, fmt::format("it has {} parameters, a surface has 2", dimension));
    const XmlElement& patches = child(e, "patches");
    const std::vector<int> ids = whole_numbers(patches);
    const std::string& type = required(patches, "type");
    std::map<int, std::size_t> place;
    const auto add = [&](std::int64_t id, std::size_t number) {
      const auto found = id >= std::numeric_limits<int>::min() ? by_id_.find(static_cast<int>(id)) : by_id_.end();
      if (found == by_id_.end())
        fail_at(patches, place_of(patches, number), fmt::format("there is no Geometry of id {}", id));
      if (!place.emplace(static_cast<int>(id), out_.surfaces.size()).second)
        fail_at(patches, place_of(patches, number), fmt::format("Geometry {} is named twice", id));
      out_.surfaces.push_back(surface(*found->second));
      of_ = "MultiPatch";
    };
    if (type == "id_range") {
      if (ids.size() != 2 || ids[0] > ids[1])
        fail(patches, "a range of ids is two numbers, the first not the greater one");
      for (std::int64_t id = ids[0]; id <= ids[1]; ++id) add(id, id == ids[0] ? 0 : 1);
    } else if (type == "id_index") {
      for (std::size_t k = 0; k < ids.size(); ++k) add(ids[k], k);
    } else {
      fail(patches, fmt::format("patches of type {} are not known", profiles::printable(type)),
           "id_range and id_index are");
    }
    for (const XmlElement& sides : e.inside) {
      if (sides.name != "interfaces") continue;
      constexpr std::size_t kNumbers = 8;  // patch, side, patch, side, and how directions meet
      const std::vector<int> n = whole_numbers(sides);
      if (n.size() % kNumbers != 0)
        fail(sides, fmt::format("interfaces are {} numbers each, these are {} numbers", kNumbers, n.size()));
      for (std::size_t k = 0; k < n.size(); k += kNumbers) {
        SplineInterface i;
        i.where = tree_.where(sides, place_of(sides, k));
        const auto patch = [&](std::size_t number) {
          const auto found = place.find(n[number]);
          if (found == place.end())
            fail_at(sides, place_of(sides, number), fmt::format("Geometry {} is none of the patches", n[number]));
          return found->second;
        };
        const auto side = [&](std::size_t number) {
          if (n[number] < 1 || n[number] > 4)
            fail_at(sides, place_of(sides, number), fmt::format("a surface has sides 1 to 4, this is {}", n[number]));
          return n[number];
        };
        i.first = patch(k), i.first_side = side(k + 1), i.second = patch(k + 2), i.second_side = side(k + 3);
        i.reversed = n[k + (i.first_side <= 2 ? 7 : 6)] == 0;
        out_.interfaces.push_back(std::move(i));
      }
    }
    of_.clear();
  }

  SplineSurface surface(const XmlElement& e) {
    check_cancelled();
    of_ = names_.at(&e);
    SplineSurface out;
    out.name = of_;
    out.where = tree_.where(e);
    const std::string& type = required(e, "type");
    const XmlElement& basis = child(e, "Basis");
    std::size_t functions = 0;
    if (type == "TensorBSpline2") {
      require_type(basis, "TensorBSplineBasis2");
      functions = read_tensor(basis, out);
    } else if (type == "TensorNurbs2") {
      require_type(basis, "TensorNurbsBasis2");
      const XmlElement& inner = child(basis, "Basis");
      require_type(inner, "TensorBSplineBasis2");
      functions = read_tensor(inner, out);
      out.weights = numbers(child(basis, "weights"), functions);
      for (std::size_t k = 0; k < out.weights.size(); ++k)
        if (!(out.weights[k] > 0.0)) {
          const XmlElement& weights = child(basis, "weights");
          fail_at(weights, place_of(weights, k), fmt::format("weight {} is {}, not positive", k + 1, out.weights[k]));
        }
    } else if (type == "THBSpline2" || type == "HBSpline2") {
      require_type(basis, type == "THBSpline2" ? "THBSplineBasis2" : "HBSplineBasis2");
      out.hierarchical = true;
      out.truncated = type == "THBSpline2";
      read_hierarchy(basis, out);
    } else {
      fail(e, fmt::format("type {} is not read", profiles::printable(type)),
           "TensorBSpline2, TensorNurbs2, THBSpline2 and HBSpline2 are: leave the others out");
    }
    if (const XmlElement* moved = e.first("transform"))
      fail(*moved, "a transform is not read", "apply it to the coefficients");
    const XmlElement& coefs = child(e, "coefs");
    if (const int dimension = whole(coefs, required(coefs, "geoDim"), "geoDim"); dimension != 3)
      fail(coefs, fmt::format("its coefficients have geoDim {}, a surface in space has 3", dimension),
           "x forward, y to the right, z down");
    if (const std::string* order = coefs.attribute("order"))
      fail(coefs, fmt::format("coefficients in the order {} are not read", profiles::printable(*order)),
           "leave order out");
    if (functions > kMostPoints) fail(coefs, fmt::format("there are more than {} coefficients", kMostPoints));
    const std::vector<double> values = numbers(coefs, 3 * functions);
    if (values.empty() || values.size() % 3 != 0)
      fail(coefs, fmt::format("coefficients are three numbers each, these are {} numbers", values.size()));
    if (values.size() / 3 > kMostPoints) fail(coefs, fmt::format("there are more than {} coefficients", kMostPoints));
    out.points.reserve(values.size() / 3);
    for (std::size_t k = 0; k < values.size(); k += 3)
      out.points.emplace_back(scale_ * values[k], scale_ * values[k + 1], scale_ * values[k + 2]);
    of_.clear();
    return out;
  }

  SplineKnots read_knots(const XmlElement& basis, int highest_degree) const {
    require_type(basis, "BSplineBasis");
    const XmlElement& e = child(basis, "KnotVector");
    if (const std::string* mode = e.attribute("mode"))
      fail(e, fmt::format("knots by their mode ({}) are not read", profiles::printable(*mode)), "list them");
    SplineKnots out;
    out.degree = whole(e, required(e, "degree"), "degree");
    out.knots = numbers(e, 0);
    if (out.knots.size() > kMostPoints) fail(e, fmt::format("there are more than {} knots", kMostPoints));
    const auto fault = fault_of(out, highest_degree);
    if (fault && fault->knot) fail_at(e, place_of(e, *fault->knot), fault->what, "where it is torn are two patches");
    if (fault) fail(e, fault->what);
    return out;
  }

  std::array<SplineKnots, 2> read_directions(const XmlElement& basis, int highest_degree) const {
    std::array<SplineKnots, 2> out;
    std::size_t count = 0;
    for (const XmlElement& e : basis.inside) {
      if (e.name != "Basis") continue;
      if (count == 2) fail(e, "a surface has two directions, this is a third one");
      if (const std::string* index = e.attribute("index");
          index != nullptr && whole(e, *index, "index") != static_cast<int>(count))
        fail(e, fmt::format("direction {} stands at place {}", profiles::printable(*index), count), "put 0 before 1");
      out[count++] = read_knots(e, highest_degree);
    }
    if (count < 2) fail(basis, fmt::format("a surface has two directions, this basis has {}", count));
    return out;
  }

  /// The number of functions.
  std::size_t read_tensor(const XmlElement& basis, SplineSurface& out) const {
    out.levels.push_back(read_directions(basis, kHighestDegree));
    return out.levels.back()[0].functions() * out.levels.back()[1].functions();
  }

  SplineKnots halved(const XmlElement& at, const SplineKnots& coarser) const {
    SplineKnots out{coarser.degree, {}};
    const std::size_t last = coarser.knots.size() - 1;
    out.knots.reserve(2 * coarser.knots.size());
    for (std::size_t i = 0; i < last; ++i) {
      out.knots.push_back(coarser.knots[i]);
      const double a = coarser.knots[i], b = coarser.knots[i + 1], middle = 0.5 * (a + b);
      if (!(a < b)) continue;
      if (!(a < middle && middle < b)) fail(at, "two different knots are too near each other to be halved");
      out.knots.push_back(middle);
    }
    out.knots.push_back(coarser.knots[last]);
    if (out.breaks().size() > kMostIntervals + 1)
      fail(at, fmt::format("boxes of this level would need more than {} intervals", kMostIntervals));
    return out;
  }

  /// Where knots stand in the tree of a hierarchy with levels of its own: those of the level before at twice their
  /// index, a new one in the middle.
  std::vector<std::int64_t> tree_indices(const XmlElement& at, const std::vector<std::int64_t>& before,
                                         const std::vector<double>& coarser, const std::vector<double>& finer) const {
    std::vector<std::int64_t> out;
    out.reserve(finer.size());
    std::size_t c = 0;
    for (std::size_t i = 0; i < finer.size(); ++i) {
      if (c < coarser.size() && finer[i] == coarser[c]) {
        out.push_back(2 * before[c++]);
        continue;
      }
      if (c == 0 || c == coarser.size() || finer[i - 1] != coarser[c - 1] || !(finer[i] < coarser[c]))
        fail(at, "its knots are not those of the level before with at most one more in each interval");
      out.push_back(before[c - 1] + before[c]);
    }
    if (c != coarser.size()) fail(at, "it lacks knots of the level before");
    return out;
  }

  void read_hierarchy(const XmlElement& basis, SplineSurface& out) const {
    const XmlElement& first = child(basis, "Basis");
    require_type(first, "TensorBSplineBasis2");
    out.levels.push_back(read_directions(first, kHighestHierarchicalDegree));
    using Breaks = std::array<std::vector<double>, 2>;
    std::vector<Breaks> breaks{{out.levels[0][0].breaks(), out.levels[0][1].breaks()}};
    for (const std::vector<double>& b : breaks[0])
      if (b.size() > kMostIntervals + 1) fail(first, fmt::format("it has more than {} intervals", kMostIntervals));
    const std::string* manual = basis.attribute("manualLevels");
    const bool own_levels = manual != nullptr && *manual == "true";
    // of each level and direction: tree index of each break
    std::vector<std::array<std::vector<std::int64_t>, 2>> in_tree;
    if (own_levels) {
      const auto counted = [](std::size_t n) {
        std::vector<std::int64_t> v(n);
        for (std::size_t i = 0; i < n; ++i) v[i] = static_cast<std::int64_t>(i);
        return v;
      };
      in_tree.push_back({counted(breaks[0][0].size()), counted(breaks[0][1].size())});
      for (const XmlElement& e : basis.inside) {
        if (e.name != "Basis" || &e == &first) continue;
        const auto level = out.levels.size();
        require_type(e, "TensorBSplineBasis2");
        if (whole(e, required(e, "level"), "level") != static_cast<int>(level))
          fail(e, fmt::format("level {} is expected here", level));
        constexpr std::size_t kMostLevels = 16;
        if (level == kMostLevels) fail(e, fmt::format("there are more than {} levels", kMostLevels));
        out.levels.push_back(read_directions(e, kHighestHierarchicalDegree));
        breaks.push_back({out.levels.back()[0].breaks(), out.levels.back()[1].breaks()});
        std::array<std::vector<std::int64_t>, 2> indices;
        for (std::size_t d = 0; d < 2; ++d) {
          if (breaks.back()[d].size() > kMostIntervals + 1)
            fail(e, fmt::format("it has more than {} intervals", kMostIntervals));
          indices[d] = tree_indices(e, in_tree.back()[d], breaks[level - 1][d], breaks[level][d]);
        }
        in_tree.push_back(std::move(indices));
      }
    }
    for (const XmlElement& e : basis.inside) {
      if (e.name != "box") continue;
      SplineBox box;
      box.line = e.line;
      box.level = whole(e, required(e, "level"), "level");
      if (box.level < 0) fail(e, fmt::format("a box is of level {}", box.level));
      const std::vector<int> n = whole_numbers(e);
      if (n.size() != 4)
        fail(e, fmt::format("a box is four numbers, the lower and the upper corner; this has {}", n.size()));
      const auto level = static_cast<std::size_t>(box.level);
      if (own_levels && level >= out.levels.size())
        fail(e, fmt::format("a box is of level {}, but there are {} levels", level, out.levels.size()));
      while (level >= out.levels.size()) {
        out.levels.push_back({halved(e, out.levels.back()[0]), halved(e, out.levels.back()[1])});
        breaks.push_back({out.levels.back()[0].breaks(), out.levels.back()[1].breaks()});
      }
      for (std::size_t d = 0; d < 2; ++d) {
        const auto corner = [&](int index) {
          if (!own_levels) return index;
          const std::vector<std::int64_t>& at = in_tree[level][d];
          const auto found = std::lower_bound(at.begin(), at.end(), index);
          if (found == at.end() || *found != index)
            fail(e, fmt::format("index {} of a box of level {} is that of no knot", index, level));
          return static_cast<int>(found - at.begin());
        };
        box.lower[d] = corner(n[d]), box.upper[d] = corner(n[d + 2]);
        const auto intervals = static_cast<int>(breaks[level][d].size()) - 1;
        if (box.lower[d] < 0 || box.upper[d] > intervals || box.lower[d] >= box.upper[d])
          fail(e, fmt::format("the box {} {} {} {} of level {} is empty or leaves its {} x {} cells", n[0], n[1], n[2],
                              n[3], level, breaks[level][0].size() - 1, breaks[level][1].size() - 1));
      }
      out.boxes.push_back(box);
    }
  }

  /// The format has no unit: one that cannot be meant is seen by the size.
  void require_size() const {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const SplineSurface& s : out_.surfaces)
      for (const Vec3& p : s.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    constexpr double kLeast = 5e-3, kMost = 1e3;  // [m]
    const double size = (high - low).norm();
    if (size < kLeast || size > kMost)
      fail(tree_.root(), fmt::format("all of it measures {:.3g} mm", 1e3 * size),
           "is scale_to_mm right? It leads from the file's unit to mm: 1000 for a file in m");
  }

  const XmlTree& tree_;
  double scale_;
  SplineFile out_;
  std::string of_;
  std::vector<const XmlElement*> geometries_;
  std::map<const XmlElement*, std::string> names_;
  std::map<int, const XmlElement*> by_id_;
};

}  // namespace

bool is_spline_file(const std::filesystem::path& file) { return can_hold(file, kSplineFile); }

SplineFile parse_splines(std::string_view text, const std::string& file, double scale_to_mm) {
  if (!(scale_to_mm > 0.0 && std::isfinite(scale_to_mm)))
    throw Error(ErrorKind::configuration,
                fmt::format("the scale of splines must be positive, this is {:g}", scale_to_mm), {file},
                "it leads to mm: 1 for a file in mm, 1000 for one in m");
  const XmlTree tree(text, file);
  return Reader(tree, 1e-3 * scale_to_mm).read();
}

SplineFile read_splines(const std::filesystem::path& file, double scale_to_mm, const SourcePosition& asked_by) {
  return parse_splines(profiles::read_text(file, "file of splines", asked_by), file.string(), scale_to_mm);
}

}  // namespace treadmark::io
