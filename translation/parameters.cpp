#include "translation/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "text/display.h"
#include "text/number.h"

namespace hookpoint::translation {
namespace {

/// The numbers of "0.02,1" or "0.02 1". Throws ParameterError.
std::vector<double> numbers_in(const std::string& name, std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (*at == ' ' || *at == ',') {
      ++at;
      continue;
    }
    double number = 0.;
    const auto [next, error] = std::from_chars(at, end, number);
    const bool whole = next == end || *next == ' ' || *next == ',';
    if (error != std::errc{} || !whole || !std::isfinite(number))
      throw ParameterError(
          fmt::format("`{}` of {} is not a number: write {}=NUMBER,NUMBER... in SI units",
                      text::printable(std::string(text)), name, name));
    numbers.push_back(number);
    at = next;
  }
  return numbers;
}

}  // namespace

Parameters::Parameters(std::span<const Parameter> rows) : rows_(rows) {
  for (const Parameter& row : rows) values_[row.name] = row.default_;
}

double Parameters::number(std::string_view name, std::size_t index) const {
  return values_.at(name).numbers.at(index);
}

std::string Parameters::text(std::string_view name) const {
  return numbers_text(values_.at(name).numbers);
}

void Parameters::set(std::string_view name, std::vector<double> numbers) {
  values_.at(name).numbers = std::move(numbers);
}

void Parameters::set_word(std::string_view name, std::string word) {
  values_.at(name).word = std::move(word);
}

void Parameters::read(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::string name = setting.substr(0, equals);
  const auto row = std::ranges::find(rows_, name, &Parameter::name);
  std::vector<std::string_view> names;
  for (const Parameter& known : rows_) names.push_back(known.name);
  if (row == rows_.end())
    throw ParameterError(fmt::format("there is no parameter `{}` here: give {}",
                                     text::printable(name), fmt::join(names, ", ")));
  const std::string text = setting.substr(equals + 1);
  if (!row->choices.empty()) {
    if (std::ranges::find(row->choices, text) == row->choices.end())
      throw ParameterError(fmt::format("{} is {}, not `{}`", name, fmt::join(row->choices, " or "),
                                       text::printable(text)));
    set_word(row->name, text);
    return;
  }
  const std::vector<double> given = numbers_in(name, text);
  std::vector<double> numbers = row->default_.numbers;
  if (given.empty() || given.size() > numbers.size())
    throw ParameterError(fmt::format("{} has {} number{}, not {}", name, numbers.size(),
                                     numbers.size() == 1 ? "" : "s", given.size()));
  std::ranges::copy(given, numbers.begin());
  for (const double number : given)
    if (number < row->least)
      throw ParameterError(fmt::format("{} is {} or more, not {}", name, text::rounded(row->least),
                                       text::rounded(number)));
  set(row->name, numbers);
}

std::string numbers_text(const std::vector<double>& numbers, std::string_view between) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(text::rounded(number, 6));
  return fmt::format("{}", fmt::join(texts, between));
}

}  // namespace hookpoint::translation
