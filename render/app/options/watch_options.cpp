// Where a run is shown live.
#include <charconv>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "render/app/options/option_groups.hpp"

namespace grainreel {

namespace {

constexpr int highest_port = 65535;

int port_of(const std::string& flag, const std::string& text) {
    int port = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc() || end != text.data() + text.size() || port < 0 || port > highest_port)
        throw UserError(fmt::format("{} {}: is no port; give a number from 0 (any that is free) to {}", flag,
                                    excerpt(text), highest_port));
    return port;
}

}  // namespace

void add_watch_port(CLI::App& verb, WatchPlace& place) {
    verb.add_option_function<std::string>(
            "--port", [&place](const std::string& text) { place.port = port_of("--port", text); },
            fmt::format("Port of the page; 0 takes any that is free [{}, or any that is free]",
                        kUsualWatchPort))
        ->type_name("N");
}

void add_watch_host(CLI::App& verb, WatchPlace& place) {
    verb.add_option_function<std::string>(
            "--watch-host",
            [&place](const std::string& host) {
                check_typed("--watch-host", host);
                place.host = host;
            },
            "Show it to other machines too: a name or an address of this one. The address that is\n"
            "told has a key, which is good for one visitor [127.0.0.1: this machine alone]")
        ->type_name("HOST");
}

void add_watch(CLI::App& verb, bool& wanted, WatchPlace& place) {
    verb.add_option_function<std::string>(
            "--watch",
            [&wanted, &place](const std::string& text) {
                if (!text.empty()) place.port = port_of("--watch", text);
                wanted = true;
            },
            "Show the run while it goes, as a page on this machine: picture, bed, charts, time left")
        ->type_name("PORT")
        ->expected(0, 1);
    add_watch_host(verb, place);
}

}  // namespace grainreel
