// Who may speak with the server of the window: who knows its token, and calls it by its own name.
// A page of another site can reach 127.0.0.1 too; its browser tells on it by Host and Origin.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hookpoint::view {

/// 128 random bits of the kernel's, in hexadecimal digits.
std::string fresh_token();

/// Compares without telling by its time how much of `given` is right.
bool same_token(std::string_view given, std::string_view token);

/// Target of a request: `/path?token=...`.
struct Target {
  std::string path;
  std::string token;
};
Target parse_target(std::string_view target);

/// Where a server listens.
struct Listening {
  std::string address;  ///< an IP address; of no interface in particular: 0.0.0.0 or ::
  std::uint16_t port = 0;
  std::string machine;  ///< its own name, by which other machines may call it
};

/// Whether a request's Host is this server: the address that it listens at, or `localhost` where
/// that is the machine's own; any address, and the machine's name, where it listens at all. No
/// other name, since any name may be made to lead here (DNS rebinding).
bool names_server(std::string_view host, const Listening& listening);

/// Whether a request's Origin is the page that this server gave to who calls it `host`.
bool same_origin(std::string_view origin, std::string_view host);

}  // namespace hookpoint::view
