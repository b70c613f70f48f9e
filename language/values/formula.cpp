#include "language/values/formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "language/names.h"
#include "language/schema/describe.h"
#include "language/units.h"

namespace hookpoint::language {
namespace {

using Op = FormulaOperation;

/// How tightly an operation binds, from `? :` to what needs no parentheses.
enum Binding {
  conditional,
  disjunction,
  conjunction,
  comparison,
  sum,
  product,
  unary,
  power_of,
  closed
};

struct Infix {
  const char* sign;
  Binding binding;
};

/// Of the operators with two operands, from `add` on.
constexpr std::array infixes{
    Infix{"+", sum},         Infix{"-", sum},         Infix{"*", product},
    Infix{"/", product},     Infix{"^", power_of},    Infix{"<", comparison},
    Infix{"<=", comparison}, Infix{">", comparison},  Infix{">=", comparison},
    Infix{"==", comparison}, Infix{"!=", comparison}, Infix{"&&", conjunction},
    Infix{"||", disjunction}};

const Infix& infix_of(Operator sign) {
  return infixes[static_cast<std::size_t>(sign) - static_cast<std::size_t>(Operator::add)];
}

/// A part of the formula while it is made.
struct Part {
  std::uint32_t node = 0;
  Binding binding = closed;
  std::string text;
};

std::string in_parentheses(std::string text) { return "(" + std::move(text) + ")"; }

class FormulaMaker {
 public:
  FormulaMaker(const ExpressionEvaluator& evaluator, Report& report)
      : evaluator_(evaluator), report_(report) {}

  std::optional<Formula> run(const Expression& expression) {
    formula_.position = evaluator_.position(expression.span);
    auto whole = make(expression.code.begin, expression.code.end);
    if (!whole) return std::nullopt;
    formula_.text = std::move(whole->text);
    return std::move(formula_);
  }

 private:
  /// What the code from `begin` to `end` leaves on the stack.
  std::optional<Part> make(std::uint32_t begin, std::uint32_t end) {
    std::vector<Part> stack;
    for (std::uint32_t at = begin; at < end;) {
      const Instruction& instruction = evaluator_.syntax().code[at++];
      if (!step(instruction, stack, at)) return std::nullopt;
    }
    return std::move(stack.back());
  }

  bool step(const Instruction& instruction, std::vector<Part>& stack, std::uint32_t& at) {
    const Position place = evaluator_.position(instruction.span);
    switch (instruction.operation) {
      case Operation::push_number:
        stack.push_back(constant(evaluator_.syntax().quantities[instruction.operand], place));
        return true;
      case Operation::push_true:
      case Operation::push_false:
        stack.push_back(truth(instruction.operation == Operation::push_true, place));
        return true;
      case Operation::push_text:
        push(std::string(evaluator_.text(instruction.span)), place, stack);
        return true;
      case Operation::push_trail:
        return push_name(instruction, place, stack);
      case Operation::call:
        call(instruction, place, stack);
        return true;
      case Operation::apply:
        apply(static_cast<Operator>(instruction.operand), place, stack);
        return true;
      case Operation::jump:  // over an index, which is evaluated with its name
        at = instruction.operand;
        return true;
      case Operation::branch_if_false:
        return choose(instruction, place, stack, at);
      case Operation::skip_if_false:
      case Operation::skip_if_true:
        return connect(instruction, place, stack, at);
      case Operation::check_boolean:
        return true;
    }
    return false;
  }

  /// `c ? a : b`: the branch goes to b's code, and before that stands a jump behind it.
  bool choose(const Instruction& branch, const Position& place, std::vector<Part>& stack,
              std::uint32_t& at) {
    const std::uint32_t other = branch.operand;
    const std::uint32_t end = evaluator_.syntax().code[other - 1].operand;
    auto yes = make(at, other - 1), no = make(other, end);
    if (!yes || !no) return false;
    at = end;
    Part condition = take(stack);
    std::string text = held(condition, disjunction) + " ? " + yes->text + " : " + no->text;
    stack.push_back({add(Op::choose, place, {condition.node, yes->node, no->node}), conditional,
                     std::move(text)});
    return true;
  }

  bool connect(const Instruction& skip, const Position& place, std::vector<Part>& stack,
               std::uint32_t& at) {
    auto right = make(at, skip.operand);
    if (!right) return false;
    at = skip.operand;
    stack.push_back(std::move(*right));
    join(skip.operation == Operation::skip_if_false ? Operator::both : Operator::either, place,
         stack);
    return true;
  }

  bool push_name(const Instruction& instruction, const Position& place, std::vector<Part>& stack) {
    const Trail& trail = evaluator_.syntax().trails[instruction.operand];
    const std::string_view written = evaluator_.text(instruction.span);
    const Variable* variable = trail.parts.size() == 1 ? evaluator_.variable(written) : nullptr;
    if (variable != nullptr && !variable->stands_for_word) {
      if (variable->values.empty()) return false;  // and said to be wrong
      const Value& value = variable->values.front();
      const bool fits = variable->values.size() == 1 &&
                        (value.kind == ValueKind::number || value.kind == ValueKind::boolean);
      if (!fits) {
        report_.error(place, "`" + std::string(written) + "` is no single number here");
        return false;
      }
      stack.push_back(value.kind == ValueKind::number ? constant(value.quantity, place)
                                                      : truth(value.quantity.value != 0., place));
      return true;
    }
    if (variable == nullptr && written == "pi") {
      stack.push_back({add_constant(Op::number, {std::numbers::pi, {}}, place), closed, "pi"});
      return true;
    }
    std::optional<std::string> name = evaluator_.trail_text(trail);
    if (name) push(std::move(*name), place, stack);
    return name.has_value();
  }

  void push(std::string name, const Position& place, std::vector<Part>& stack) {
    auto found = std::ranges::find(formula_.names, name);
    if (found == formula_.names.end()) {
      formula_.names.push_back(name);
      formula_.places.push_back(place);
      found = formula_.names.end() - 1;
    }
    const std::uint32_t node = add(Op::name, place, {});
    formula_.nodes[node].name = static_cast<std::uint32_t>(found - formula_.names.begin());
    stack.push_back({node, closed, std::move(name)});
  }

  void call(const Instruction& instruction, const Position& place, std::vector<Part>& stack) {
    const std::string name(evaluator_.text(instruction.span));
    const auto first = stack.end() - static_cast<std::ptrdiff_t>(instruction.operand);
    std::vector<std::uint32_t> arguments;
    std::string text = name + "(";
    for (auto part = first; part != stack.end(); ++part) {
      text += (part == first ? "" : ", ") + part->text;
      arguments.push_back(part->node);
    }
    stack.erase(first, stack.end());
    const std::uint32_t node = add(Op::call, place, arguments);
    formula_.nodes[node].function = name;
    stack.push_back({node, closed, text + ")"});
  }

  void apply(Operator sign, const Position& place, std::vector<Part>& stack) {
    if (sign != Operator::negate && sign != Operator::logical_not) {
      join(sign, place, stack);
      return;
    }
    Part operand = take(stack);
    const char* written = sign == Operator::negate ? "-" : "!";
    stack.push_back(
        {add_applied(sign, place, {operand.node}), unary, written + held(operand, power_of)});
  }

  /// The two parts on top of the stack as one.
  void join(Operator sign, const Position& place, std::vector<Part>& stack) {
    Part right = take(stack), left = take(stack);
    const auto [written, binding] = infix_of(sign);
    // `-`, `/` and comparisons do not associate to the right, `^` not to the left.
    const auto tighter = static_cast<Binding>(binding + 1);
    const bool power = sign == Operator::raise;
    std::string text = held(left, power || binding == comparison ? tighter : binding);
    text += std::string(" ") + written + " " + held(right, power ? closed : tighter);
    stack.push_back({add_applied(sign, place, {left.node, right.node}), binding, std::move(text)});
  }

  /// The text where only what binds as tightly as `least` stands without parentheses.
  static std::string held(Part& part, Binding least) {
    return part.binding < least ? in_parentheses(std::move(part.text)) : std::move(part.text);
  }

  static Part take(std::vector<Part>& stack) {
    Part part = std::move(stack.back());
    stack.pop_back();
    return part;
  }

  Part constant(const Quantity& quantity, const Position& place) {
    const std::string unit = unit_text(quantity.dimension);
    // A name that follows could be taken for more of the unit: 6 m / g.
    const Binding binding = !unit.empty()                  ? conditional
                            : std::signbit(quantity.value) ? unary
                                                           : closed;
    return {add_constant(Op::number, quantity, place), binding,
            number_text(quantity.value) + (unit.empty() ? "" : " " + unit)};
  }

  Part truth(bool value, const Position& place) {
    return {add_constant(Op::boolean, {value ? 1. : 0., {}}, place), closed,
            value ? "true" : "false"};
  }

  std::uint32_t add_constant(Op operation, const Quantity& quantity, const Position& place) {
    const std::uint32_t node = add(operation, place, {});
    formula_.nodes[node].constant = quantity;
    return node;
  }

  std::uint32_t add_applied(Operator sign, const Position& place,
                            const std::vector<std::uint32_t>& operands) {
    const std::uint32_t node = add(Op::apply, place, operands);
    formula_.nodes[node].sign = sign;
    return node;
  }

  std::uint32_t add(Op operation, const Position& place,
                    const std::vector<std::uint32_t>& operands) {
    const auto begin = static_cast<std::uint32_t>(formula_.operands.size());
    formula_.operands.insert(formula_.operands.end(), operands.begin(), operands.end());
    FormulaNode& node = formula_.nodes.emplace_back();
    node.operation = operation;
    node.place = place;
    node.operands = {begin, static_cast<std::uint32_t>(formula_.operands.size())};
    return static_cast<std::uint32_t>(formula_.nodes.size() - 1);
  }

  const ExpressionEvaluator& evaluator_;
  Report& report_;
  Formula formula_;
};

double truth_of(bool value) { return value ? 1. : 0.; }

/// What is known of a node's value before it is computed.
struct NodeUnit {
  bool known = true;  ///< its dimension
  bool boolean = false;
  Dimension dimension;
  std::optional<double> constant;  ///< its value, where no name enters
};

class UnitChecker {
 public:
  UnitChecker(const Formula& formula, std::span<const std::optional<Dimension>> names,
              Diagnostics& diagnostics)
      : formula_(formula), names_(names), diagnostics_(diagnostics) {}

  std::optional<FormulaUnit> run() {
    for (const FormulaNode& node : formula_.nodes) {
      auto unit = unit_of_node(node);
      if (!unit) return std::nullopt;
      units_.push_back(*unit);
    }
    const NodeUnit& whole = units_.back();
    return FormulaUnit{whole.known ? std::optional(whole.dimension) : std::nullopt};
  }

 private:
  const NodeUnit& operand(const FormulaNode& node, std::uint32_t index) const {
    return units_[formula_.operands[node.operands.begin + index]];
  }

  std::optional<NodeUnit> unit_of_node(const FormulaNode& node) {
    switch (node.operation) {
      case Op::number:
        return NodeUnit{true, false, node.constant.dimension, node.constant.value};
      case Op::boolean:
        return NodeUnit{true, true, {}, node.constant.value};
      case Op::name: {
        const auto& dimension = names_[node.name];
        return NodeUnit{dimension.has_value(), false, dimension.value_or(Dimension{}), {}};
      }
      case Op::choose:
        return of_choice(node);
      case Op::call:
        return all(node, 0, false) ? of_call(node) : std::nullopt;
      case Op::apply:
        break;
    }
    if (joins_truths(node.sign)) return all(node, 0, true) ? std::optional(truth()) : std::nullopt;
    if (!all(node, 0, false)) return std::nullopt;
    return node.sign == Operator::negate ? negated(operand(node, 0)) : of_pair(node);
  }

  static bool joins_truths(Operator sign) {
    return sign == Operator::logical_not || sign == Operator::both || sign == Operator::either;
  }

  static NodeUnit truth() { return {true, true, {}, {}}; }

  static NodeUnit negated(NodeUnit unit) {
    if (unit.constant) unit.constant = -*unit.constant;
    return unit;
  }

  /// Whether the operands from `first` on are all truths, or all numbers.
  bool all(const FormulaNode& node, std::uint32_t first, bool boolean) {
    for (std::uint32_t i = first; i < node.operands.size(); ++i) {
      if (operand(node, i).boolean == boolean) continue;
      fail(node, boolean ? "expected true or false, not a number"
                         : "expected a number, not true or false");
      return false;
    }
    return true;
  }

  std::optional<NodeUnit> of_choice(const FormulaNode& node) {
    if (!operand(node, 0).boolean) return fail(node, "expected true or false before `?`");
    const NodeUnit &yes = operand(node, 1), &no = operand(node, 2);
    if (yes.boolean != no.boolean)
      return fail(node, "one side of the condition is a number, the other true or false");
    return shared(node, yes, no, "chosen between");
  }

  /// The unit of what has that of both.
  std::optional<NodeUnit> shared(const FormulaNode& node, const NodeUnit& a, const NodeUnit& b,
                                 std::string_view action) {
    NodeUnit unit = a.known && a.dimension.angle != 0 ? a : b;
    unit.known = a.known && b.known;
    unit.constant.reset();
    if (!unit.known || comparable(a.dimension, b.dimension)) return unit;
    return fail(node, describe_dimension(a.dimension) + " and " + describe_dimension(b.dimension) +
                          " cannot be " + std::string(action));
  }

  std::optional<NodeUnit> of_pair(const FormulaNode& node) {
    const NodeUnit &a = operand(node, 0), &b = operand(node, 1);
    NodeUnit unit{a.known && b.known, false, {}, {}};
    switch (node.sign) {
      case Operator::add:
        return shared(node, a, b, "added");
      case Operator::subtract:
        return shared(node, a, b, "subtracted");
      case Operator::multiply:
        unit.dimension = a.dimension * b.dimension;
        return unit;
      case Operator::divide:
        unit.dimension = a.dimension / b.dimension;
        return unit;
      case Operator::raise:
        return of_power(node, a, b);
      default:
        return shared(node, a, b, "compared") ? std::optional(truth()) : std::nullopt;
    }
  }

  std::optional<NodeUnit> of_power(const FormulaNode& node, const NodeUnit& base,
                                   const NodeUnit& exponent) {
    if (!base.known || !exponent.known) return NodeUnit{false, false, {}, {}};
    if (!base.dimension.dimensionless() && !exponent.constant)
      return fail(node, "the exponent of a value in " + unit_text(base.dimension) +
                            " is a number that is written out");
    return result(node, raise_quantity({1., base.dimension},
                                       {exponent.constant.value_or(1.), exponent.dimension}));
  }

  std::optional<NodeUnit> of_call(const FormulaNode& node) {
    std::vector<Quantity> arguments;
    for (std::uint32_t i = 0; i < node.operands.size(); ++i) {
      const NodeUnit& argument = operand(node, i);
      if (!argument.known) return NodeUnit{false, false, {}, {}};
      arguments.push_back({argument.constant.value_or(1.), argument.dimension});
    }
    const auto found = unit_of_call(node.function, arguments);
    if (found) return result(node, *found);
    return fail(node, "unknown function `" + node.function + "`" +
                          did_you_mean(node.function, function_names()));
  }

  std::optional<NodeUnit> result(const FormulaNode& node, const FunctionResult& found) {
    if (!found.error.empty()) return fail(node, found.error);
    return NodeUnit{true, false, found.quantity.dimension, {}};
  }

  std::nullopt_t fail(const FormulaNode& node, std::string message) {
    diagnostics_.error(node.place, std::move(message));
    return std::nullopt;
  }

  const Formula& formula_;
  std::span<const std::optional<Dimension>> names_;
  Diagnostics& diagnostics_;
  std::vector<NodeUnit> units_;
};

/// `b` is of operators with two operands.
double compute(Operator sign, double a, double b) {
  switch (sign) {
    case Operator::negate:
      return -a;
    case Operator::logical_not:
      return truth_of(a == 0.);
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::divide:
      return a / b;
    case Operator::raise:
      return std::pow(a, b);
    case Operator::less:
      return truth_of(a < b);
    case Operator::less_equal:
      return truth_of(a <= b);
    case Operator::greater:
      return truth_of(a > b);
    case Operator::greater_equal:
      return truth_of(a >= b);
    case Operator::equal:
      return truth_of(a == b);
    case Operator::not_equal:
      return truth_of(a != b);
    case Operator::both:
      return truth_of(a != 0. && b != 0.);
    case Operator::either:
      return truth_of(a != 0. || b != 0.);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::optional<Formula> make_formula_of(const ExpressionEvaluator& evaluator,
                                       const Expression& expression, Report& report) {
  auto formula = FormulaMaker(evaluator, report).run(expression);
  if (!formula) return std::nullopt;
  for (FormulaNode& node : formula->nodes) {
    if (node.operation != Op::call) continue;
    if (std::ranges::find(function_names(), node.function) != function_names().end()) {
      node.apply = number_function(node.function);
      continue;
    }
    report.error(node.place, "unknown function `" + node.function + "`" +
                                 did_you_mean(node.function, function_names()));
    return std::nullopt;
  }
  return formula;
}

std::optional<Formula> read_formula(const std::string& text) {
  const SourceFile source = source_file("", "formula = " + text);
  ParsedFile file{source};
  parse_override(file);
  if (file.report.has_errors()) return std::nullopt;
  const Range value = file.syntax.items[file.syntax.top.begin].value;
  if (value.size() != 1) return std::nullopt;
  const Variables none;
  Report report;
  Budget budget;
  const ExpressionEvaluator evaluator(file, none, report, budget);
  auto formula = make_formula_of(evaluator, file.syntax.expressions[value.begin], report);
  if (!formula) return std::nullopt;
  // The text goes, so nothing may point into it.
  for (FormulaNode& node : formula->nodes) node.place = {};
  for (Position& place : formula->places) place = {};
  formula->position = {};
  return formula;
}

std::optional<FormulaUnit> unit_of(const Formula& formula,
                                   std::span<const std::optional<Dimension>> names,
                                   Diagnostics& diagnostics) {
  return UnitChecker(formula, names, diagnostics).run();
}

FormulaEvaluator::FormulaEvaluator(const Formula& formula)
    : formula_(formula), values_(formula.nodes.size()) {
  std::size_t most = 0;
  for (const FormulaNode& node : formula.nodes)
    most = std::max<std::size_t>(most, node.operands.size());
  arguments_.resize(most);
}

double FormulaEvaluator::operator()(std::span<const double> names) {
  for (std::size_t i = 0; i < formula_.nodes.size(); ++i) {
    const FormulaNode& node = formula_.nodes[i];
    const auto value = [&](std::uint32_t index) {
      return values_[formula_.operands[node.operands.begin + index]];
    };
    switch (node.operation) {
      case Op::number:
      case Op::boolean:
        values_[i] = node.constant.value;
        break;
      case Op::name:
        values_[i] = names[node.name];
        break;
      case Op::apply:
        values_[i] = compute(node.sign, value(0), node.operands.size() > 1 ? value(1) : 0.);
        break;
      case Op::choose:
        values_[i] = value(0) != 0. ? value(1) : value(2);
        break;
      case Op::call:
        for (std::uint32_t j = 0; j < node.operands.size(); ++j) arguments_[j] = value(j);
        values_[i] = node.apply(std::span(arguments_).first(node.operands.size()));
        break;
    }
  }
  return values_.back();
}

}  // namespace hookpoint::language
