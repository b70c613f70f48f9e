#include "control/plugin/elf_constant.h"

#include <elf.h>

#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>

namespace hookpoint::control {
namespace {

#if defined(__x86_64__)
constexpr Elf64_Half this_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half this_machine = EM_AARCH64;
#elif defined(__riscv)
constexpr Elf64_Half this_machine = EM_RISCV;
#else
#error "plugins: name this processor's ELF machine number here"
#endif
constexpr unsigned char this_order =
    std::endian::native == std::endian::little ? ELFDATA2LSB : ELFDATA2MSB;

/// Reads structures and stretches of bytes; none where the file ends before.
class Bytes {
 public:
  explicit Bytes(std::string_view file) : file_(file) {}

  std::optional<std::string_view> stretch(std::uint64_t offset, std::uint64_t size) const {
    if (offset > file_.size() || size > file_.size() - offset) return std::nullopt;
    return file_.substr(offset, size);
  }
  template <class Structure>
  std::optional<Structure> structure(std::uint64_t offset) const {
    static_assert(std::is_trivially_copyable_v<Structure>);
    const auto bytes = stretch(offset, sizeof(Structure));
    if (!bytes) return std::nullopt;
    Structure value;
    std::memcpy(&value, bytes->data(), sizeof value);
    return value;
  }
  /// Element `index` of a table of structures.
  template <class Structure>
  std::optional<Structure> element(std::uint64_t table, std::uint64_t index) const {
    if (table > file_.size() || index > file_.size() / sizeof(Structure)) return std::nullopt;
    return structure<Structure>(table + index * sizeof(Structure));
  }

 private:
  std::string_view file_;
};

/// "" or why the header is not that of a library that this program could load.
std::string header_problem(const std::optional<Elf64_Ehdr>& header) {
  if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0) return "is no shared library";
  if (header->e_ident[EI_CLASS] != ELFCLASS64 || header->e_ident[EI_DATA] != this_order ||
      header->e_machine != this_machine)
    return "is built for another processor";
  return header->e_type == ET_DYN ? "" : "is no shared library";
}

/// Where the loaded address `address` stands in the file.
std::optional<std::uint64_t> file_offset(const Bytes& bytes, const Elf64_Ehdr& header,
                                         std::uint64_t address) {
  for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
    const auto segment = bytes.element<Elf64_Phdr>(header.e_phoff, i);
    if (!segment) return std::nullopt;
    if (segment->p_type == PT_LOAD && address >= segment->p_vaddr &&
        address - segment->p_vaddr < segment->p_filesz)
      return segment->p_offset + (address - segment->p_vaddr);
  }
  return std::nullopt;
}

/// The dynamic symbol named `wanted`.
std::optional<Elf64_Sym> find_symbol(const Bytes& bytes, const Elf64_Ehdr& header,
                                     std::string_view wanted) {
  for (std::uint64_t i = 0; i < header.e_shnum; ++i) {
    const auto table = bytes.element<Elf64_Shdr>(header.e_shoff, i);
    if (!table) return std::nullopt;
    if (table->sh_type != SHT_DYNSYM) continue;
    const auto names = bytes.element<Elf64_Shdr>(header.e_shoff, table->sh_link);
    const auto text = names ? bytes.stretch(names->sh_offset, names->sh_size) : std::nullopt;
    if (!text) return std::nullopt;
    for (std::uint64_t k = 0; k < table->sh_size / sizeof(Elf64_Sym); ++k) {
      const auto symbol = bytes.element<Elf64_Sym>(table->sh_offset, k);
      if (!symbol) return std::nullopt;
      if (symbol->st_shndx == SHN_UNDEF || symbol->st_name >= text->size()) continue;
      const std::string_view name = text->substr(symbol->st_name);
      if (name.substr(0, name.find('\0')) == wanted) return symbol;
    }
  }
  return std::nullopt;
}

}  // namespace

ElfConstant read_constant(std::string_view file, std::string_view symbol) {
  const Bytes bytes(file);
  const auto header = bytes.structure<Elf64_Ehdr>(0);
  if (std::string problem = header_problem(header); !problem.empty()) return {"", problem};
  const auto found = find_symbol(bytes, *header, symbol);
  const auto offset =
      found ? file_offset(bytes, *header, found->st_value) : std::optional<std::uint64_t>{};
  const auto constant =
      offset ? bytes.stretch(*offset, found->st_size) : std::optional<std::string_view>{};
  if (constant) return {std::string(*constant), ""};
  return {"", "has no symbol `" + std::string(symbol) +
                  "`: it is no plugin, or was not built by hookpoint_add_controller"};
}

}  // namespace hookpoint::control
