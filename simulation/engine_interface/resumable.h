// What evolves in a run, as numbers: saved at one instant and restored later, in another process if
// need be, the run continues from there bit for bit as it did.
#pragma once

#include <cstdint>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "math/rotation.h"

namespace hookpoint::simulation {

/// An instant of a run as numbers, which a movie keeps.
class Saveable {
 public:
  virtual ~Saveable() = default;
  /// How many numbers; the same for the object's life.
  virtual std::size_t state_size() const = 0;
  /// What they are, in order: "position orientation ... hook[4]". Numbers of one layout mean
  /// nothing in another.
  virtual std::string state_layout() const = 0;
  /// `numbers`: state_size() of them. Allocates nothing.
  virtual void save(std::span<double> numbers) const = 0;
};

/// Numbers that are all of it: restored, the run continues from there.
class Resumable : public Saveable {
 public:
  /// The state is right from now on. What belongs to the step that led to it (accelerations, forces
  /// between bodies) is right again after the next step.
  virtual void restore(std::span<const double> numbers) = 0;
};

/// A stretch of a run's numbers that belongs to one owner.
struct StateSection {
  std::string name;    ///< "engine dts", "pd1", "wire a.output -> b.input"
  std::string layout;  ///< what they are, in order
  std::size_t size = 0;
};

/// The four ways of going through a state's parts, so that their order and their names are written
/// down once:
///   template <class Self, class Archive> static void exchange(Self& self, Archive& archive) {
///     archive("position", self.position_); archive("count", self.count_); }
/// A part is a number, a vector, a quaternion or a row of numbers; `each` goes through a row of
/// things with several parts. Whole numbers are exact up to 2^53.
class StateCount {
 public:
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(std::string_view /*name*/, Number) { ++count_; }
  void operator()(std::string_view /*name*/, const Vector3d&) { count_ += 3; }
  void operator()(std::string_view /*name*/, const Quaterniond&) { count_ += 4; }
  template <class Number>
  void operator()(std::string_view /*name*/, const std::vector<Number>& row) {
    for (const Number& value : row) (*this)("", value);
  }
  template <class Row, class Visit>
  void each(std::string_view /*name*/, Row& row, const Visit& visit) {
    for (auto& element : row) visit(element, *this);
  }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
};

/// "position[3] count contact(hook[3] attached)[8]".
class StateLayout {
 public:
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(std::string_view name, Number) { add(name, ""); }
  void operator()(std::string_view name, const Vector3d&) { add(name, "[3]"); }
  void operator()(std::string_view name, const Quaterniond&) { add(name, "[4]"); }
  template <class Number>
  void operator()(std::string_view name, const std::vector<Number>& row) {
    each(name, row, [](const Number& value, StateLayout& layout) { layout("", value); });
  }
  /// Nothing of an empty row; the elements are alike.
  template <class Row, class Visit>
  void each(std::string_view name, Row& row, const Visit& visit) {
    const auto count = std::ranges::distance(row);
    if (count == 0) return;
    StateLayout element;
    visit(*std::ranges::begin(row), element);
    const std::string inside = element.text_.starts_with('[') || element.text_.empty()
                                   ? element.text_
                                   : "(" + element.text_ + ")";
    add(name, inside + "[" + std::to_string(count) + "]");
  }
  const std::string& text() const { return text_; }

 private:
  void add(std::string_view name, std::string_view size) {
    if (!text_.empty()) text_ += ' ';
    text_.append(name).append(size);
  }
  std::string text_;
};

class StateSaver {
 public:
  explicit StateSaver(std::span<double> numbers) : next_(numbers.data()) {}
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(std::string_view /*name*/, Number value) {
    *next_++ = static_cast<double>(value);
  }
  void operator()(std::string_view /*name*/, const Vector3d& v) {
    for (const double value : {v.x, v.y, v.z}) *next_++ = value;
  }
  void operator()(std::string_view /*name*/, const Quaterniond& q) {
    for (const double value : {q.w, q.x, q.y, q.z}) *next_++ = value;
  }
  template <class Number>
  void operator()(std::string_view /*name*/, const std::vector<Number>& row) {
    for (const Number& value : row) (*this)("", value);
  }
  template <class Row, class Visit>
  void each(std::string_view /*name*/, Row& row, const Visit& visit) {
    for (auto& element : row) visit(element, *this);
  }

 private:
  double* next_;
};

class StateRestorer {
 public:
  explicit StateRestorer(std::span<const double> numbers) : next_(numbers.data()) {}
  void operator()(std::string_view /*name*/, double& value) { value = *next_++; }
  void operator()(std::string_view /*name*/, bool& value) { value = *next_++ != 0.; }
  void operator()(std::string_view /*name*/, int& value) { value = static_cast<int>(*next_++); }
  void operator()(std::string_view /*name*/, std::int64_t& value) {
    value = static_cast<std::int64_t>(*next_++);
  }
  void operator()(std::string_view /*name*/, std::uint64_t& value) {
    value = static_cast<std::uint64_t>(*next_++);
  }
  void operator()(std::string_view /*name*/, Vector3d& v) {
    for (double* value : {&v.x, &v.y, &v.z}) *value = *next_++;
  }
  void operator()(std::string_view /*name*/, Quaterniond& q) {
    for (double* value : {&q.w, &q.x, &q.y, &q.z}) *value = *next_++;
  }
  template <class Number>
  void operator()(std::string_view /*name*/, std::vector<Number>& row) {
    for (Number& value : row) (*this)("", value);
  }
  template <class Row, class Visit>
  void each(std::string_view /*name*/, Row& row, const Visit& visit) {
    for (auto& element : row) visit(element, *this);
  }

 private:
  const double* next_;
};

/// The four ways, of anything with an `exchange`.
template <class Part>
std::size_t count_of(const Part& part) {
  StateCount count;
  Part::exchange(part, count);
  return count.count();
}
template <class Part>
std::string layout_of(const Part& part) {
  StateLayout layout;
  Part::exchange(part, layout);
  return layout.text();
}
template <class Part>
void save_to(std::span<double> numbers, const Part& part) {
  StateSaver saver(numbers);
  Part::exchange(part, saver);
}
template <class Part>
void restore_from(std::span<const double> numbers, Part& part) {
  StateRestorer restorer(numbers);
  Part::exchange(part, restorer);
}

}  // namespace hookpoint::simulation
