#include "engine/chart/gnuplot.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <sstream>

namespace grainreel {

bool run_gnuplot(const std::filesystem::path& folder, std::string commands) {
    posix_spawn_file_actions_t there;
    posix_spawn_file_actions_init(&there);
    posix_spawn_file_actions_addchdir_np(&there, folder.c_str());
    char name[] = "gnuplot";
    char* words[] = {name, commands.data(), nullptr};
    pid_t child = 0;
    // A group of its own: Ctrl-C, which is ours to answer, would leave half a picture.
    posix_spawnattr_t apart;
    posix_spawnattr_init(&apart);
    posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETPGROUP);
    const bool started = posix_spawnp(&child, name, &there, &apart, words, environ) == 0;
    posix_spawnattr_destroy(&apart);
    posix_spawn_file_actions_destroy(&there);
    int status = 1;
    return started && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string gnuplot_text(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '\'') result += '\'';
        result += byte < 0x20 || byte == 0x7f ? ' ' : c;
    }
    return result + "'";
}

namespace {

constexpr const char* line_end = ".\"\\n\".";

bool begins_character(char c) {
    return (c & 0xC0) != 0x80;
}

std::string first_characters(const std::string& utf8, std::size_t count) {
    std::size_t bytes = 0;
    for (; bytes < utf8.size(); ++bytes)
        if (begins_character(utf8[bytes]) && count-- == 0) break;
    return utf8.substr(0, bytes);
}

}  // namespace

std::string gnuplot_lines(const std::string& text, std::size_t most) {
    const auto length = [](const std::string& utf8) {
        return std::count_if(utf8.begin(), utf8.end(), begins_character);
    };
    std::string result, line, word;
    std::istringstream words(text);
    while (words >> word) {
        while (length(word) > static_cast<std::ptrdiff_t>(most)) {  // a piece of it on a line of its own
            const std::string piece = first_characters(word, most);
            if (!line.empty()) result += gnuplot_text(line) + line_end;
            result += gnuplot_text(piece) + line_end;
            line.clear();
            word.erase(0, piece.size());
        }
        if (!line.empty() && length(line) + 1 + length(word) > static_cast<std::ptrdiff_t>(most)) {
            result += gnuplot_text(line) + line_end;
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return result + gnuplot_text(line);
}

}  // namespace grainreel
