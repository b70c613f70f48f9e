// The command's table of options as a manual page and as the completion of a shell: what `--help`
// says, in two more forms.
#pragma once

#include <CLI/App.hpp>
#include <map>
#include <string>
#include <vector>

namespace hookpoint::cli {

/// hookpoint.1, in troff's man macros.
std::string manual_page(const CLI::App& app, const std::string& version);

/// A file that bash sources. `words`: what may follow an option ("--engine": dts, ode, ...), of all
/// commands alike.
std::string bash_completion(const CLI::App& app,
                            const std::map<std::string, std::vector<std::string>>& words);

}  // namespace hookpoint::cli
