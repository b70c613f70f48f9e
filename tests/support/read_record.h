// Records as programs other than ours read them. The scripts in record_readers/ print lines of
// fields separated by tabs:
//   time t...   channel path unit type minimum maximum doc   data v... (of the channel before)
//   variable name   about key "json string"
#pragma once

#include <sys/wait.h>

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
#include "tests/support/folders.h"

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

inline const std::string reader_folder =
    testing::source_folder() + "/tests/support/record_readers/";

inline bool runs(const std::string& command) { return run_reader(command).status == 0; }

/// What is not on this machine, said with what brings it.
inline std::string missing(const std::string& what) {
  return what + " is missing: scripts/setup test installs it";
}

/// "" where python3 has h5py.
inline std::string missing_h5py() {
  return runs("/usr/bin/python3 -c 'import h5py'") ? "" : missing("python3-h5py");
}

/// A program that reads a format.
struct Reader {
  std::string command;  ///< to be followed by the file's path
  std::string missing;  ///< what is not here that scripts/setup installs; "" when all is
  /// What only a network brings, where there is none; "" when it is here.
  std::string out_of_reach;
};

/// node with @mcap/core and @foxglove/schemas, which npm fetches once, beside the build. Looked for
/// once a program.
inline const Reader& mcap_reader() {
  static const Reader reader = [] {
    const std::filesystem::path folder = testing::build_folder() + "/mcap_reader";
    std::filesystem::create_directories(folder);
    for (const char* file :
         {"package.json", "package-lock.json", "open.mjs", "read.mjs", "read_scene.mjs"})
      std::filesystem::copy_file(reader_folder + "mcap/" + file, folder / file,
                                 std::filesystem::copy_options::overwrite_existing);
    Reader found{"node '" + folder.string() + "/read.mjs' ", "", ""};
    const Reading packages = run_reader(
        "'" + testing::source_folder() + "/scripts/npm_packages' '" + folder.string() + "'", true);
    if (packages.status == 0) return found;
    const std::string problem = "@mcap/core and @foxglove/schemas: " + packages.output;
    const bool is_out_of_reach =
        WIFEXITED(packages.status) && WEXITSTATUS(packages.status) == 3 &&
        packages.output.find("npm reaches no registry") != std::string::npos;
    (is_out_of_reach ? found.out_of_reach : found.missing) = problem;
    return found;
  }();
  return reader;
}

/// The reader of an MCAP file's scene, which prints the lines that read_scene.mjs tells.
inline Reader scene_reader(bool cut_off = false) {
  Reader reader = mcap_reader();
  const std::string script = "read.mjs' ";
  if (const std::size_t at = reader.command.find(script); at != std::string::npos)
    reader.command.replace(at, script.size(), "read_scene.mjs' ");
  reader.command += cut_off ? "stream " : "indexed ";
  return reader;
}

/// The reader of a format; `cut_off` for a file that has no end.
inline Reader reader_of(const std::string& format, bool cut_off = false) {
  const std::string python = "/usr/bin/python3 ";
  if (format == "hdf5" || format == "mat73")
    return {python + reader_folder + "read_hdf5.py " + format + " ", missing_h5py(), ""};
  if (format == "mat5")
    return {"octave-cli -qf " + reader_folder + "read_mat5.m ",
            runs("octave-cli --version") ? "" : missing("octave"), ""};
  if (format == "mcap") {
    Reader reader = mcap_reader();
    reader.command += cut_off ? "stream " : "indexed ";
    return reader;
  }
  return {python + reader_folder + "read_" + format + ".py ",
          runs(python + "--version") ? "" : missing("python3"), ""};
}

}  // namespace hookpoint::testing
