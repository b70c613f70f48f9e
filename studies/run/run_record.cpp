#include "studies/run/run_record.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <utility>

#include "output/files/hash.h"
#include "text/number.h"

namespace hookpoint::studies {
namespace {

constexpr std::string_view end_mark = "\nend ";
constexpr std::string_view no_value = "-";
constexpr std::size_t hash_digits = 32;
constexpr std::size_t double_bytes = sizeof(double);

std::string on_one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

void append_optional(std::string& text, const std::optional<double>& value) {
  text += ' ';
  if (value)
    text::append_shortest(text, *value);
  else
    text += no_value;
}

/// The next word of a line, which is taken away from its front.
std::string_view take_word(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

template <class Number>
bool read_number(std::string_view word, Number& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size();
}

bool read_optional(std::string_view word, std::optional<double>& value) {
  value.reset();
  return word == no_value || read_number(word, value.emplace());
}

bool read_line(std::string_view kind, std::string_view rest, RunRecord& record) {
  if (kind == "status") {
    record.status = rest;
  } else if (kind == "notice") {
    record.notices.emplace_back(rest);
  } else if (kind == "regime") {
    int regime = 0;
    if (!read_number(rest, regime)) return false;
    record.regime = static_cast<Regime>(regime);
  } else if (kind == "value") {
    KeptValue& value = record.values[std::string(take_word(rest))];
    const std::string_view measured = take_word(rest);
    return read_optional(measured, value.measured) && read_optional(rest, value.predicted);
  } else if (kind == "no_form") {
    const std::string_view name = take_word(rest);
    record.values[std::string(name)].no_form = rest;
  } else if (kind == "curve") {
    const std::string_view size = take_word(rest);
    return read_number(size, record.curves[std::string(rest)].size);
  } else {
    return false;
  }
  return true;
}

}  // namespace

void RunRecord::merge(RunRecord other) {
  values.merge(other.values);
  curves.merge(other.curves);
}

std::string numbers_text(const RunRecord& record) {
  std::string text = "status " + on_one_line(record.status);
  for (const std::string& notice : record.notices) text += "\nnotice " + on_one_line(notice);
  text += "\nregime " + std::to_string(static_cast<int>(record.regime));
  for (const auto& [name, value] : record.values) {
    text += "\nvalue " + name;
    append_optional(text, value.measured);
    append_optional(text, value.predicted);
    if (!value.no_form.empty()) text += "\nno_form " + name + ' ' + on_one_line(value.no_form);
  }
  for (const auto& [name, curve] : record.curves)
    text += "\ncurve " + std::to_string(curve.size) + ' ' + name;
  const std::string hash = output::Hash().add(text).text();
  return text.append(end_mark).append(hash).append("\n");
}

std::optional<RunRecord> read_numbers(std::string_view text) {
  const std::size_t end = text.rfind(end_mark);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view hash = text.substr(end + end_mark.size());
  text = text.substr(0, end);
  if (hash != output::Hash().add(text).text() + "\n") return std::nullopt;
  RunRecord record;
  while (!text.empty()) {
    const std::size_t line_end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, line_end);
    text.remove_prefix(std::min(line_end + 1, text.size()));
    const std::string_view kind = take_word(line);
    if (!read_line(kind, line, record)) return std::nullopt;
  }
  return record;
}

std::string samples_bytes(const RunRecord& record) {
  std::string bytes;
  for (const auto& [name, curve] : record.curves) {
    for (const double sample : curve.samples) {
      const auto bits = std::bit_cast<std::uint64_t>(sample);
      for (std::size_t i = 0; i < double_bytes; ++i) bytes += static_cast<char>(bits >> (8 * i));
    }
  }
  return bytes.append(output::Hash().add(bytes).text());
}

bool read_samples(std::string_view bytes, RunRecord& record) {
  if (bytes.size() < hash_digits) return false;
  const std::string_view hash = bytes.substr(bytes.size() - hash_digits);
  bytes.remove_suffix(hash_digits);
  if (hash != output::Hash().add(bytes).text()) return false;
  for (auto& [name, curve] : record.curves) {
    if (curve.size > bytes.size() / double_bytes) return false;
    curve.samples.resize(curve.size);
    for (double& sample : curve.samples) {
      std::uint64_t bits = 0;
      for (std::size_t i = 0; i < double_bytes; ++i)
        bits |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
      sample = std::bit_cast<double>(bits);
      bytes.remove_prefix(double_bytes);
    }
  }
  return bytes.empty();
}

}  // namespace hookpoint::studies
