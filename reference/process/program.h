// A running program that is an engine, and the protocol's frames (docs/engine_protocol.md).
#pragma once

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

/// A program does not speak the protocol, is late, or has ended; the message says which, with its
/// last words.
struct ProgramError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a program says of itself.
struct Hello {
  std::string name, version, precision;
  std::vector<std::string> settings;
  std::vector<simulation::SettingConstant> constants;
  std::vector<simulation::EngineGap> gaps;
};

class Program {
 public:
  /// Starts it and says hello. Throws ProgramError.
  explicit Program(const ProgramDefinition& definition);

  const Hello& hello() const { return hello_; }
  /// Hands it a JSON object, and takes one. Throws ProgramError.
  text::JsonValue ask(const std::string& json);
  /// Hands it a step, and takes its states, or what it says of a failure. Throws ProgramError.
  std::variant<std::vector<double>, std::string> step(std::span<const double> inputs);
  /// What it has written to standard error since the last call, line by line.
  std::vector<std::string> words() { return child_->take_error_lines(); }

 private:
  struct Frame {
    char kind = 0;
    std::string payload;
  };
  void send(char kind, std::string_view payload);
  Frame receive();
  text::JsonValue json_of(const Frame& frame);
  std::string hear(std::size_t count);
  /// Throws ProgramError of `trouble`.
  [[noreturn]] void give_up(const std::string& trouble);

  ProgramDefinition definition_;
  std::unique_ptr<output::ChildProgram> child_;
  output::ChildProgram::Clock::time_point until_;
  Hello hello_;
};

/// A line of text from a program, for a message: without control characters, at most 200 bytes.
std::string one_line(const std::string& text);

}  // namespace hookpoint::reference
