#include "engine/files/foreign/series/file_groups.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>
#include <glob.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Where the number stands in a name; empty when there is none. Digits within a suffix like ".mp4" do not
// count.
struct NumberAt {
    std::size_t from = 0, size = 0;
};
NumberAt number_at(const std::string& name) {
    std::size_t end = name.size();
    // A suffix that begins with a letter is passed over, with a packed file's second one (".dump.gz").
    for (int suffixes = 0; suffixes < 2; ++suffixes) {
        const std::size_t dot = name.rfind('.', end == 0 ? 0 : end - 1);
        if (dot == std::string::npos || dot + 1 >= end) break;
        if (is_digit(name[dot + 1])) break;
        end = dot;
    }
    while (end > 0 && !is_digit(name[end - 1])) --end;
    std::size_t from = end;
    while (from > 0 && is_digit(name[from - 1])) --from;
    return {from, end - from};
}

std::string pattern_of(const fs::path& file) {
    std::string name = file.filename().string();
    const NumberAt at = number_at(name);
    if (at.size == 0) return file.string();
    name.replace(at.from, at.size, "*");
    return (file.parent_path() / name).string();
}

}  // namespace

std::optional<std::int64_t> number_in_name(const fs::path& file) {
    const std::string name = file.filename().string();
    const NumberAt at = number_at(name);
    constexpr std::size_t most_digits = 18;
    if (at.size == 0 || at.size > most_digits) return std::nullopt;
    return std::stoll(name.substr(at.from, at.size));
}

std::vector<FileGroup> grouped(const std::vector<fs::path>& files) {
    std::map<std::string, std::vector<fs::path>> by_pattern;
    for (const fs::path& file : files) by_pattern[pattern_of(file)].push_back(file);
    std::vector<FileGroup> groups;
    for (auto& [pattern, members] : by_pattern) {
        std::sort(members.begin(), members.end(), [](const fs::path& a, const fs::path& b) {
            const auto one = number_in_name(a), other = number_in_name(b);
            return one != other ? one < other : a < b;
        });
        groups.push_back({members.size() > 1 ? pattern : members.front().string(), std::move(members)});
    }
    return groups;
}

FileGroup series_of(const fs::path& file) {
    if (!number_in_name(file)) return {file.string(), {file}};
    std::vector<fs::path> alike;
    const std::string pattern = pattern_of(file);
    for (const fs::path& other : files_in(file.has_parent_path() ? file.parent_path() : fs::path("."))) {
        const fs::path named = file.has_parent_path() ? other : other.filename();
        if (pattern_of(named) == pattern) alike.push_back(named);
    }
    std::vector<FileGroup> groups = grouped(alike);
    if (groups.empty()) return {file.string(), {file}};
    return groups.front();
}

std::vector<fs::path> files_of_pattern(const fs::path& pattern) {
    glob_t found{};
    const int failed = glob(pattern.c_str(), 0, nullptr, &found);
    std::vector<fs::path> files;
    if (failed == 0)
        for (std::size_t i = 0; i < found.gl_pathc; ++i)
            if (is_plain(found.gl_pathv[i])) files.emplace_back(found.gl_pathv[i]);
    globfree(&found);
    if (files.empty())
        throw UserError(
            fmt::format("{}: no file has such a name; quote the pattern so that the shell leaves it alone",
                        pattern.string()));
    return files;
}

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (entry.path().filename().string().front() != '.' && is_plain(entry.path()))
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace grainreel
