// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

/// What this project uses of std::ranges, by the algorithms of iterators, for standard libraries without it. Answers
/// are the same, but for the order in which an unstable sort or a shuffle leaves what it may. Ranges have a beginning
/// and an end of one type. A place in a temporary is no error here: compilers that have std::ranges find those.
namespace treadmark::own_ranges {

template <class R>
concept Range = requires(R& range) {
  std::begin(range) == std::end(range);
};

template <Range R>
using ElementOf = typename std::iterator_traits<decltype(std::begin(std::declval<R&>()))>::value_type;

/// A condition on what a projection makes of one or two elements.
template <class Condition, class Projection>
auto projected(Condition& condition, Projection& projection) {
  return [&](auto&&... elements) -> bool {
    return std::invoke(condition, std::invoke(projection, std::forward<decltype(elements)>(elements))...);
  };
}

template <class Value, class Projection>
auto projected_onto(const Value& value, Projection& projection) {
  return [&](auto&& element) -> bool {
    return std::invoke(projection, std::forward<decltype(element)>(element)) == value;
  };
}

template <Range R, class Condition, class Projection = std::identity>
bool all_of(R&& range, Condition condition, Projection projection = {}) {
  return std::all_of(std::begin(range), std::end(range), projected(condition, projection));
}
template <Range R, class Condition, class Projection = std::identity>
bool any_of(R&& range, Condition condition, Projection projection = {}) {
  return std::any_of(std::begin(range), std::end(range), projected(condition, projection));
}
template <Range R, class Condition, class Projection = std::identity>
bool none_of(R&& range, Condition condition, Projection projection = {}) {
  return std::none_of(std::begin(range), std::end(range), projected(condition, projection));
}

template <Range R, class Value, class Projection = std::identity>
auto find(R&& range, const Value& value, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range), projected_onto(value, projection));
}
template <Range R, class Condition, class Projection = std::identity>
auto find_if(R&& range, Condition condition, Projection projection = {}) {
  return std::find_if(std::begin(range), std::end(range), projected(condition, projection));
}
template <class Iterator, class Condition>
Iterator find_if(Iterator first, Iterator last, Condition condition) {
  return std::find_if(first, last, std::ref(condition));
}
template <Range R, class Condition>
auto find_if_not(R&& range, Condition condition) {
  return std::find_if_not(std::begin(range), std::end(range), std::ref(condition));
}
template <Range R, class Condition = std::equal_to<>>
auto adjacent_find(R&& range, Condition condition = {}) {
  return std::adjacent_find(std::begin(range), std::end(range), std::ref(condition));
}

template <Range R, class Value, class Projection = std::identity>
auto count(R&& range, const Value& value, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range), projected_onto(value, projection));
}
template <Range R, class Condition, class Projection = std::identity>
auto count_if(R&& range, Condition condition, Projection projection = {}) {
  return std::count_if(std::begin(range), std::end(range), projected(condition, projection));
}

template <Range R, Range S, class Same = std::equal_to<>, class OfA = std::identity, class OfB = std::identity>
bool equal(R&& a, S&& b, Same same = {}, OfA of_a = {}, OfB of_b = {}) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), [&](auto&& x, auto&& y) -> bool {
    return std::invoke(same, std::invoke(of_a, std::forward<decltype(x)>(x)),
                       std::invoke(of_b, std::forward<decltype(y)>(y)));
  });
}

template <Range R, class Less = std::less<>>
bool is_sorted(R&& range, Less less = {}) {
  return std::is_sorted(std::begin(range), std::end(range), std::ref(less));
}
template <Range R, class Less = std::less<>, class Projection = std::identity>
void sort(R&& range, Less less = {}, Projection projection = {}) {
  std::sort(std::begin(range), std::end(range), projected(less, projection));
}
template <Range R, class Less = std::less<>, class Projection = std::identity>
void stable_sort(R&& range, Less less = {}, Projection projection = {}) {
  std::stable_sort(std::begin(range), std::end(range), projected(less, projection));
}
template <Range R, class Less = std::less<>>
void push_heap(R&& range, Less less = {}) {
  std::push_heap(std::begin(range), std::end(range), less);
}
template <Range R, class Less = std::less<>>
void pop_heap(R&& range, Less less = {}) {
  std::pop_heap(std::begin(range), std::end(range), less);
}

template <Range R, class Value, class Less = std::less<>, class Projection = std::identity>
auto lower_bound(R&& range, const Value& value, Less less = {}, Projection projection = {}) {
  return std::lower_bound(std::begin(range), std::end(range), value, [&](auto&& x, const Value& v) -> bool {
    return std::invoke(less, std::invoke(projection, std::forward<decltype(x)>(x)), v);
  });
}
template <Range R, class Value, class Less = std::less<>, class Projection = std::identity>
auto upper_bound(R&& range, const Value& value, Less less = {}, Projection projection = {}) {
  return std::upper_bound(std::begin(range), std::end(range), value, [&](const Value& v, auto&& x) -> bool {
    return std::invoke(less, v, std::invoke(projection, std::forward<decltype(x)>(x)));
  });
}
template <Range R, class Value, class Less = std::less<>>
bool binary_search(R&& range, const Value& value, Less less = {}) {
  return std::binary_search(std::begin(range), std::end(range), value, less);
}

template <class T>
struct MinMax {
  T min, max;
};

template <Range R, class Less = std::less<>, class Projection = std::identity>
auto min_element(R&& range, Less less = {}, Projection projection = {}) {
  return std::min_element(std::begin(range), std::end(range), projected(less, projection));
}
template <Range R, class Less = std::less<>, class Projection = std::identity>
auto max_element(R&& range, Less less = {}, Projection projection = {}) {
  return std::max_element(std::begin(range), std::end(range), projected(less, projection));
}
/// The first of the least, the last of the greatest.
template <Range R, class Less = std::less<>, class Projection = std::identity>
auto minmax_element(R&& range, Less less = {}, Projection projection = {}) {
  const auto [min, max] = std::minmax_element(std::begin(range), std::end(range), projected(less, projection));
  return MinMax<decltype(std::begin(range))>{min, max};
}
template <Range R, class Less = std::less<>, class Projection = std::identity>
ElementOf<R> min(R&& range, Less less = {}, Projection projection = {}) {
  return *own_ranges::min_element(range, less, projection);
}
template <Range R, class Less = std::less<>, class Projection = std::identity>
ElementOf<R> max(R&& range, Less less = {}, Projection projection = {}) {
  return *own_ranges::max_element(range, less, projection);
}
template <Range R, class Less = std::less<>, class Projection = std::identity>
MinMax<ElementOf<R>> minmax(R&& range, Less less = {}, Projection projection = {}) {
  const auto found = own_ranges::minmax_element(range, less, projection);
  return {*found.min, *found.max};
}

template <Range R, class Function>
void for_each(R&& range, Function function) {
  std::for_each(std::begin(range), std::end(range), std::ref(function));
}
template <Range R, class Value>
void fill(R&& range, const Value& value) {
  std::fill(std::begin(range), std::end(range), value);
}
template <Range R>
void reverse(R&& range) {
  std::reverse(std::begin(range), std::end(range));
}
template <Range R, class Value>
void replace(R&& range, const Value& old, const Value& by) {
  std::replace(std::begin(range), std::end(range), old, by);
}
template <Range R, class Condition, class Value>
void replace_if(R&& range, Condition condition, const Value& by) {
  std::replace_if(std::begin(range), std::end(range), std::ref(condition), by);
}
template <Range R, class Out>
void copy(R&& range, Out out) {
  std::copy(std::begin(range), std::end(range), out);
}
template <Range R, class Out, class Condition>
void copy_if(R&& range, Out out, Condition condition) {
  std::copy_if(std::begin(range), std::end(range), out, std::ref(condition));
}
template <Range R, class Out, class Function>
void transform(R&& range, Out out, Function function) {
  std::transform(std::begin(range), std::end(range), out, std::ref(function));
}
/// b: no shorter than a.
template <Range R, Range S, class Out, class Function>
void transform(R&& a, S&& b, Out out, Function function) {
  std::transform(std::begin(a), std::end(a), std::begin(b), out, std::ref(function));
}
template <Range R, class Random>
void shuffle(R&& range, Random&& random) {
  std::shuffle(std::begin(range), std::end(range), random);
}

}  // namespace treadmark::own_ranges
