#include "render/page/live/visitors.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

constexpr std::size_t most_visitors = 256;

// 128 bits that nobody guesses, as hex digits.
std::string secret() {
    std::array<std::uint8_t, 16> bytes;
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw RunError("watch: the system has no random numbers for a key");
    std::string text;
    for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

// Takes as long whatever the texts are.
bool same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i) differing |= static_cast<unsigned char>(a[i] ^ b[i]);
    return differing == 0;
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return result;
}

// An address of IPv6 stands in brackets.
std::string in_address(const std::string& host) {
    return host.find(':') == std::string::npos || host.front() == '[' ? host : "[" + host + "]";
}

}  // namespace

Visitors::Visitors(std::string host, int port, bool keyed)
    : host_(in_address(lower(host))), port_(port), keyed_(keyed) {
    if (keyed_) key_ = secret();
}

bool Visitors::knows_host(std::string_view header) const {
    const std::string asked = lower(header);
    const auto is = [&](const std::string& name) {
        return asked == fmt::format("{}:{}", name, port_) || (port_ == 80 && asked == name);
    };
    return is(host_) || (!keyed_ && (is("localhost") || is("127.0.0.1")));
}

std::string Visitors::address() const {
    const std::string plain = fmt::format("http://{}:{}/", host_, port_);
    return keyed_ ? plain + "?key=" + key_ : plain;
}

std::optional<std::string> Visitors::admit(std::string_view key) {
    if (!keyed_ || !same(key, key_)) return std::nullopt;
    key_ = secret();
    tokens_.push_back(secret());
    if (tokens_.size() > most_visitors) tokens_.pop_front();
    return tokens_.back();
}

bool Visitors::admitted(std::string_view cookies) const {
    if (!keyed_) return true;
    while (!cookies.empty()) {
        const std::size_t end = std::min(cookies.find(';'), cookies.size());
        std::string_view one = cookies.substr(0, end);
        cookies.remove_prefix(std::min(cookies.size(), end + 1));
        while (!one.empty() && one.front() == ' ') one.remove_prefix(1);
        const std::size_t equals = one.find('=');
        if (equals == std::string_view::npos || one.substr(0, equals) != kCookie) continue;
        const std::string_view token = one.substr(equals + 1);
        if (std::any_of(tokens_.begin(), tokens_.end(),
                        [&](const std::string& known) { return same(known, token); }))
            return true;
    }
    return false;
}

}  // namespace grainreel
