#include "render/page/live/listening.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

constexpr int waiting_at_most = 64;  // connections that nobody has taken yet

struct FreeAddresses {
    void operator()(addrinfo* list) const { ::freeaddrinfo(list); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

Addresses addresses_of(const std::string& host, int port) {
    addrinfo wanted{};
    wanted.ai_family = AF_UNSPEC;
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const int code = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
    if (code != 0)
        throw UserError(
            fmt::format("--watch-host {}: no such host ({}); give a name or an address of this machine", host,
                        ::gai_strerror(code)));
    return Addresses(found);
}

[[noreturn]] void refuse(const std::string& host, int port, int why) {
    if (why == EADDRINUSE)
        throw UserError(fmt::format(
            "port {}: another program has it; give another one, or 0 for any that is free", port));
    if (why == EACCES)
        throw UserError(
            fmt::format("port {}: only the system's own programs may have it; give one above 1023", port));
    throw UserError(fmt::format("--watch-host {}: cannot be listened at: {}; give an address of this machine",
                                host, std::strerror(why)));
}

bool is_any(const sockaddr* address) {
    if (address->sa_family == AF_INET)
        return reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr == htonl(INADDR_ANY);
    return address->sa_family == AF_INET6 &&
           IN6_IS_ADDR_UNSPECIFIED(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr);
}

}  // namespace

Listening::Listening(const std::string& host, int port) {
    const Addresses addresses = addresses_of(host, port);
    if (is_any(addresses->ai_addr))
        throw UserError(fmt::format(
            "--watch-host {}: stands for every address; name the one that the others are to use", host));
    socket_ = ::socket(addresses->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0) refuse(host, port, errno);
    const int yes = 1;
    ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (::bind(socket_, addresses->ai_addr, addresses->ai_addrlen) != 0 ||
        ::listen(socket_, waiting_at_most) != 0) {
        const int why = errno;
        ::close(std::exchange(socket_, -1));
        refuse(host, port, why);
    }
    look();
}

Listening::Listening(int socket) : socket_(socket) {
    int listens = 0;
    socklen_t size = sizeof listens;
    if (::getsockopt(socket, SOL_SOCKET, SO_ACCEPTCONN, &listens, &size) != 0 || listens == 0) {
        socket_ = -1;
        throw UserError(fmt::format("--socket {}: is no socket that listens", socket));
    }
    look();
}

Listening::~Listening() {
    if (socket_ >= 0) ::close(socket_);
}

Listening::Listening(Listening&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), port_(other.port_), loopback_(other.loopback_) {}

int Listening::release() {
    return std::exchange(socket_, -1);
}

void Listening::look() {
    sockaddr_storage bound{};
    socklen_t size = sizeof bound;
    if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&bound), &size) != 0) return;
    if (bound.ss_family == AF_INET) {
        const auto* address = reinterpret_cast<const sockaddr_in*>(&bound);
        port_ = ntohs(address->sin_port);
        loopback_ = (ntohl(address->sin_addr.s_addr) >> 24) == 127;
    } else {
        const auto* address = reinterpret_cast<const sockaddr_in6*>(&bound);
        port_ = ntohs(address->sin6_port);
        loopback_ = IN6_IS_ADDR_LOOPBACK(&address->sin6_addr) != 0;
    }
}

}  // namespace grainreel
