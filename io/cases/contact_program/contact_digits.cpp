// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/contact_program/contact_digits.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/model/contact/theories.hpp"

namespace treadmark::io {

namespace {

constexpr auto yes = DigitSupport::yes;
constexpr auto maybe = DigitSupport::conditional;
constexpr auto no_effect = DigitSupport::no_effect;
constexpr auto no = DigitSupport::no;

/// A digit: the control word in which it stands, its letter there, and the module if the other one has none.
struct ControlDigit {
  ControlWord::Name word;
  char letter;
  std::string_view keyword;
  int module = 0;
};
/// In the order of the input.
constexpr auto kControlDigits = [] {
  using enum ControlWord::Name;
  return std::to_array<ControlDigit>(
      {{problem, 'C', "CONFIG", 1}, {problem, 'P', "PVTIME"},  {problem, 'B', "BOUND"},   {problem, 'T', "TANG"},
       {problem, 'N', "NORM"},      {problem, 'F', "FORCE"},   {problem, 'S', "STRESS"},  {model, 'V', "VARFRC"},
       {model, 'L', "FRCLAW"},      {model, 'D', "DISCNS"},    {model, 'C', "INFLCF"},    {model, 'M', "MATER"},
       {model, 'Z', "ZTRACK", 1},   {model, 'Z', "RZNORM", 3}, {model, 'E', "EWHEEL", 1}, {model, 'E', "EXRHS", 3},
       {run, 'X', "XFLOW"},         {run, 'H', "HEAT"},        {run, 'G', "GAUSEI"},      {run, 'I', "IESTIM"},
       {run, 'A', "MATFIL"},        {run, 'O', "OUTPUT"},      {run, 'W', "FLOW"},        {run, 'R', "RETURN"}});
}();

auto find_control(std::string_view keyword) { return ranges::find(kControlDigits, keyword, &ControlDigit::keyword); }

// Without those of theories, see model/contact/theories.hpp.
constexpr DigitValue kDigits[] = {
    {1, "CONFIG", 0, yes, "left wheel on track"},
    {1, "CONFIG", 1, yes, "right wheel on track"},
    {1, "CONFIG", 4, yes, "left wheel on roller, or in a ring (NOMRAD < 0)"},
    {1, "CONFIG", 5, yes, "right wheel on roller, or in a ring (NOMRAD < 0)"},
    {1, "PVTIME", 0, yes, "continue from the previous case"},
    {1, "PVTIME", 1, yes, "keep the normal part of the previous case"},
    {1, "PVTIME", 2, yes, "start without history"},
    {1, "PVTIME", 3, yes, "keep the previous time"},
    {1, "BOUND", 1, yes, "thin flexible sheet"},
    {1, "NORM", 0, yes, "position z_ws given"},
    {1, "NORM", 1, yes, "vertical force given"},
    {1, "FORCE", 0, yes, "pitch rate given"},
    {1, "FORCE", 1, maybe, "longitudinal force given", "T = 1 ... 3"},
    {1, "FORCE", 2, no, "moment about the axle given", "F = 1 with a force, or F = 0"},
    {1, "FORCE", 3, maybe, "massless rail", "KYRAIL > 0; with N = 0 KZRAIL > 0"},
    {1, "STRESS", 0, yes, "no subsurface stresses"},
    {1, "STRESS", 1, maybe, "subsurface stresses, stored points", "after a case with S = 3"},
    {1, "STRESS", 2, maybe, "subsurface stresses, new digits", "after a case with S = 3"},
    {1, "STRESS", 3, yes, "subsurface stresses, new points"},
    {1, "VARFRC", 0, yes, "one friction law"},
    {1, "VARFRC", 1, yes, "friction varies with the surface inclination"},
    {1, "VARFRC", 2, yes, "friction varies along the rail"},
    {1, "FRCLAW", 0, yes, "Coulomb friction"},
    {1, "FRCLAW", 1, yes, "keep the friction law"},
    {1, "FRCLAW", 2, yes, "linear falling friction"},
    {1, "FRCLAW", 3, yes, "rational falling friction"},
    {1, "FRCLAW", 4, yes, "exponential falling friction"},
    {1, "FRCLAW", 5, yes, "Polach's falling friction: FSTAT A B"},
    {1, "FRCLAW", 6, maybe, "temperature-dependent friction", "needs H = 1 or 3"},
    {1, "DISCNS", 0, yes, "keep the discretisation"},
    {1, "DISCNS", 1, yes, "keep the discretisation"},
    {1, "DISCNS", 2, yes, "automatic contact search"},
    {1, "DISCNS", 3, maybe, "rigid slip evaluated on the surfaces", "M = 0, 1, 4"},
    {1, "DISCNS", 4, maybe, "conformal contact", "B = 0, 1 and M = 0, 1, 4"},
    {1, "DISCNS", 5, yes, "contact search on a grid"},
    {1, "DISCNS", 6, yes, "contact search on a grid, steep slopes"},
    {1, "DISCNS", 7, yes, "reference at the initial contact point"},
    {1, "DISCNS", 8, no, "oblique contact search", "D = 6, a grid for steep slopes"},
    {1, "DISCNS", 9, no, "oblique contact search", "D = 6, a grid for steep slopes"},
    {1, "INFLCF", 0, yes, "keep material and influence coefficients"},
    {1, "INFLCF", 1, yes, "keep material and influence coefficients"},
    {1, "INFLCF", 9, no, "numerical influence coefficients", "C = 4 with D = 4, or module 3"},
    {1, "MATER", 0, yes, "elastic"},
    {1, "MATER", 1, maybe, "viscoelastic", "T = 0, 3, rolling forward; C = 2, K = 0"},
    {1, "MATER", 4, maybe, "elastic with interface layer", "rolling with a layer that yields: DQREL = 1"},
    {1, "MATER", 6, no, "a forerunner of FaStrip", "M = 5, FaStrip"},
    {1, "MATER", 7, no, "a forerunner of FaStrip", "M = 5, FaStrip"},
    {1, "ZTRACK", 0, yes, "keep the track"},
    {1, "ZTRACK", 1, yes, "read track dimensions and rail profile"},
    {1, "ZTRACK", 2, yes, "read track deviations"},
    {1, "ZTRACK", 3, yes, "read dimensions, rail profile and deviations"},
    {1, "EWHEEL", 0, yes, "keep the wheelset"},
    {1, "EWHEEL", 1, yes, "read the position"},
    {1, "EWHEEL", 2, yes, "read position and velocity"},
    {1, "EWHEEL", 3, yes, "read dimensions, wheel profile, position and velocity"},
    {1, "EWHEEL", 4, yes, "read position, velocity and deviations of the flexible wheelset"},
    {1, "EWHEEL", 5, yes, "read everything, with deviations of the flexible wheelset"},
    {1, "HEAT", 1, maybe, "surface temperatures, kept data", "T = 3 only"},
    {1, "HEAT", 3, maybe, "surface temperatures", "T = 3 only"},

    {3, "PVTIME", 0, yes, "continue from the previous case"},
    {3, "PVTIME", 1, yes, "keep the normal part of the previous case"},
    {3, "PVTIME", 2, yes, "start without history"},
    {3, "PVTIME", 3, yes, "keep the previous time"},
    {3, "BOUND", 1, yes, "thin flexible sheet"},
    {3, "NORM", 0, yes, "approach given"},
    {3, "NORM", 1, yes, "normal force given"},
    {3, "FORCE", 0, yes, "creepages given"},
    {3, "FORCE", 1, yes, "longitudinal force given"},
    {3, "FORCE", 2, yes, "longitudinal and lateral force given"},
    {3, "STRESS", 0, yes, "no subsurface stresses"},
    {3, "STRESS", 1, maybe, "subsurface stresses, stored points", "after a case with S = 3"},
    {3, "STRESS", 2, maybe, "subsurface stresses, new digits", "after a case with S = 3"},
    {3, "STRESS", 3, yes, "subsurface stresses, new points"},
    {3, "VARFRC", 0, yes, "one friction law"},
    {3, "VARFRC", 3, yes, "a friction law for each row"},
    {3, "FRCLAW", 0, yes, "Coulomb friction"},
    {3, "FRCLAW", 1, yes, "keep the friction law"},
    {3, "FRCLAW", 2, yes, "linear falling friction"},
    {3, "FRCLAW", 3, yes, "rational falling friction"},
    {3, "FRCLAW", 4, yes, "exponential falling friction"},
    {3, "FRCLAW", 5, yes, "Polach's falling friction: FSTAT A B"},
    {3, "FRCLAW", 6, maybe, "temperature-dependent friction", "needs H = 1 or 3"},
    {3, "DISCNS", 0, yes, "keep the potential contact"},
    {3, "DISCNS", 1, yes, "recompute the potential contact"},
    {3, "DISCNS", 2, yes, "read the potential contact"},
    {3, "INFLCF", 0, yes, "keep material and influence coefficients"},
    {3, "INFLCF", 1, yes, "keep material and influence coefficients"},
    {3, "MATER", 0, yes, "elastic"},
    {3, "MATER", 1, maybe, "viscoelastic", "T = 0, 3 with CHI = 0, C = 2, K = 0"},
    {3, "MATER", 4, maybe, "elastic with interface layer",
     "rolling with a layer that yields: DQ = DX, CHI = 0 or 180d"},
    {3, "MATER", 6, no, "a forerunner of FaStrip", "M = 5, FaStrip"},
    {3, "MATER", 7, no, "a forerunner of FaStrip", "M = 5, FaStrip"},
    {3, "RZNORM", 0, yes, "keep the undeformed distance"},
    {3, "RZNORM", 1, yes, "recompute the undeformed distance"},
    {3, "RZNORM", 2, yes, "read the undeformed distance"},
    {3, "EXRHS", 0, yes, "no extra rigid slip"},
    {3, "EXRHS", 1, yes, "keep the extra rigid slip"},
    {3, "EXRHS", 2, maybe, "spin removed from the lateral rigid slip", "M = 0, 1, 4"},
    {3, "EXRHS", 3, maybe, "spin removed from the longitudinal rigid slip", "M = 0, 1, 4"},
    {3, "EXRHS", 9, yes, "extra rigid slip of every element"},
    {3, "HEAT", 1, maybe, "surface temperatures, kept data", "T = 3 only"},
    {3, "HEAT", 3, maybe, "surface temperatures", "T = 3 only"},
};

// The third control word is the same in both modules; it steers the run of the program more than the problem.
constexpr DigitValue kRunDigits[] = {
    {0, "XFLOW", -1, no_effect, "debug output"},
    {0, "HEAT", 0, yes, "no temperatures"},
    {0, "GAUSEI", 0, yes, "default solvers, read their limits"},
    {0, "GAUSEI", 1, yes, "keep solver settings"},
    {0, "GAUSEI", 2, yes, "sweeps over single elements (ConvexGS)"},
    {0, "GAUSEI", 3, no_effect, "solver SteadyGS"},
    {0, "GAUSEI", 4, yes, "default solvers, first slip velocity of falling friction"},
    {0, "GAUSEI", 5, no_effect, "solver GDsteady"},
    {0, "IESTIM", -1, no_effect, "initial estimate"},
    {0, "MATFIL", 0, yes, "no table of elements (.mat)"},
    {0, "MATFIL", 1, yes, "table of the elements in contact"},
    {0, "MATFIL", 2, yes, "table of all elements"},
    {0, "OUTPUT", -1, yes, "amount of output; 0: the case is solved, its patches are not in the results"},
    {0, "FLOW", -1, no_effect, "trace of the calculation"},
    {0, "RETURN", 0, yes, "run; the next case follows without module line"},
    {0, "RETURN", 1, yes, "run; the next case starts with a module line"},
    {0, "RETURN", 2, yes, "skip this case; the next one follows without module line"},
    {0, "RETURN", 3, yes, "skip this case; the next one starts with a module line"},
};

template <class Id, std::size_t count>
void add_theories(std::vector<DigitValue>& list, std::string_view keyword, const Theory<Id> (&table)[count]) {
  for (const int module : {1, 3})
    for (const Theory<Id>& row : table) {
      if (row.digit.value < 0 || (module == 1 && row.limits.patch_only)) continue;
      const std::string_view needs = module == 1 ? row.digit.on_rail : row.digit.of_patch;
      list.push_back({module, keyword, row.digit.value, needs.empty() ? yes : maybe, row.name, needs});
    }
}

const DigitValue* find_digit(int module, std::string_view keyword, int value) {
  for (const DigitValue& d : contact_digits())
    if ((d.module == module || d.module == 0) && d.keyword == keyword && (d.value == value || d.value < 0)) return &d;
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
    add_theories(list, "BOUND", kNormalTheories);
    add_theories(list, "TANG", kRegimes);
    add_theories(list, "INFLCF", kInfluenceKinds);
    add_theories(list, "MATER", kTangentialTheories);
    const auto order = [](const DigitValue& d) { return std::tuple(d.module, find_control(d.keyword), d.value); };
    ranges::sort(list, {}, order);
    list.insert(list.end(), std::begin(kRunDigits), std::end(kRunDigits));
    for (DigitValue& d : list) d.letter = find_control(d.keyword)->letter;
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

ControlWord::ControlWord(ContactText& text, int module, Name name) {
  std::string letters;
  for (const ControlDigit& d : kControlDigits)
    if (d.word == name && (d.module == 0 || d.module == module)) letters += d.letter, keywords_.push_back(d.keyword);
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
