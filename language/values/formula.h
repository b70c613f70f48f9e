// Formulas: expressions whose names get their values later, a port's at every step of a run or a
// Param's of a scene. Kept as a tree with its places; evaluated without allocating.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "language/diagnostics.h"
#include "language/values/expression.h"

namespace hookpoint::language {

enum class FormulaOperation : std::uint8_t {
  number,   ///< `constant`
  boolean,  ///< `constant`, 0 or 1
  name,     ///< names[operand]
  apply,    ///< `sign`
  choose,   ///< c ? a : b
  call,     ///< `function`
};

struct FormulaNode {
  FormulaOperation operation = FormulaOperation::number;
  Operator sign{};
  Quantity constant{};
  std::uint32_t name = 0;
  Range operands{};  ///< of Formula::operands
  std::string function{};
  NumberFunction apply = nullptr;  ///< of `function`
  Position place{};
};

/// An expression of names. Every node stands behind those that it takes; the last one is the whole.
struct Formula {
  std::vector<FormulaNode> nodes;
  std::vector<std::uint32_t> operands;  ///< nodes
  std::vector<std::string> names;       ///< trails, or strings in quotes; each once, as written
  std::vector<Position> places;         ///< where each name stands first
  std::string text;                     ///< as the language reads it back, its variables replaced
  Position position;
};

/// The formula of `expression`: the file's own variables are replaced by their values, every other
/// name is kept. Nothing after an error in `report`. Cost: linear.
std::optional<Formula> make_formula_of(const ExpressionEvaluator& evaluator,
                                       const Expression& expression, Report& report);
/// The formula of a text such as Formula::text, in which every name is kept; nothing for one that
/// cannot be read.
std::optional<Formula> read_formula(const std::string& text);

/// The dimension of a formula's value; nothing where it follows from a name whose own is not known.
struct FormulaUnit {
  std::optional<Dimension> dimension;
};
/// `names`: the dimension of each, nothing where it is not known. Nothing after an error, at its
/// place, in `diagnostics`: units that do not fit, an unknown function, a word in the place of a
/// number.
std::optional<FormulaUnit> unit_of(const Formula& formula,
                                   std::span<const std::optional<Dimension>> names,
                                   Diagnostics& diagnostics);

/// Computes a formula that `unit_of` found no error in, again and again.
class FormulaEvaluator {
 public:
  /// `formula` outlives it.
  explicit FormulaEvaluator(const Formula& formula);
  /// The value in SI, `names` being those of the formula's names; truth is 1 or 0. Not finite where
  /// there is none (a division by zero). Both sides of a condition are computed. Allocates nothing.
  double operator()(std::span<const double> names);

 private:
  const Formula& formula_;
  std::vector<double> values_;     // of the nodes
  std::vector<double> arguments_;  // of a call
};

}  // namespace hookpoint::language
