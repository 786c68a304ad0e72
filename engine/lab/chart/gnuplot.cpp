#include "engine/lab/chart/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

namespace grainreel {

bool run_gnuplot(const std::filesystem::path& folder, std::string commands) {
    posix_spawn_file_actions_t there;
    posix_spawn_file_actions_init(&there);
    posix_spawn_file_actions_addchdir_np(&there, folder.c_str());
    // What gnuplot says of an axis that it had to widen, or of a series without points, is none of the
    // user's.
    posix_spawn_file_actions_addopen(&there, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&there, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    char name[] = "gnuplot";
    char* words[] = {name, commands.data(), nullptr};
    pid_t child = 0;
    // gnuplot gets a process group of its own: Ctrl-C, which grainreel handles itself, would stop it in the
    // middle of a picture.
    posix_spawnattr_t apart;
    posix_spawnattr_init(&apart);
    posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETPGROUP);
    const bool started = posix_spawnp(&child, name, &there, &apart, words, environ) == 0;
    posix_spawnattr_destroy(&apart);
    posix_spawn_file_actions_destroy(&there);
    int status = 1;
    return started && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

namespace {

bool is_control(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

// The text in double quotes; characters with a meaning there are written as numbers.
std::string in_double_quotes(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (std::string_view("'\"\\`@$").find(c) != std::string_view::npos)
            result += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
        else
            result += c;
    }
    return result + "\"";
}

bool begins_character(char c) {
    return (c & 0xC0) != 0x80;
}

std::size_t length(const std::string& utf8) {
    return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), begins_character));
}

std::string first_characters(const std::string& utf8, std::size_t count) {
    std::size_t bytes = 0;
    for (; bytes < utf8.size(); ++bytes)
        if (begins_character(utf8[bytes]) && count-- == 0) break;
    return utf8.substr(0, bytes);
}

}  // namespace

std::string gnuplot_text(const std::string& text) {
    std::string line = text;
    std::replace_if(line.begin(), line.end(), is_control, ' ');
    // gnuplot (5.4) takes a doubled quote at the beginning of a text for its end.
    return line.find('\'') == std::string::npos ? "'" + line + "'" : in_double_quotes(line);
}

std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
    std::vector<std::string> lines;
    std::string line, word;
    const auto end_line = [&] {
        if (!line.empty()) lines.push_back(line);
        line.clear();
    };
    std::istringstream words(text);
    while (words >> word) {
        while (length(word) > most) {  // puts a piece of a long word on a line of its own
            end_line();
            line = first_characters(word, most);
            word.erase(0, line.size());
            end_line();
        }
        if (!line.empty() && length(line) + 1 + length(word) > most) end_line();
        line += (line.empty() ? "" : " ") + word;
    }
    if (!line.empty() || lines.empty()) lines.push_back(line);
    return lines;
}

std::string gnuplot_lines(const std::string& text, std::size_t most) {
    std::string result;
    for (const std::string& line : wrapped(text, most))
        result += (result.empty() ? "" : ".\"\\n\".") + gnuplot_text(line);
    return result;
}

}  // namespace grainreel
