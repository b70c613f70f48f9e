// Files of the language for a test: written to a folder of its own, evaluated with the tests'
// schema.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "language/document/document.h"
#include "tests/support/language_schema.h"
#include "tests/support/text.h"

namespace hookpoint::language::testing {

using hookpoint::testing::read_file;

/// A temporary folder that ends with the test.
class Folder {
 public:
  Folder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("hookpoint-") + test->test_suite_name() + "-" + test->name() + "-" +
             std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A tree with the Library that it points into.
struct Evaluated {
  std::unique_ptr<Schema> schema = std::make_unique<Schema>(make_schema());
  std::unique_ptr<Library> library;
  std::unique_ptr<Object> root;
  Diagnostics diagnostics;

  std::string errors() const {
    std::ostringstream out;
    diagnostics.print(out, false);
    return out.str();
  }
  /// The messages alone, one line each.
  std::string messages() const {
    std::string lines;
    for (const Diagnostic& diagnostic : diagnostics.all()) lines += diagnostic.message + "\n";
    return lines;
  }
  const Object& at(const std::string& trail) {
    const std::optional<Reference> found = resolve(*root, trail, false, diagnostics);
    if (!found) throw std::runtime_error("no object " + trail);
    return *found->object;
  }
};

inline Evaluated evaluate_file(const std::filesystem::path& file,
                               const EvaluateOptions& options = {},
                               std::vector<std::filesystem::path> search_path = {}) {
  Evaluated result;
  result.library = std::make_unique<Library>(*result.schema, std::move(search_path));
  result.root = result.library->evaluate(file, options, result.diagnostics);
  return result;
}

inline Evaluated evaluate_text(const std::string& text, const EvaluateOptions& options = {}) {
  const Folder folder;
  return evaluate_file(folder.write("test.hook", text), options);
}

inline std::string format_text(const std::string& text) {
  Diagnostics diagnostics;
  return format("test.hook", text, diagnostics);
}

}  // namespace hookpoint::language::testing
