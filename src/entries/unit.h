#pragma once
/// The unit of an entry of a parameter file or of a column of a file, in words. The words are `length`, `mass`, `time`,
/// `pressure`, `radius` (the radius of the ball) and `1`. `^` raises a word to a positive whole power, and `*` and `/`
/// join words from left to right ("mass*length^2/time"). An empty text means a pure number. A unit with another word or
/// power does not compile.

#include <string_view>

namespace pseudorigid::scene {

namespace detail {

/// The whole number with these digits. The result is 0 if the text contains another character or is empty.
constexpr int whole_number(std::string_view digits) {
  int number = 0;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') return 0;
    number = 10 * number + (digit - '0');
  }
  return number;
}

/// Calls visitor(word, power) for each factor of a unit in words. The power of a divisor is negative, and a power that
/// is not written as a positive whole number is 0.
template <class Visitor>
constexpr void visit_factors(std::string_view words, Visitor&& visitor) {
  bool divide = false;
  for (std::size_t i = 0; i < words.size();) {
    const std::size_t found = words.find_first_of("*/", i), end = found < words.size() ? found : words.size();
    const std::string_view factor = words.substr(i, end - i);
    const std::size_t caret = factor.find('^');
    const int power = caret < factor.size() ? whole_number(factor.substr(caret + 1)) : 1;
    visitor(factor.substr(0, caret), divide ? -power : power);
    divide = end < words.size() && words[end] == '/';
    i = end + 1;
  }
}

}  // namespace detail

/// A unit. The compiler checks its words. They must be a string literal, because units.cpp identifies a unit by the
/// address of its words.
class Unit {
 public:
  constexpr Unit() = default;
  consteval Unit(const char* words) : words_(words) {
    if (!is_unit(words_)) throw "a unit has the factors length, mass, time, pressure, radius and 1, with whole powers";
  }

  /// True if every word is known, and every power is written as a positive whole number.
  static constexpr bool is_unit(std::string_view words) {
    bool sound = true;
    detail::visit_factors(words, [&](std::string_view word, int power) {
      bool known = false;
      for (const std::string_view factor : {"length", "mass", "time", "pressure", "radius", "1"})
        known = known || word == factor;
      sound = sound && known && power != 0;
    });
    return sound;
  }

  constexpr operator std::string_view() const { return words_; }
  constexpr bool empty() const { return words_.empty(); }

  /// Calls visitor(word, power) for each factor of the unit. The power of a divisor is negative.
  template <class Visitor>
  constexpr void visit(Visitor&& visitor) const {
    detail::visit_factors(words_, visitor);
  }

 private:
  std::string_view words_;
};

}  // namespace pseudorigid::scene
