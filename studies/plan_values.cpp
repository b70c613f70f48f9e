#include "studies/plan_values.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include "output/number.h"

namespace hookpoint::studies {
namespace {

bool part_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// What follows the first number of `text`, blanks skipped; empty when there is no number.
std::string_view after_first_number(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts =
        digit(text[i]) || (text[i] == '.' && i + 1 < text.size() && digit(text[i + 1]));
    if (!starts || (i > 0 && part_of_name(text[i - 1]))) continue;
    double value = 0.;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), value);
    if (error != std::errc{}) return {};
    std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
    return rest;
  }
  return {};
}

}  // namespace

std::string WrittenUnit::with_unit(double value) const {
  return output::shortest(value) + (text.empty() ? "" : " " + text);
}

WrittenUnit written_unit(const language::Field& field) {
  if (field.position.file == nullptr) return {};
  std::string_view text = field.position.file->text;
  text = text.substr(std::min(field.position.offset, text.size()));
  const std::string_view rest = after_first_number(text.substr(0, text.find_first_of(";}")));
  const auto scanned = language::scan_unit(rest);
  if (!scanned) return {};
  return {std::string(rest.substr(0, scanned->length)), scanned->unit};
}

std::string text_of(const language::Field& field) {
  const std::string unit = language::unit_text(field.dimension);
  return output::shortest(field.numbers.at(0)) + (unit.empty() ? "" : " " + unit);
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
