// Parameters of an engine: which there are, and their values.
#pragma once

#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hookpoint::translation {

/// The user's parameters are wrong; the message says which and what to write.
struct ParameterError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// There is no contact whose constants could be translated; the message says why.
struct NothingToTranslate : ParameterError {
  using ParameterError::ParameterError;
};

/// Numbers, or one word.
struct Value {
  std::vector<double> numbers;
  std::string word;  ///< of a parameter with choices
};

/// One parameter of an engine, as its users write it.
struct Parameter {
  std::string_view name;
  std::string_view unit;                  ///< of its numbers; "" for a ratio
  Value default_;                         ///< of the engine
  std::vector<std::string_view> choices;  ///< of a word; empty for numbers
  std::string_view meaning;               ///< in N/m, N s/m or m/s: for the manual
  double least = 0.;                      ///< of each number; may be -infinity
};

/// Values of all parameters of an engine.
class Parameters {
 public:
  /// At the engine's defaults.
  explicit Parameters(std::span<const Parameter> rows);

  double number(std::string_view name, std::size_t index = 0) const;
  const std::string& word(std::string_view name) const { return values_.at(name).word; }
  /// All numbers of a parameter, with blanks in between.
  std::string text(std::string_view name) const;
  const Value& value(std::string_view name) const { return values_.at(name); }
  void set(std::string_view name, std::vector<double> numbers);
  void set(std::string_view name, double number) { set(name, std::vector<double>{number}); }
  void set_word(std::string_view name, std::string word);
  std::span<const Parameter> rows() const { return rows_; }

  /// "solref=0.02,1": numbers in the parameter's unit, the first ones of several. Throws
  /// ParameterError.
  void read(const std::string& setting);

 private:
  std::span<const Parameter> rows_;
  std::map<std::string_view, Value> values_;
};

/// "0.02 1", with `between` in between.
std::string numbers_text(const std::vector<double>& numbers, std::string_view between = " ");

}  // namespace hookpoint::translation
