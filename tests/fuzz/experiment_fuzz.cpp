// Any bytes as a .hook file: parsed, laid out, evaluated with the whole schema, loaded. Beside not
// crashing, the parts must agree: a tree unless there are errors, a layout that stays, a print that
// reads back, an experiment unless there are errors.
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "apps/view/widgets/schema.h"
#include "language/document/document.h"
#include "reference/engines.h"
#include "simulation/scene/load.h"
#include "simulation/scene/schema.h"
#include "studies/blocks/schema.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

using language::Diagnostics;

const language::Schema& whole_schema() {
  static const language::Schema schema = [] {
    language::Schema classes;
    simulation::add_experiment_classes(classes, reference::peer_choices());
    view::add_display_classes(classes);
    studies::add_study_classes(classes);
    return classes;
  }();
  return schema;
}

/// Evaluates texts with one Library, which keeps what it has read.
class Texts {
 public:
  /// Between two inputs: the Library is renewed now and then, and no tree outlives it.
  void begin() {
    if (inputs_++ % 300 == 0) library_ = std::make_unique<language::Library>(whole_schema(), path_);
  }
  std::unique_ptr<language::Object> evaluate(const std::string& text, Diagnostics& diagnostics) {
    ++count_;
    const std::filesystem::path file = folder_.path() / (std::to_string(count_) + ".hook");
    std::ofstream(file, std::ios::binary) << text;
    auto root = library_->evaluate(file, {}, diagnostics);
    std::filesystem::remove(file);
    return root;
  }
  const std::vector<std::filesystem::path>& path() const { return path_; }

 private:
  fuzz::Folder folder_;
  std::vector<std::filesystem::path> path_{std::filesystem::path(testing::source_folder()) /
                                           "configs"};
  std::unique_ptr<language::Library> library_;
  std::size_t count_ = 0, inputs_ = 0;
};

void run(const std::string& text) {
  static Texts texts;
  texts.begin();
  Diagnostics of_layout, of_text, of_print;
  const std::string laid_out = language::format("text.hook", text, of_layout);
  if (!of_layout.has_errors()) {
    Diagnostics again;
    fuzz::require(language::format("text.hook", laid_out, again) == laid_out && !again.has_errors(),
                  "the layout does not stay");
  }
  const auto root = texts.evaluate(text, of_text);
  fuzz::require((root == nullptr) == of_text.has_errors(), "a tree and errors");
  if (root == nullptr) return;
  const std::string printed = language::print(*root);
  const auto again = texts.evaluate(printed, of_print);
  fuzz::require(again != nullptr, "the print does not read back");
  fuzz::require(language::print(*again) == printed, "the print changes");
  Diagnostics of_load;
  const auto experiment = simulation::load_experiment(*root, of_load, texts.path());
  fuzz::require(experiment.has_value() != of_load.has_errors(), "an experiment and errors");
}

}  // namespace
}  // namespace hookpoint

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hookpoint::run({reinterpret_cast<const char*>(data), size});
  return 0;
}
