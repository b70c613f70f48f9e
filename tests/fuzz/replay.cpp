// Runs a fuzz target without a fuzzer: on every file of the folders given, then on mutants of them,
// the same ones every time.
//   fuzz_NAME [--mutants N] FILE-OR-FOLDER...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;

Input read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void add(const std::filesystem::path& path, std::vector<std::filesystem::path>& files) {
  if (!std::filesystem::is_directory(path)) return files.push_back(path);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
}

/// One to four changes: a byte, a piece left out, a piece of another input put in.
Input mutant(Input input, const std::vector<Input>& all, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t change = 1 + below(4); change > 0; --change) {
    const auto at = static_cast<std::ptrdiff_t>(below(input.size() + 1));
    const Input& other = all[below(all.size())];
    const std::size_t begin = below(other.size()),
                      length = std::min(below(40), other.size() - begin);
    const auto piece = other.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto rest = static_cast<std::size_t>(input.end() - input.begin() - at);
    switch (below(3)) {
      case 0:
        if (rest > 0) input[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(random());
        break;
      case 1:
        input.erase(input.begin() + at,
                    input.begin() + at + static_cast<std::ptrdiff_t>(std::min(rest, below(40))));
        break;
      default:
        input.insert(input.begin() + at, piece, piece + static_cast<std::ptrdiff_t>(length));
    }
  }
  return input;
}

}  // namespace

int main(int count, char** words) {
  std::size_t mutants = 0;
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < count; ++i) {
    if (std::string(words[i]) == "--mutants" && i + 1 < count) {
      mutants = std::strtoul(words[++i], nullptr, 10);
    } else {
      add(words[i], files);
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<Input> inputs;
  for (const std::filesystem::path& file : files) {
    inputs.push_back(read(file));
    std::printf("%s\n", file.c_str());
    std::fflush(stdout);  // the last one named is the one that crashed
    LLVMFuzzerTestOneInput(inputs.back().data(), inputs.back().size());
  }
  if (inputs.empty()) return 1;
  std::mt19937 random(1);
  for (std::size_t i = 0; i < mutants; ++i) {
    const Input input = mutant(inputs[random() % inputs.size()], inputs, random);
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  std::printf("%zu inputs, %zu mutants\n", inputs.size(), mutants);
  return 0;
}
