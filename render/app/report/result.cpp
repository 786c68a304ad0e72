#include "render/app/report/result.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

int first_error = 0;  // errno of the first failure

void note_error() {
    if (first_error == 0) first_error = errno != 0 ? errno : EIO;
}

void put(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) note_error();
}

}  // namespace

void print_result(std::string_view text) {
    put(visible(text, "\n\t"));
}

void print_exact(std::string_view text) {
    ::isatty(STDOUT_FILENO) != 0 ? print_result(text) : put(text);
}

void close_results() {
    if (std::fflush(stdout) != 0) note_error();
    // `inspect ... | head` has read what it wanted.
    if (first_error != 0 && first_error != EPIPE)
        throw RunError(fmt::format("stdout: cannot be written: {}", std::strerror(first_error)));
}

}  // namespace grainreel
