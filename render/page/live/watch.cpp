#include "render/page/live/watch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <thread>

#include "engine/base/error.hpp"
#include "render/page/live/server.hpp"

namespace grainreel {

namespace {

using Steady = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr auto look_interval = std::chrono::milliseconds(100);
constexpr Seconds refresh_interval{0.5};
constexpr double refresh_share = 0.1;  // largest share of the time that reading the run may take
constexpr Seconds visitor_stays{5};    // time after the last request of a visitor until he counts as gone
// After the end of the run the server stops when no request has come for the time `farewell`, since then all
// visitors know of the end. It stops after the time `longest_farewell` in any case.
constexpr Seconds farewell{3};
constexpr Seconds longest_farewell{15};
constexpr int priority = 10;  // nice value, up to 19: programs that compute go first

constexpr const char* page_type = "text/html; charset=utf-8";

WatchAnswer part(const LiveSnapshot::Bytes& bytes, const char* type) {
    if (!bytes) return text_answer(404, "The run has none yet.\n");
    WatchAnswer answer;
    answer.body = bytes;
    answer.type = type;
    return answer;
}

class Watch {
  public:
    Watch(WatchTask& request, const Planner& planner, Listener& listener)
        : folder_(request.run),
          until_(request.until),
          listener_(listener),
          run_(request.run, planner),
          visitors_(request.host, request.listening.port(), !request.listening.is_loopback()) {}

    int serve(Listening listening) {
        run_.refresh();
        tell_address();
        const WatchServer server(std::move(listening), [this](const WatchRequest& r) { return answer(r); });
        while (true) {
            std::this_thread::sleep_for(look_interval);
            if (const int signal = listener_.stop_signal(); signal != 0) return 128 + signal;
            if (new_key_.exchange(false)) tell_address();
            refresh_when_due();
            if (run_.is_gone() && since(gone_at_) > farewell) {
                listener_.error(fmt::format("{}: the run's folder has gone", folder_.string()));
                return 1;
            }
            if (is_to_end()) return 0;
        }
    }

  private:
    static Seconds since(Steady::time_point time) { return Steady::now() - time; }

    void refresh_when_due() {
        const bool watched =
            Seconds(Steady::now().time_since_epoch()) - last_question_.load() < visitor_stays;
        const Seconds interval = std::max(refresh_interval, refresh_took_ / refresh_share);
        if (!watched || since(refreshed_) < interval) return;
        refresh();
    }

    void refresh() {
        const auto begin = Steady::now();
        const bool was_gone = run_.is_gone();
        run_.refresh();
        refreshed_ = Steady::now();
        refresh_took_ = refreshed_ - begin;
        if (run_.is_gone() && !was_gone) gone_at_ = refreshed_;
    }

    // Whether to stop: the run has ended, and the visitors have been told. The run's process closes its end
    // of the pipe when the run's files are closed.
    bool is_to_end() {
        if (until_ < 0) return false;
        if (!ending_) {
            pollfd end{until_, POLLIN, 0};
            if (::poll(&end, 1, 0) <= 0) return false;
            ending_ = Steady::now();
            run_.say_farewell();
            refresh();
        }
        const Seconds silence = Seconds(Steady::now().time_since_epoch()) - last_question_.load();
        return silence > farewell || since(*ending_) > longest_farewell;
    }

    void tell_address() {
        const std::scoped_lock lock(mutex_);
        listener_.info(fmt::format("{} is shown at {}{}", run_.title(), visitors_.address(),
                                   visitors_.keyed() ? " (good for one visitor; a new one follows)" : ""));
    }

    // Answers a request, on the server's thread.
    WatchAnswer answer(const WatchRequest& request) {
        {
            const std::scoped_lock lock(mutex_);
            if (!visitors_.knows_host(request.host))
                return text_answer(403, "This page is not to be had under that name.\n");
            if (!visitors_.admitted(request.cookies)) return at_the_door(request);
        }
        last_question_ = Seconds(Steady::now().time_since_epoch());
        const LiveSnapshot now = run_.now();
        if (request.path == "/") return part(now.page, page_type);
        if (request.path == "/live/state") return part(now.state, "application/json");
        if (request.path == "/live/measures") return part(now.measures, "application/json");
        if (request.path == "/live/picture") return part(now.picture, "image/jpeg");
        if (request.path == "/live/meshes") return part(now.meshes, "application/octet-stream");
        if (request.path == "/live/bed") return part(now.bed, "application/octet-stream");
        return run_file(folder_, request.path);
    }

    WatchAnswer at_the_door(const WatchRequest& request) {
        const std::optional<std::string> token = visitors_.admit(request.key);
        if (!token) return text_answer(403, "Open the address that the program tells, with its key.\n");
        new_key_ = true;
        WatchAnswer answer = text_answer(303, "");
        answer.headers = {
            {"Location", "/"},
            {"Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Lax; Path=/", kCookie, *token)}};
        return answer;
    }

    const std::filesystem::path folder_;
    const int until_;
    Listener& listener_;
    LiveRun run_;
    std::mutex mutex_;  // guards visitors_
    Visitors visitors_;
    std::atomic<bool> new_key_{false};
    std::atomic<Seconds> last_question_{Seconds(-1e9)};
    Steady::time_point refreshed_, gone_at_;
    Seconds refresh_took_{0};
    std::optional<Steady::time_point> ending_;
};

}  // namespace

Listening listen_at(const WatchPlace& place) {
    if (place.port) return Listening(place.host, *place.port);
    try {
        return Listening(place.host, kUsualWatchPort);
    } catch (const UserError&) {
        return Listening(place.host, 0);
    }
}

int watch_run(WatchTask request, const Planner& planner, Listener& listener) {
    ::setpriority(PRIO_PROCESS, 0, priority);  // as far as the system allows it
    return Watch(request, planner, listener).serve(std::move(request.listening));
}

namespace {

constexpr std::size_t most_visitors = 256;

// 128 random bits that nobody can guess, as hex digits.
std::string secret() {
    std::array<std::uint8_t, 16> bytes;
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw RunError("watch: the system has no random numbers for a key");
    std::string text;
    for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

// Compares texts in a time that does not depend on where they differ.
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

// The host as it stands in an address: IPv6 needs brackets.
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
