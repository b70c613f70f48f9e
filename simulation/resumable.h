// What evolves in a run, as numbers: saved at one instant and restored later, in another process if
// need be, the run goes on from there bit for bit as it did.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

#include "math/rotation.h"

namespace hookpoint::simulation {

class Resumable {
 public:
  virtual ~Resumable() = default;
  /// How many numbers; the same for the object's life.
  virtual std::size_t state_size() const = 0;
  /// What they are, in order: "position orientation ... hook[4]". Numbers of one layout mean
  /// nothing in another.
  virtual std::string state_layout() const = 0;
  /// `numbers`: state_size() of them. Allocates nothing.
  virtual void save(std::span<double> numbers) const = 0;
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

/// The three ways of going through a state's parts, so that their order is written down once:
///   template <class Self, class Archive> void exchange(Self& self, Archive& archive) {
///     archive(self.position); archive(self.count); }
/// Whole numbers are exact up to 2^53.
class StateCount {
 public:
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(Number) { ++count_; }
  void operator()(const Vector3d&) { count_ += 3; }
  void operator()(const Quaterniond&) { count_ += 4; }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_ = 0;
};

class StateSaver {
 public:
  explicit StateSaver(std::span<double> numbers) : next_(numbers.data()) {}
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(Number value) { *next_++ = static_cast<double>(value); }
  void operator()(const Vector3d& v) {
    for (const double value : {v.x, v.y, v.z}) *next_++ = value;
  }
  void operator()(const Quaterniond& q) {
    for (const double value : {q.w, q.x, q.y, q.z}) *next_++ = value;
  }

 private:
  double* next_;
};

class StateRestorer {
 public:
  explicit StateRestorer(std::span<const double> numbers) : next_(numbers.data()) {}
  void operator()(double& value) { value = *next_++; }
  void operator()(bool& value) { value = *next_++ != 0.; }
  void operator()(int& value) { value = static_cast<int>(*next_++); }
  void operator()(std::int64_t& value) { value = static_cast<std::int64_t>(*next_++); }
  void operator()(std::uint64_t& value) { value = static_cast<std::uint64_t>(*next_++); }
  void operator()(Vector3d& v) {
    for (double* value : {&v.x, &v.y, &v.z}) *value = *next_++;
  }
  void operator()(Quaterniond& q) {
    for (double* value : {&q.w, &q.x, &q.y, &q.z}) *value = *next_++;
  }

 private:
  const double* next_;
};

}  // namespace hookpoint::simulation
