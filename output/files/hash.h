// Names of contents: XXH3, 128 bits, as 32 hexadecimal digits.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace hookpoint::output {

/// Of texts one after the other, each with its length: no two lists of texts run together.
class Hash {
 public:
  Hash();
  ~Hash();
  Hash(const Hash&) = delete;
  Hash& operator=(const Hash&) = delete;

  Hash& add(std::string_view text);
  /// The bytes of a file, without their length: of one file alone it is hash_of_file's. Throws
  /// FileError.
  Hash& add_file(const std::filesystem::path& file);
  /// 32 hexadecimal digits, of all so far.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Of the bytes of a file. Throws FileError.
std::string hash_of_file(const std::filesystem::path& file);

/// Of the bytes of this program, or of the library that this code stands in: a program that was
/// built again from other sources is another one, whatever its version says. Read once.
const std::string& hash_of_program();

}  // namespace hookpoint::output
