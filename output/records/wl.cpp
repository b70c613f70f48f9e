// Mathematica: one association in a text file that Get reads. The closing brackets are written
// after every row, over those of the row before, so that the file is a whole expression at any
// time.
#include <array>
#include <charconv>
#include <cmath>

#include "output/records/formats.h"
#include "output/records/wolfram_text.h"

namespace hookpoint::output {
namespace {

enum class Kind { real, integer, boolean };

Kind kind_of(const Channel& channel) {
  if (channel.type == "bool") return Kind::boolean;
  return channel.type == "int" ? Kind::integer : Kind::real;
}

void append_value(std::string& text, Kind kind, double value) {
  // Beyond 2^63 there is no whole number to print, and no count gets there.
  const bool whole = std::abs(value) < 9.2e18 && value == std::floor(value);
  if (kind == Kind::boolean && (value == 0. || value == 1.)) {
    text += value == 1. ? "True" : "False";
  } else if (kind == Kind::integer && whole) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                   static_cast<std::int64_t>(value));
    text.append(buffer.data(), end.ptr);
  } else {
    append_wolfram_real(text, value);
  }
}

void append_real_rule(std::string& text, std::string_view key, double value) {
  text.append(",\"").append(key).append("\"->");
  append_wolfram_real(text, value);
}

std::string head(const RecordHeader& header) {
  std::string text = "<|\"name\"->" + wolfram_string(header.name);
  append_real_rule(text, "period", header.period);
  text += ",\n\"annotations\"-><|";
  for (const auto& [key, value] : header.annotations) {
    if (text.back() != '|') text += ',';
    text += wolfram_string(key) + "->" + wolfram_string(value);
  }
  text += "|>,\n\"experiment\"->" + wolfram_string(header.experiment);
  text +=
      ",\n\"columns\"->{\n<|\"path\"->\"time\",\"unit\"->\"s\",\"type\"->\"double\",\"minimum\"->0."
      ","
      "\"maximum\"->Infinity,\"doc\"->\"simulated time\"|>";
  for (const Channel& channel : header.channels) {
    text += ",\n<|\"path\"->" + wolfram_string(channel.path);
    text += ",\"unit\"->" + wolfram_string(channel.unit);
    text += ",\"type\"->" + wolfram_string(channel.type);
    append_real_rule(text, "minimum", channel.minimum);
    append_real_rule(text, "maximum", channel.maximum);
    text += ",\"doc\"->" + wolfram_string(channel.doc) + "|>";
  }
  return text + "},\n\"rows\"->{";
}

constexpr std::string_view open_tail = "},\n\"complete\"->False|>\n";
constexpr std::string_view complete_tail = "},\n\"complete\"->True|>\n";
/// Bytes of a value with its comma: ",-1.2345678901234567`*^-308" at most.
constexpr std::size_t longest_value = 28;

class WolframRecord final : public RecordWriter {
 public:
  WolframRecord(const std::filesystem::path& path, const RecordHeader& header)
      : RecordWriter(header.channels.size()), file_(path) {
    for (const Channel& channel : header.channels) kinds_.push_back(kind_of(channel));
    file_.write(head(header));
    end_ = file_.size();
    file_.write(open_tail);
    line_.reserve((kinds_.size() + 1) * longest_value + 4 + open_tail.size());
  }

 private:
  void append(double time, std::span<const double> values) override {
    line_ = rows_ == 0 ? "\n{" : ",\n{";
    append_wolfram_real(line_, time);
    for (std::size_t i = 0; i < values.size(); ++i) {
      line_ += ',';
      append_value(line_, kinds_[i], values[i]);
    }
    line_ += '}';
    const std::uint64_t row_bytes = line_.size();
    line_ += open_tail;
    file_.write_at(end_, line_);
    end_ += row_bytes;
    ++rows_;
  }
  void finish() override {
    file_.write_at(end_, complete_tail);
    file_.complete();
  }
  Kept keep() override {
    // The tail stood here before; should even these bytes be gone, the rows are still whole lines.
    try {
      file_.write_at(end_, open_tail);
    } catch (const FileError&) {
      return {file_.partial(), rows_};
    }
    return {file_.partial(), rows_};
  }

  PartialFile file_;
  std::vector<Kind> kinds_;
  std::string line_;
  std::uint64_t end_ = 0;  ///< of the last row: here the tail begins
  std::int64_t rows_ = 0;
};

}  // namespace

std::unique_ptr<RecordWriter> make_wl_record(const std::filesystem::path& path,
                                             const RecordHeader& header) {
  return std::make_unique<WolframRecord>(path, header);
}

}  // namespace hookpoint::output
