// A running program that is an engine, and the protocol's frames (docs/engine_protocol.md).
#pragma once

#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "output/files/child_program.h"
#include "reference/process/definition.h"
#include "simulation/engine_interface/engine.h"
#include "text/json_reader.h"

namespace hookpoint::reference {

/// The program does not follow the protocol, missed its deadline, or has ended. The message says which,
/// with the last line of its standard error.
struct ProgramError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a program says of itself.
struct Hello {
  std::string name, version, precision;
  std::vector<std::string> settings;
  std::vector<simulation::SettingConstant> constants;
  std::vector<simulation::EngineGap> gaps;
  std::map<std::string, std::vector<std::string>> reads{};  ///< EngineDescription::reads
};

class Program {
 public:
  /// Starts it and exchanges the hello messages. Throws ProgramError.
  explicit Program(const ProgramDefinition& definition);

  const Hello& hello() const { return hello_; }
  /// Sends a JSON object and returns the JSON object of the answer. Throws ProgramError.
  text::JsonValue request(const std::string& json);
  /// Sends a `step` message and returns the states, or the reason of a `failed` message. Throws
  /// ProgramError.
  std::variant<std::vector<double>, std::string> step(std::span<const double> inputs);
  /// Lines of its standard error since the last call.
  std::vector<std::string> take_error_lines() { return child_->take_error_lines(); }

 private:
  struct Frame {
    char kind = 0;
    std::string payload;
  };
  void send(char kind, std::string_view payload);
  Frame receive();
  text::JsonValue json_of(const Frame& frame);
  std::string read(std::size_t count);
  /// Ends the program and throws ProgramError.
  [[noreturn]] void fail(const std::string& problem);

  ProgramDefinition definition_;
  std::unique_ptr<output::ChildProgram> child_;
  output::ChildProgram::Clock::time_point until_;
  Hello hello_;
};

/// A program's text for a message: one line of at most 200 bytes, without control characters.
std::string one_line(const std::string& text);

}  // namespace hookpoint::reference
