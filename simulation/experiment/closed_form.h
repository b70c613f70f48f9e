// What follows from an experiment's constants alone: a value, or in one line why there is none.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace hookpoint::simulation {

/// Why an experiment has no closed form, as the rest of "no closed form: ...".
struct NoClosedForm {
  std::string why;
};

/// A value, or the reason why there is none.
template <class Value>
class ClosedForm {
 public:
  ClosedForm(Value value) : value_(std::move(value)) {}
  ClosedForm(NoClosedForm none) : why_(std::move(none.why)) {}

  explicit operator bool() const { return value_.has_value(); }
  const Value& operator*() const { return *value_; }
  const Value* operator->() const { return &*value_; }
  const std::optional<Value>& value() const { return value_; }
  /// "" where there is a value.
  const std::string& why() const { return why_; }
  NoClosedForm none() const { return {why_}; }

 private:
  std::optional<Value> value_;
  std::string why_;
};

}  // namespace hookpoint::simulation
