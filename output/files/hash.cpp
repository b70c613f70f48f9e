#include "output/files/hash.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <vector>

#include "output/files/file.h"

namespace hookpoint::output {

struct Hash::State {
  State() : xxh3(XXH3_createState()) { XXH3_128bits_reset(xxh3); }
  ~State() { XXH3_freeState(xxh3); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void update(const void* bytes, std::size_t count) { XXH3_128bits_update(xxh3, bytes, count); }
  std::string digits() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(xxh3));
    constexpr char hexadecimal[] = "0123456789abcdef";
    std::string text;
    for (const unsigned char byte : canonical.digest) {
      text += hexadecimal[byte >> 4];
      text += hexadecimal[byte & 15];
    }
    return text;
  }

  XXH3_state_t* xxh3;
};

Hash::Hash() : state_(std::make_unique<State>()) {}
Hash::~Hash() = default;

Hash& Hash::add(std::string_view text) {
  std::array<unsigned char, 8> length;
  for (std::size_t i = 0; i < length.size(); ++i)
    length[i] = static_cast<unsigned char>(std::uint64_t{text.size()} >> (8 * i));
  state_->update(length.data(), length.size());
  state_->update(text.data(), text.size());
  return *this;
}

Hash& Hash::add_file(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail_file("open", file);
  std::vector<char> block(1 << 18);
  ssize_t count = 0;
  while ((count = ::read(descriptor, block.data(), block.size())) != 0) {
    if (count > 0) {
      state_->update(block.data(), static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      const int reason = errno;
      ::close(descriptor);
      errno = reason;
      fail_file("read", file);
    }
  }
  ::close(descriptor);
  return *this;
}

std::string Hash::text() const { return state_->digits(); }

namespace {

/// The program's own file, or that of the library with this code in it.
std::filesystem::path own_file() {
  Dl_info info{};
  void* map = nullptr;
  const auto here = reinterpret_cast<const void*>(&hash_of_program);
  if (dladdr1(here, &info, &map, RTLD_DL_LINKMAP) == 0) return "/proc/self/exe";
  const std::string name = static_cast<const link_map*>(map)->l_name;
  return name.empty() ? "/proc/self/exe" : name;
}

}  // namespace

std::string hash_of_file(const std::filesystem::path& file) { return Hash().add_file(file).text(); }

const std::string& hash_of_program() {
  static const std::string hash = hash_of_file(own_file());
  return hash;
}

}  // namespace hookpoint::output
