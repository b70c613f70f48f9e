// Records as programs other than ours read them. The scripts in record_readers/ print lines of
// fields separated by tabs:
//   time t...   channel path unit type minimum maximum doc   data v... (of the channel before)
//   variable name   about key "json string"
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "output/records/recorder.h"

namespace hookpoint::testing {

struct ReadRecord {
  std::vector<double> time;
  std::vector<output::Channel> channels;
  std::vector<std::vector<double>> data;
  std::vector<std::string> variables;
  std::map<std::string, std::string> about;
};

inline std::vector<std::string> split_fields(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  for (std::size_t tab; (tab = line.find('\t', begin)) != std::string::npos; begin = tab + 1)
    fields.push_back(line.substr(begin, tab - begin));
  fields.push_back(line.substr(begin));
  return fields;
}

/// The values after the first field. A script that has none may leave one empty field.
inline std::vector<double> numbers_of(const std::vector<std::string>& fields) {
  std::vector<double> numbers;
  for (std::size_t i = 1; i < fields.size(); ++i)
    if (!fields[i].empty()) numbers.push_back(std::strtod(fields[i].c_str(), nullptr));
  return numbers;
}

inline ReadRecord parse_record(const std::string& text) {
  ReadRecord record;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> fields = split_fields(line);
    if (fields[0] == "time") {
      record.time = numbers_of(fields);
    } else if (fields[0] == "channel" && fields.size() == 7) {
      record.channels.push_back({fields[1], fields[2], fields[3],
                                 std::strtod(fields[4].c_str(), nullptr),
                                 std::strtod(fields[5].c_str(), nullptr), fields[6]});
    } else if (fields[0] == "data") {
      record.data.push_back(numbers_of(fields));
    } else if (fields[0] == "variable") {
      record.variables.push_back(fields[1]);
    } else if (fields[0] == "about" && fields.size() == 3) {
      record.about[fields[1]] = fields[2];
    }
  }
  return record;
}

struct Reading {
  int status = -1;
  std::string output;  ///< what the reader printed; its complaints when it failed
};

inline Reading run_reader(const std::string& command, bool with_complaints = false) {
  Reading reading;
  std::FILE* pipe = ::popen((command + (with_complaints ? " 2>&1" : " 2>/dev/null")).c_str(), "r");
  std::array<char, 65536> buffer;
  for (std::size_t count; (count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    reading.output.append(buffer.data(), count);
  reading.status = ::pclose(pipe);
  return reading;
}

inline const std::string reader_folder = HOOKPOINT_SOURCE_DIR "/tests/support/record_readers/";

inline bool runs(const std::string& command) { return run_reader(command).status == 0; }

/// The folder in which @mcap/core is installed, "" when it cannot be.
inline std::string mcap_reader() {
  const std::filesystem::path folder = HOOKPOINT_BINARY_DIR "/mcap_reader";
  std::filesystem::create_directories(folder);
  for (const char* file : {"package.json", "package-lock.json", "read.mjs"})
    std::filesystem::copy_file(reader_folder + "mcap/" + file, folder / file,
                               std::filesystem::copy_options::overwrite_existing);
  if (!std::filesystem::exists(folder / "node_modules/@mcap/core") &&
      !runs("cd '" + folder.string() + "' && npm ci --prefer-offline --no-audit --no-fund"))
    return "";
  return folder.string();
}

/// The command that reads a file of `format`, to be followed by its path; `cut_off` for a file that
/// has no end. Nothing when the reader is not on this machine; `reader` is its name.
struct Reader {
  std::string name;
  std::string command;
  bool here = false;
};

inline Reader reader_of(const std::string& format, bool cut_off = false) {
  const std::string python = "/usr/bin/python3 ";
  if (format == "hdf5" || format == "mat73")
    return {"python3-h5py", python + reader_folder + "read_hdf5.py " + format + " ",
            runs(python + "-c 'import h5py'")};
  if (format == "mat5")
    return {"octave", "octave-cli -qf " + reader_folder + "read_mat5.m ",
            runs("octave-cli --version")};
  if (format == "mcap") {
    const std::string folder = runs("node --version") ? mcap_reader() : "";
    return {"@mcap/core (node, npm)",
            "node " + folder + "/read.mjs " + (cut_off ? "stream " : "indexed "), !folder.empty()};
  }
  return {"python3", python + reader_folder + "read_" + format + ".py ",
          runs(python + "--version")};
}

}  // namespace hookpoint::testing
