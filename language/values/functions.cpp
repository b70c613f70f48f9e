// The functions of expressions.
#include <algorithm>
#include <array>
#include <cmath>

#include "language/names.h"
#include "language/units.h"
#include "language/values/expression.h"

namespace hookpoint::language {
namespace {

constexpr Dimension angle_dimension{0, 0, 0, 1};

enum class Signature {
  of_angle,   ///< an angle or a pure number to a pure number
  to_angle,   ///< pure numbers to an angle
  of_number,  ///< pure numbers to a pure number
  same,       ///< arguments of one dimension to that dimension
  same_to_angle,
  same_to_number,
  special,
};

using Arguments = std::span<const double>;

struct Function {
  std::string_view name;
  std::size_t least, most;
  Signature signature;
  double (*apply)(Arguments x);
};

constexpr std::size_t many = 1000;

constexpr std::array functions{
    Function{"sin", 1, 1, Signature::of_angle, [](Arguments x) { return std::sin(x[0]); }},
    Function{"cos", 1, 1, Signature::of_angle, [](Arguments x) { return std::cos(x[0]); }},
    Function{"tan", 1, 1, Signature::of_angle, [](Arguments x) { return std::tan(x[0]); }},
    Function{"asin", 1, 1, Signature::to_angle, [](Arguments x) { return std::asin(x[0]); }},
    Function{"acos", 1, 1, Signature::to_angle, [](Arguments x) { return std::acos(x[0]); }},
    Function{"atan", 1, 1, Signature::to_angle, [](Arguments x) { return std::atan(x[0]); }},
    Function{"atan2", 2, 2, Signature::same_to_angle,
             [](Arguments x) { return std::atan2(x[0], x[1]); }},
    Function{"sinh", 1, 1, Signature::of_number, [](Arguments x) { return std::sinh(x[0]); }},
    Function{"cosh", 1, 1, Signature::of_number, [](Arguments x) { return std::cosh(x[0]); }},
    Function{"tanh", 1, 1, Signature::of_number, [](Arguments x) { return std::tanh(x[0]); }},
    Function{"exp", 1, 1, Signature::of_number, [](Arguments x) { return std::exp(x[0]); }},
    Function{"log", 1, 1, Signature::of_number, [](Arguments x) { return std::log(x[0]); }},
    Function{"log10", 1, 1, Signature::of_number, [](Arguments x) { return std::log10(x[0]); }},
    Function{"floor", 1, 1, Signature::of_number, [](Arguments x) { return std::floor(x[0]); }},
    Function{"ceil", 1, 1, Signature::of_number, [](Arguments x) { return std::ceil(x[0]); }},
    Function{"round", 1, 1, Signature::of_number, [](Arguments x) { return std::round(x[0]); }},
    Function{"abs", 1, 1, Signature::same, [](Arguments x) { return std::fabs(x[0]); }},
    Function{"sign", 1, 1, Signature::same_to_number,
             [](Arguments x) { return x[0] > 0.   ? 1.
                                      : x[0] < 0. ? -1.
                                                  : 0.; }},
    Function{"min", 1, many, Signature::same,
             [](Arguments x) { return *std::ranges::min_element(x); }},
    Function{"max", 1, many, Signature::same,
             [](Arguments x) { return *std::ranges::max_element(x); }},
    Function{"hypot", 2, 2, Signature::same, [](Arguments x) { return std::hypot(x[0], x[1]); }},
    Function{"mod", 2, 2, Signature::same,
             [](Arguments x) { return x[0] - x[1] * std::floor(x[0] / x[1]); }},
    Function{"sqrt", 1, 1, Signature::special, [](Arguments x) { return std::sqrt(x[0]); }},
    Function{"pow", 2, 2, Signature::special, [](Arguments x) { return std::pow(x[0], x[1]); }},
};

FunctionResult wrong(std::string message) { return {{}, std::move(message)}; }

/// sqrt and pow: the only ones that change a dimension.
FunctionResult apply_power(const Function& function, std::span<const Quantity> arguments,
                           double result) {
  const Dimension& base = arguments[0].dimension;
  if (function.name == "sqrt") {
    if (base.mass % 2 != 0 || base.length % 2 != 0 || base.time % 2 != 0 || base.angle % 2 != 0) {
      return wrong("sqrt of a value in " + unit_text(base) + " has no unit");
    }
    return {{result, {base.mass / 2, base.length / 2, base.time / 2, base.angle / 2}}, ""};
  }
  return raise_quantity(arguments[0], arguments[1]);
}

/// What is wrong with the units of the arguments; "" when nothing. `common`: the unit that they
/// share, where they do.
std::string problem_of(const Function& function, std::span<const Quantity> arguments,
                       Dimension& common) {
  common = arguments[0].dimension;
  const bool pure =
      function.signature == Signature::of_number || function.signature == Signature::to_angle;
  for (const Quantity& argument : arguments) {
    const Dimension& dimension = argument.dimension;
    if (pure && !dimension.dimensionless()) {
      return std::string(function.name) + " takes a pure number, not one in " +
             unit_text(dimension);
    }
    if (function.signature == Signature::of_angle && !dimension.dimensionless() &&
        dimension != angle_dimension) {
      return std::string(function.name) + " takes an angle, not a value in " + unit_text(dimension);
    }
    if (function.signature != Signature::special && !comparable(common, dimension)) {
      return std::string(function.name) + " takes values of one unit, not " +
             describe_dimension(common) + " and " + describe_dimension(dimension);
    }
    if (common.angle == 0) common = comparable(common, dimension) ? dimension : common;
  }
  return "";
}

/// `result` with the unit that follows from the arguments'.
FunctionResult with_unit(const Function& function, std::span<const Quantity> arguments,
                         const Dimension& common, double result) {
  switch (function.signature) {
    case Signature::same:
      return {{result, common}, ""};
    case Signature::to_angle:
    case Signature::same_to_angle:
      return {{result, angle_dimension}, ""};
    case Signature::special:
      return apply_power(function, arguments, result);
    default:
      return {{result, {}}, ""};
  }
}

FunctionResult apply(const Function& function, std::span<const Quantity> arguments) {
  Dimension common;
  if (std::string problem = problem_of(function, arguments, common); !problem.empty())
    return wrong(std::move(problem));
  std::vector<double> numbers;
  for (const Quantity& argument : arguments) numbers.push_back(argument.value);
  const double result = function.apply(numbers);
  if (std::isnan(result)) return wrong(std::string(function.name) + " has no value there");
  return with_unit(function, arguments, common, result);
}

/// The function, with the right number of arguments; null with what is wrong, or with "" where
/// there is none of that name.
const Function* find_function(std::string_view name, std::size_t count, std::string& problem) {
  const auto function = std::ranges::find(functions, name, &Function::name);
  if (function == functions.end()) return nullptr;
  if (count >= function->least && count <= function->most) return &*function;
  const std::string wanted =
      count_of(function->least, "argument") + (function->most == many ? " or more" : "");
  problem = std::string(name) + " takes " + wanted + ", not " + std::to_string(count);
  return nullptr;
}

}  // namespace

FunctionResult raise_quantity(const Quantity& base, const Quantity& exponent) {
  if (!exponent.dimension.dimensionless())
    return wrong("an exponent is a pure number, not one in " + unit_text(exponent.dimension));
  const double result = std::pow(base.value, exponent.value);
  if (base.value == 0. && exponent.value < 0.) return wrong("division by zero");
  if (std::isnan(result))
    return wrong("a negative number to a power that is not whole has no value");
  if (base.dimension.dimensionless()) return {{result, {}}, ""};
  if (exponent.value != std::floor(exponent.value) || std::fabs(exponent.value) > 9.) {
    return wrong("a value in " + unit_text(base.dimension) +
                 " can be raised to whole powers up to 9 only");
  }
  return {{result, power(base.dimension, static_cast<int>(exponent.value))}, ""};
}

std::optional<FunctionResult> call_function(std::string_view name,
                                            std::span<const Quantity> arguments) {
  std::string problem;
  const Function* function = find_function(name, arguments.size(), problem);
  if (function != nullptr) return apply(*function, arguments);
  return problem.empty() ? std::nullopt : std::optional(wrong(std::move(problem)));
}

std::optional<FunctionResult> unit_of_call(std::string_view name,
                                           std::span<const Quantity> arguments) {
  std::string problem;
  const Function* function = find_function(name, arguments.size(), problem);
  if (function == nullptr && problem.empty()) return std::nullopt;
  Dimension common;
  if (function != nullptr) problem = problem_of(*function, arguments, common);
  if (!problem.empty()) return wrong(std::move(problem));
  return with_unit(*function, arguments, common, 0.);
}

NumberFunction number_function(std::string_view name) {
  return std::ranges::find(functions, name, &Function::name)->apply;
}

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Function& function : functions) all.emplace_back(function.name);
    return all;
  }();
  return names;
}

}  // namespace hookpoint::language
