// Formulas as components: what an Expression and a StateMachine share. The names in their formulas
// are ports of the file; each drives an element of the component's input `in`, and the component
// reads the formula back from its text.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "control/registry.h"
#include "language/dimension.h"
#include "language/tree/object.h"
#include "language/values/formula.h"
#include "simulation/scene/load_parts.h"

namespace hookpoint::simulation {

/// A name that a class gives a value itself: `time`, `previous`.
struct FormulaWord {
  std::string_view name;
  std::optional<language::Dimension> dimension;  ///< nothing: any
};

/// The ports that formulas name, each once, in the order of the texts: element i of `in` is the
/// i-th. The loader and the component number them by this one function's rule.
class FormulaInputs {
 public:
  explicit FormulaInputs(std::vector<std::string_view> words) : words_(std::move(words)) {}
  /// Index of a word, or the number of words + index of an input; new names are added. O(log
  /// names).
  std::size_t place(const std::string& name);
  std::size_t word_count() const { return words_.size(); }
  std::size_t size() const { return places_.size(); }
  /// Room for the words and the inputs, which `in` holds.
  std::vector<double> values_for(const control::Input& in) const;

 private:
  std::vector<std::string_view> words_;
  std::map<std::string, std::size_t> places_;  ///< of inputs, in the order of the texts
};

/// Copies the first values of `in`.
void read_inputs(const control::Input& in, std::span<double> values);

/// A formula that a component computes: words first, then the inputs, as numbered by
/// `FormulaInputs`.
class ComponentFormula {
 public:
  /// Throws std::runtime_error for a text that is no formula.
  ComponentFormula(const std::string& text, FormulaInputs& inputs);
  /// In SI; `values`: the words, then the inputs. Allocates nothing.
  double operator()(std::span<const double> values);

 private:
  std::unique_ptr<language::Formula> formula_;  // stays where it is: the evaluator refers to it
  language::FormulaEvaluator evaluator_;
  std::vector<std::size_t> places_;
  std::vector<double> names_;
};

/// Resolves the names of the formulas of one component and checks their units.
class FormulaLoader {
 public:
  /// `index` of the component among the experiment's.
  FormulaLoader(const language::Object& object, std::size_t index, std::vector<FormulaWord> words,
                Loading& loading);
  /// Adds what `formula`, given at `scope`, reads to `loading.formula_inputs`. Nothing after an
  /// error; else its unit where it is known.
  std::optional<language::FormulaUnit> add(const language::Formula& formula,
                                           const language::Object& scope);

 private:
  /// The dimension of what the name reads, in `dimension`. False after an error.
  bool resolve(const std::string& name, const language::Position& place,
               const language::Object& scope, std::optional<language::Dimension>& dimension);

  const language::Object& object_;
  std::size_t index_;
  std::vector<FormulaWord> words_;
  Loading& loading_;
  FormulaInputs inputs_;
};

/// The formula that a field of the object holds in quotes; nothing after an error, at its place in
/// the formula.
std::optional<language::Formula> formula_of(const language::Object& object, std::string_view field,
                                            Loading& loading);

/// The dimension of a port, where it is known: a field's unit, or what the `unit` of an Expression,
/// Input or StateMachine says of its output.
std::optional<language::Dimension> dimension_of_port(const language::Object& object,
                                                     const language::FieldSchema& field);
/// The dimension that a text such as "N.m/rad" names; nothing, after an error, where it names none.
std::optional<language::Dimension> declared_dimension(const language::Object& object,
                                                      std::string_view field, Loading& loading);

// What is special about these classes, for component.cpp.

/// Changes what component_schema makes of a class's ports into fields of the language.
void describe_formula_class(language::ClassSchema& schema);
/// Adds the texts of a class of formulas to the spec, which is `index` of the experiment's.
void load_formulas(const language::Object& object, const control::ComponentClass& type,
                   std::size_t index, ComponentSpec& spec, Loading& loading);

// Of state_machine.cpp, for expression.cpp and component.cpp.

void describe_state_machine(language::ClassSchema& schema);
/// The text by which the component knows its states and transitions.
std::string state_machine_program(const language::Object& object, std::size_t index,
                                  Loading& loading);
/// State and Transition.
void add_state_machine_parts(language::Schema& schema);

}  // namespace hookpoint::simulation
