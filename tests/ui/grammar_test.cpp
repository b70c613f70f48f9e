// The grammar for editors is that of this program, and colours files as the lexer and the parser
// read them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "language/syntax/syntax.h"
#include "language/syntax/token.h"
#include "tests/support/command.h"
#include "tests/support/derived_file.h"
#include "tests/support/folders.h"

namespace hookpoint {
namespace {

using namespace language;
using testing::Workplace;

const std::filesystem::path source = testing::source_folder();

TEST(Grammar, IsThatOfThisProgram) {
  const Workplace work;
  const auto described = work.hookpoint("describe --textmate");
  EXPECT_EQ(described.status, 0) << described.err;
  EXPECT_EQ(
      testing::stale("grammar", source / "language/editors/vscode/syntaxes/hook.tmLanguage.json",
                     described.out),
      "");
}

/// The class of each token of a file, by what the parser made of it.
class Truth {
 public:
  explicit Truth(const std::string& text) : source_(source_file("", text)) {
    parse(file_);
    mark(file_.syntax.top);
    for (const Argument& argument : file_.syntax.arguments) mark(argument.name, "field");
  }
  bool is_good() const { return !file_.report.has_errors(); }
  /// `offset length class`, a line a token.
  std::string table() {
    Report report;
    std::string lines;
    for (const Token& token : tokenize(file_.source, true, report)) {
      if (token.length == 0) continue;
      lines += std::to_string(token.offset) + ' ' + std::to_string(token.length) + ' ' +
               class_of(token) + '\n';
    }
    return lines;
  }

 private:
  void mark(const Span& span, const char* kind) {
    for (std::size_t i = 0; i < span.length; ++i) kinds_[span.offset + i] = kind;
  }
  void mark(const Range& items) {
    for (std::uint32_t i = items.begin; i < items.end; ++i) {
      const Item& item = file_.syntax.items[i];
      const bool object = item.kind == ItemKind::object;
      const bool assignment = item.kind == ItemKind::assignment;
      if (object || assignment) mark(item.place, object ? "type" : "field");
      const bool variable =
          item.kind == ItemKind::let || (item.kind == ItemKind::param && item.value.size() > 0);
      if (object || variable) mark(item.name, object ? "name" : "field");
      mark(item.items);
    }
  }
  std::string class_of(const Token& token) const {
    if (token.kind == TokenKind::comment) return "comment";
    if (token.kind == TokenKind::text) return "string";
    if (token.kind == TokenKind::number) return "number";
    const std::string_view text = text_of(file_.source, token);
    if (std::ranges::find(reserved_words, text) != std::end(reserved_words)) return "keyword";
    if (text == "FROM" || text == "TO" || text == "in") return "keyword";
    const auto marked = kinds_.find(token.offset);
    return marked == kinds_.end() ? "other" : marked->second;
  }

  SourceFile source_;
  ParsedFile file_{source_};
  std::map<std::size_t, std::string> kinds_;
};

class Colours : public ::testing::Test {
 protected:
  void add(const std::string& path) {
    Truth truth(work_.read(path));
    ASSERT_TRUE(truth.is_good()) << path;
    const std::string table = work_.file(std::to_string(count_++) + ".table", truth.table());
    list_ += path + '\t' + table + '\n';
  }
  /// What the grammar colours otherwise.
  std::string disagreements() {
    const std::string list = work_.file("list", list_);
    const std::string command =
        "python3 '" + (source / "tests/support/grammar/compare.py").string() + "' '" +
        (source / "language/editors/vscode/syntaxes/hook.tmLanguage.json").string() + "' '" + list +
        "' > '" + (work_.folder() / "said").string() + "' 2>&1";
    const int status = std::system(command.c_str());
    return status == 0 ? "" : work_.read("said");
  }

  Workplace work_;
  std::string list_;
  int count_ = 0;
};

TEST_F(Colours, OfEveryConfigAreThoseOfTheLexer) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "configs")) {
    if (entry.path().extension() == ".hook") add(entry.path());
  }
  EXPECT_GT(count_, 20);
  EXPECT_EQ(disagreements(), "");
}

TEST_F(Colours, OfWhatIsRareAreThoseOfTheLexerToo) {
  add(work_.file(
      "rare.hook",
      "/* a comment // over\n lines */ World w { gravity = 9.81; // 3 kg \"text\"\n"
      "Let a = \"say \\\"3 kg\\\" // no comment\"; Let b = .5e-3 kN / m ^ -1; Let kg = 2/3;\n"
      "For i in 0..5 { Robot r[2*i+1] { Base.fixed Shape.Cube dimensions=1,1 m,.3; } }\n"
      "Let c = a == 3 ? 12/b : sin(90 deg); Let d = 5 %; Let e1 = 1e5 N.m/rad; }\n"
      "Valuator.Slider zoom Wire TO cam.zoom; Wire FROM w.time TO g.input; Gain g;\n"
      "Controller.PD pd1 { goal = true ? 2 mm : 3.; }\n"));
  EXPECT_EQ(disagreements(), "");
}

}  // namespace
}  // namespace hookpoint
