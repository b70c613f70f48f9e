#include "studies/blocks/written_values.h"

#include <charconv>
#include <cmath>

#include "language/tree/print.h"
#include "text/number.h"

namespace hookpoint::studies {
std::string WrittenUnit::with_unit(double value) const {
  return text::shortest(value) + (text.empty() ? "" : " " + text);
}

WrittenUnit written_unit(const language::Field& field) {
  return {field.unit, language::parse_unit(field.unit).value_or(language::Unit{})};
}

std::vector<std::string> word_texts(const language::Field& field) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < field.words.size(); ++i)
    texts.push_back(field.quoted[i] ? language::quote(field.words[i]) : field.words[i]);
  return texts;
}

std::string text_of(const language::Field& field) {
  if (!field.words.empty()) return word_texts(field).front();
  const std::string unit = language::unit_text(field.dimension);
  return text::shortest(field.numbers.at(0)) + (unit.empty() ? "" : " " + unit);
}

double tidy(double value) {
  char digits[32];
  const auto written =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 11);
  double result = value;
  std::from_chars(digits, written.ptr, result);
  return result;
}

double stepped_count(double from, double to, double step) {
  return std::floor((to - from) / step + 1e-6) + 1.;
}

std::vector<double> stepped(double from, double to, double step) {
  std::vector<double> values;
  const double count = stepped_count(from, to, step);
  for (double i = 0.; i < count; ++i) values.push_back(tidy(from + i * step));
  return values;
}

std::vector<double> spaced(double from, double to, int count, bool logarithmic) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const double part = count == 1 ? 0. : static_cast<double>(i) / (count - 1);
    values.push_back(
        tidy(logarithmic ? from * std::pow(to / from, part) : from + part * (to - from)));
  }
  return values;
}

}  // namespace hookpoint::studies
