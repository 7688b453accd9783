// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/contact_program/contact_digits.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "treadmark/model/contact/theories.hpp"

namespace treadmark::io {

namespace {

constexpr auto yes = DigitSupport::yes;
constexpr auto maybe = DigitSupport::conditional;
constexpr auto no_effect = DigitSupport::no_effect;
constexpr auto no = DigitSupport::no;

// Without those of theories, see model/contact/theories.hpp.
constexpr DigitValue kDigits[] = {
    {1, 'C', "CONFIG", 0, yes, "left wheel on track"},
    {1, 'C', "CONFIG", 1, yes, "right wheel on track"},
    {1, 'C', "CONFIG", 4, yes, "left wheel on roller, or in a ring (NOMRAD < 0)"},
    {1, 'C', "CONFIG", 5, yes, "right wheel on roller, or in a ring (NOMRAD < 0)"},
    {1, 'P', "PVTIME", 0, yes, "continue from the previous case"},
    {1, 'P', "PVTIME", 1, yes, "keep the normal part of the previous case"},
    {1, 'P', "PVTIME", 2, yes, "start without history"},
    {1, 'P', "PVTIME", 3, yes, "keep the previous time"},
    {1, 'B', "BOUND", 1, yes, "thin flexible sheet"},
    {1, 'N', "NORM", 0, yes, "position z_ws given"},
    {1, 'N', "NORM", 1, yes, "vertical force given"},
    {1, 'F', "FORCE", 0, yes, "pitch rate given"},
    {1, 'F', "FORCE", 1, maybe, "longitudinal force given", "T = 1 ... 3"},
    {1, 'F', "FORCE", 2, no, "moment about the axle given", "F = 1 with a force, or F = 0"},
    {1, 'F', "FORCE", 3, maybe, "massless rail", "KYRAIL > 0; with N = 0 KZRAIL > 0"},
    {1, 'S', "STRESS", 0, yes, "no subsurface stresses"},
    {1, 'S', "STRESS", 1, maybe, "subsurface stresses, stored points", "after a case with S = 3"},
    {1, 'S', "STRESS", 2, maybe, "subsurface stresses, new digits", "after a case with S = 3"},
    {1, 'S', "STRESS", 3, yes, "subsurface stresses, new points"},
    {1, 'V', "VARFRC", 0, yes, "one friction law"},
    {1, 'V', "VARFRC", 1, yes, "friction varies with the surface inclination"},
    {1, 'V', "VARFRC", 2, yes, "friction varies along the rail"},
    {1, 'L', "FRCLAW", 0, yes, "Coulomb friction"},
    {1, 'L', "FRCLAW", 1, yes, "keep the friction law"},
    {1, 'L', "FRCLAW", 2, yes, "linear falling friction"},
    {1, 'L', "FRCLAW", 3, yes, "rational falling friction"},
    {1, 'L', "FRCLAW", 4, yes, "exponential falling friction"},
    {1, 'L', "FRCLAW", 5, yes, "Polach's falling friction: FSTAT A B"},
    {1, 'L', "FRCLAW", 6, maybe, "temperature-dependent friction", "needs H = 1 or 3"},
    {1, 'D', "DISCNS", 0, yes, "keep the discretisation"},
    {1, 'D', "DISCNS", 1, yes, "keep the discretisation"},
    {1, 'D', "DISCNS", 2, yes, "automatic contact search"},
    {1, 'D', "DISCNS", 3, maybe, "rigid slip evaluated on the surfaces", "M = 0, 1, 4"},
    {1, 'D', "DISCNS", 4, maybe, "conformal contact", "B = 0, 1 and M = 0, 1, 4"},
    {1, 'D', "DISCNS", 5, yes, "contact search on a grid"},
    {1, 'D', "DISCNS", 6, yes, "contact search on a grid, steep slopes"},
    {1, 'D', "DISCNS", 7, yes, "reference at the initial contact point"},
    {1, 'D', "DISCNS", 8, no, "oblique contact search", "D = 6, a grid for steep slopes"},
    {1, 'D', "DISCNS", 9, no, "oblique contact search", "D = 6, a grid for steep slopes"},
    {1, 'C', "INFLCF", 0, yes, "keep material and influence coefficients"},
    {1, 'C', "INFLCF", 1, yes, "keep material and influence coefficients"},
    {1, 'C', "INFLCF", 9, no, "numerical influence coefficients", "C = 4 with D = 4, or module 3"},
    {1, 'M', "MATER", 0, yes, "elastic"},
    {1, 'M', "MATER", 1, maybe, "viscoelastic", "T = 0, 3, rolling forward; C = 2, K = 0"},
    {1, 'M', "MATER", 4, maybe, "elastic with interface layer", "rolling with a layer that yields: DQREL = 1"},
    {1, 'M', "MATER", 6, no, "a forerunner of FaStrip", "M = 5, FaStrip"},
    {1, 'M', "MATER", 7, no, "a forerunner of FaStrip", "M = 5, FaStrip"},
    {1, 'Z', "ZTRACK", 0, yes, "keep the track"},
    {1, 'Z', "ZTRACK", 1, yes, "read track dimensions and rail profile"},
    {1, 'Z', "ZTRACK", 2, yes, "read track deviations"},
    {1, 'Z', "ZTRACK", 3, yes, "read dimensions, rail profile and deviations"},
    {1, 'E', "EWHEEL", 0, yes, "keep the wheelset"},
    {1, 'E', "EWHEEL", 1, yes, "read the position"},
    {1, 'E', "EWHEEL", 2, yes, "read position and velocity"},
    {1, 'E', "EWHEEL", 3, yes, "read dimensions, wheel profile, position and velocity"},
    {1, 'E', "EWHEEL", 4, yes, "read position, velocity and deviations of the flexible wheelset"},
    {1, 'E', "EWHEEL", 5, yes, "read everything, with deviations of the flexible wheelset"},
    {1, 'H', "HEAT", 1, maybe, "surface temperatures, kept data", "T = 3 only"},
    {1, 'H', "HEAT", 3, maybe, "surface temperatures", "T = 3 only"},

    {3, 'P', "PVTIME", 0, yes, "continue from the previous case"},
    {3, 'P', "PVTIME", 1, yes, "keep the normal part of the previous case"},
    {3, 'P', "PVTIME", 2, yes, "start without history"},
    {3, 'P', "PVTIME", 3, yes, "keep the previous time"},
    {3, 'B', "BOUND", 1, yes, "thin flexible sheet"},
    {3, 'N', "NORM", 0, yes, "approach given"},
    {3, 'N', "NORM", 1, yes, "normal force given"},
    {3, 'F', "FORCE", 0, yes, "creepages given"},
    {3, 'F', "FORCE", 1, yes, "longitudinal force given"},
    {3, 'F', "FORCE", 2, yes, "longitudinal and lateral force given"},
    {3, 'S', "STRESS", 0, yes, "no subsurface stresses"},
    {3, 'S', "STRESS", 1, maybe, "subsurface stresses, stored points", "after a case with S = 3"},
    {3, 'S', "STRESS", 2, maybe, "subsurface stresses, new digits", "after a case with S = 3"},
    {3, 'S', "STRESS", 3, yes, "subsurface stresses, new points"},
    {3, 'V', "VARFRC", 0, yes, "one friction law"},
    {3, 'V', "VARFRC", 3, yes, "a friction law for each row"},
    {3, 'L', "FRCLAW", 0, yes, "Coulomb friction"},
    {3, 'L', "FRCLAW", 1, yes, "keep the friction law"},
    {3, 'L', "FRCLAW", 2, yes, "linear falling friction"},
    {3, 'L', "FRCLAW", 3, yes, "rational falling friction"},
    {3, 'L', "FRCLAW", 4, yes, "exponential falling friction"},
    {3, 'L', "FRCLAW", 5, yes, "Polach's falling friction: FSTAT A B"},
    {3, 'L', "FRCLAW", 6, maybe, "temperature-dependent friction", "needs H = 1 or 3"},
    {3, 'D', "DISCNS", 0, yes, "keep the potential contact"},
    {3, 'D', "DISCNS", 1, yes, "recompute the potential contact"},
    {3, 'D', "DISCNS", 2, yes, "read the potential contact"},
    {3, 'C', "INFLCF", 0, yes, "keep material and influence coefficients"},
    {3, 'C', "INFLCF", 1, yes, "keep material and influence coefficients"},
    {3, 'M', "MATER", 0, yes, "elastic"},
    {3, 'M', "MATER", 1, maybe, "viscoelastic", "T = 0, 3 with CHI = 0, C = 2, K = 0"},
    {3, 'M', "MATER", 4, maybe, "elastic with interface layer",
     "rolling with a layer that yields: DQ = DX, CHI = 0 or 180d"},
    {3, 'M', "MATER", 6, no, "a forerunner of FaStrip", "M = 5, FaStrip"},
    {3, 'M', "MATER", 7, no, "a forerunner of FaStrip", "M = 5, FaStrip"},
    {3, 'Z', "RZNORM", 0, yes, "keep the undeformed distance"},
    {3, 'Z', "RZNORM", 1, yes, "recompute the undeformed distance"},
    {3, 'Z', "RZNORM", 2, yes, "read the undeformed distance"},
    {3, 'E', "EXRHS", 0, yes, "no extra rigid slip"},
    {3, 'E', "EXRHS", 1, yes, "keep the extra rigid slip"},
    {3, 'E', "EXRHS", 2, maybe, "spin removed from the lateral rigid slip", "M = 0, 1, 4"},
    {3, 'E', "EXRHS", 3, maybe, "spin removed from the longitudinal rigid slip", "M = 0, 1, 4"},
    {3, 'E', "EXRHS", 9, yes, "extra rigid slip of every element"},
    {3, 'H', "HEAT", 1, maybe, "surface temperatures, kept data", "T = 3 only"},
    {3, 'H', "HEAT", 3, maybe, "surface temperatures", "T = 3 only"},
};

// The third control word is the same in both modules; it steers the run of the program more than the problem.
constexpr DigitValue kRunDigits[] = {
    {0, 'X', "XFLOW", -1, no_effect, "debug output"},
    {0, 'H', "HEAT", 0, yes, "no temperatures"},
    {0, 'G', "GAUSEI", 0, yes, "default solvers, read their limits"},
    {0, 'G', "GAUSEI", 1, yes, "keep solver settings"},
    {0, 'G', "GAUSEI", 2, yes, "sweeps over single elements (ConvexGS)"},
    {0, 'G', "GAUSEI", 3, no_effect, "solver SteadyGS"},
    {0, 'G', "GAUSEI", 4, yes, "default solvers, first slip velocity of falling friction"},
    {0, 'G', "GAUSEI", 5, no_effect, "solver GDsteady"},
    {0, 'I', "IESTIM", -1, no_effect, "initial estimate"},
    {0, 'A', "MATFIL", 0, yes, "no table of elements (.mat)"},
    {0, 'A', "MATFIL", 1, yes, "table of the elements in contact"},
    {0, 'A', "MATFIL", 2, yes, "table of all elements"},
    {0, 'O', "OUTPUT", -1, yes, "amount of output; 0: the case is solved, its patches are not in the results"},
    {0, 'W', "FLOW", -1, no_effect, "trace of the calculation"},
    {0, 'R', "RETURN", 0, yes, "run; the next case follows without module line"},
    {0, 'R', "RETURN", 1, yes, "run; the next case starts with a module line"},
    {0, 'R', "RETURN", 2, yes, "skip this case; the next one follows without module line"},
    {0, 'R', "RETURN", 3, yes, "skip this case; the next one starts with a module line"},
};

template <class Id, std::size_t count>
void add_theories(std::vector<DigitValue>& list, char letter, std::string_view keyword,
                  const Theory<Id> (&table)[count]) {
  for (const int module : {1, 3})
    for (const Theory<Id>& row : table) {
      if (row.digit.value < 0 || (module == 1 && row.limits.patch_only)) continue;
      const std::string_view needs = module == 1 ? row.digit.on_rail : row.digit.of_patch;
      list.push_back({module, letter, keyword, row.digit.value, needs.empty() ? yes : maybe, row.name, needs});
    }
}

/// Where a digit stands among the control words.
std::ptrdiff_t place_of(std::string_view keyword) {
  constexpr std::string_view kOrder[] = {"CONFIG", "PVTIME", "BOUND",  "TANG",   "NORM",   "FORCE",
                                         "STRESS", "VARFRC", "FRCLAW", "DISCNS", "INFLCF", "MATER",
                                         "ZTRACK", "RZNORM", "EWHEEL", "EXRHS",  "HEAT"};
  return std::find(std::begin(kOrder), std::end(kOrder), keyword) - std::begin(kOrder);
}

const DigitValue* find_digit(int module, std::string_view keyword, int value) {
  for (const DigitValue& d : contact_digits())
    if (d.module == module && d.keyword == keyword && d.value == value) return &d;
  for (const DigitValue& d : kRunDigits)
    if (d.keyword == keyword && (d.value == value || d.value < 0)) return &d;
  return nullptr;
}

/// Advice: what may stand there instead.
std::string values_that_exist(int module, std::string_view keyword) {
  std::string text;
  for (const DigitValue& d : contact_digits())
    if ((d.module == module || d.module == 0) && d.keyword == keyword && d.value >= 0 && d.support != no)
      text += fmt::format("{}{} {}", text.empty() ? "there are " : ", ", d.value, d.meaning);
  return text;
}

}  // namespace

std::span<const DigitValue> contact_digits() {
  static const std::vector<DigitValue> all = [] {
    std::vector<DigitValue> list(std::begin(kDigits), std::end(kDigits));
    add_theories(list, 'B', "BOUND", kNormalTheories);
    add_theories(list, 'T', "TANG", kRegimes);
    add_theories(list, 'C', "INFLCF", kInfluenceKinds);
    add_theories(list, 'M', "MATER", kTangentialTheories);
    const auto order = [](const DigitValue& d) { return std::tuple(d.module, place_of(d.keyword), d.value); };
    std::ranges::sort(list, {}, order);
    list.insert(list.end(), std::begin(kRunDigits), std::end(kRunDigits));
    return list;
  }();
  return all;
}

std::string contact_digit_table() {
  constexpr std::string_view kSupport[] = {"yes", "in part", "no effect here", "no"};
  std::string text;
  int module = -1;
  for (const DigitValue& d : contact_digits()) {
    if (d.module != module) {
      module = d.module;
      text += module == 1   ? "### Module 1\n\n"
              : module == 3 ? "\n### Module 3\n\n"
                            : "\n### Both modules, third control word\n\n";
      text += "| digit | value | meaning | supported |\n|---|---|---|---|\n";
    }
    const std::string value = d.value < 0 ? "any" : std::to_string(d.value);
    std::string support(kSupport[static_cast<int>(d.support)]);
    if (!d.condition.empty()) support += fmt::format(": {}{}", d.support == no ? "use " : "", d.condition);
    text += fmt::format("| {} ({}) | {} | {} | {} |\n", d.letter, d.keyword, value, d.meaning, support);
  }
  return text;
}

ControlWord::ControlWord(ContactText& text, int module, std::string_view letters,
                         std::span<const std::string_view> keywords)
    : keywords_(keywords.begin(), keywords.end()) {
  text.begin_record(fmt::format("the control word {}", letters));
  const long number = text.integer(letters);
  const SourcePosition start = text.where();
  if (number < 0) text.fail(fmt::format("the control word {} must not be negative", letters));
  const std::string digits = std::to_string(number);
  if (digits.size() > letters.size())
    text.fail(fmt::format("the control word {} has {} digits, but at most {} belong to it", letters, digits.size(),
                          letters.size()));

  // The last digit belongs to the last letter; leading zeros of the file count for the column only.
  const std::size_t count = letters.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from_right = count - 1 - i;
    const int value = from_right < digits.size() ? digits[digits.size() - 1 - from_right] - '0' : 0;
    SourcePosition where = start;
    const int written = text.length_of_last_word();
    where.column += std::max(0, written - 1 - static_cast<int>(from_right));
    const DigitValue* found = find_digit(module, keywords_[i], value);
    if (found == nullptr)
      throw Error(ErrorKind::configuration,
                  fmt::format("{} ({}) = {} does not exist in module {}", letters[i], keywords_[i], value, module),
                  where, values_that_exist(module, keywords_[i]));
    values_.push_back(value);
    positions_.push_back(where);
    described_.push_back(found);
  }
}

std::size_t ControlWord::index(std::string_view keyword) const {
  return static_cast<std::size_t>(std::find(keywords_.begin(), keywords_.end(), keyword) - keywords_.begin());
}
int ControlWord::operator[](std::string_view keyword) const { return values_.at(index(keyword)); }
SourcePosition ControlWord::where(std::string_view keyword) const { return positions_.at(index(keyword)); }
const DigitValue& ControlWord::described(std::string_view keyword) const { return *described_.at(index(keyword)); }

}  // namespace treadmark::io
