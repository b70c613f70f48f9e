#include "apps/view/wire/admission.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>

namespace hookpoint::view {
namespace {

/// An address in 16 bytes; one of IPv4 as IPv6 maps it.
using Address = std::array<unsigned char, 16>;

std::optional<Address> parse_address(const std::string& text) {
  Address address{};
  if (inet_pton(AF_INET6, text.c_str(), address.data()) == 1) return address;
  if (inet_pton(AF_INET, text.c_str(), address.data() + 12) != 1) return std::nullopt;
  std::fill_n(address.begin() + 10, 2, static_cast<unsigned char>(0xff));
  return address;
}

bool is_mapped(const Address& address) {
  return std::all_of(address.begin(), address.begin() + 10, [](auto byte) { return byte == 0; }) &&
         address[10] == 0xff && address[11] == 0xff;
}

/// ::, 0.0.0.0
bool is_unspecified(const Address& address) {
  const auto begin = address.begin() + (is_mapped(address) ? 12 : 0);
  return std::all_of(begin, address.end(), [](auto byte) { return byte == 0; });
}

/// ::1, 127.0.0.0/8
bool is_loopback(const Address& address) {
  if (is_mapped(address)) return address[12] == 127;
  return std::equal(address.begin(), address.end(), in6addr_loopback.s6_addr);
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

struct HostAndPort {
  std::string host;  ///< in lower case, without the brackets of IPv6
  bool bracketed = false;
  std::uint16_t port = 80;
};

std::optional<HostAndPort> parse_host(std::string_view text) {
  HostAndPort result;
  std::size_t end = text.find(':');
  if (text.starts_with('[')) {
    end = text.find(']');
    if (end == std::string_view::npos) return std::nullopt;
    result.host = lower_case(text.substr(1, end - 1));
    result.bracketed = true;
    end = end + 1 == text.size() ? std::string_view::npos : end + 1;
  } else {
    result.host = lower_case(text.substr(0, end));
  }
  if (end == std::string_view::npos) return result;
  const std::string_view port = text.substr(end);
  const auto [read, error] =
      std::from_chars(port.data() + 1, port.data() + port.size(), result.port);
  if (port[0] != ':' || error != std::errc() || read != port.data() + port.size())
    return std::nullopt;
  return result;
}

}  // namespace

std::string fresh_token() {
  std::array<unsigned char, 16> bytes{};
  if (getentropy(bytes.data(), bytes.size()) != 0)
    throw std::runtime_error("the system has no random numbers for the window's token");
  std::string token;
  for (const unsigned char byte : bytes) {
    token += "0123456789abcdef"[byte >> 4U];
    token += "0123456789abcdef"[byte & 15U];
  }
  return token;
}

bool same_token(std::string_view given, std::string_view token) {
  if (given.size() != token.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < token.size(); ++i)
    difference = static_cast<unsigned char>(difference | (given[i] ^ token[i]));
  return difference == 0;
}

Target parse_target(std::string_view target) {
  const std::size_t mark = target.find('?');
  Target result{std::string(target.substr(0, mark)), ""};
  if (mark == std::string_view::npos) return result;
  std::string_view query = target.substr(mark + 1);
  constexpr std::string_view name = "token=";
  while (!query.empty()) {
    const std::string_view parameter = query.substr(0, query.find('&'));
    if (parameter.starts_with(name)) {
      result.token = parameter.substr(name.size());
      break;
    }
    query.remove_prefix(std::min(query.size(), parameter.size() + 1));
  }
  return result;
}

bool names_server(std::string_view host, const Listening& listening) {
  const auto named = parse_host(host);
  const auto bound = parse_address(listening.address);
  if (!named || !bound || named->port != listening.port) return false;
  const bool anywhere = is_unspecified(*bound);
  const auto address = parse_address(named->host);
  if (address && named->bracketed == is_mapped(*address)) return false;
  if (address)
    return anywhere || *address == *bound || (is_loopback(*address) && is_loopback(*bound));
  if (named->bracketed) return false;
  if (named->host == "localhost") return anywhere || is_loopback(*bound);
  return !is_loopback(*bound) && !listening.machine.empty() &&
         named->host == lower_case(listening.machine);
}

bool same_origin(std::string_view origin, std::string_view host) {
  return lower_case(origin) == "http://" + lower_case(host);
}

}  // namespace hookpoint::view
