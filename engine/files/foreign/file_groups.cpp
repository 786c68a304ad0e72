#include "engine/files/foreign/file_groups.hpp"

#include <glob.h>
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/foreign/raw_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

bool share_ids(const RawTable& a, const RawTable& b) {
    const auto ids_of = [](const RawTable& table) {
        const RawColumn* const ids = table.find("id");
        return ids ? std::set<double>(ids->values.begin(), ids->values.end()) : std::set<double>();
    };
    const std::set<double> known = ids_of(a);
    const RawColumn* const ids = b.find("id");
    if (ids == nullptr || known.empty()) return true;  // without ids, rows of two files cannot be compared
    return std::any_of(ids->values.begin(), ids->values.end(),
                       [&](double id) { return known.count(id) > 0; });
}

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// A number in a name.
struct NumberInName {
    std::size_t from = 0, size = 0;
    std::int64_t value = 0;
};

// The numbers in a name, from left to right. Digits in a suffix like ".mp4" do not count.
std::vector<NumberInName> numbers_in(const std::string& name) {
    constexpr std::size_t most_digits = 18;
    std::size_t end = name.size();
    // A suffix that begins with a letter is skipped; a packed file has two of them (".dump.gz").
    for (int suffixes = 0; suffixes < 2; ++suffixes) {
        const std::size_t dot = name.rfind('.', end == 0 ? 0 : end - 1);
        if (dot == std::string::npos || dot + 1 >= end) break;
        if (is_digit(name[dot + 1])) break;
        end = dot;
    }
    std::vector<NumberInName> numbers;
    for (std::size_t from = 0; from < end; ++from) {
        if (!is_digit(name[from])) continue;
        std::size_t size = 1;
        while (from + size < end && is_digit(name[from + size])) ++size;
        if (size <= most_digits) numbers.push_back({from, size, std::stoll(name.substr(from, size))});
        from += size;
    }
    return numbers;
}

// The path with a star in place of the numbers that `starred` names by their places in the list.
std::string with_stars(const fs::path& file, const std::vector<NumberInName>& numbers,
                       const std::set<std::size_t>& starred) {
    std::string name = file.filename().string();
    for (std::size_t k = numbers.size(); k-- > 0;)
        if (starred.count(k) > 0) name.replace(numbers[k].from, numbers[k].size, "*");
    return (file.parent_path() / name).string();
}

// A file, and the numbers in its name.
struct NumberedFile {
    fs::path path;
    std::vector<NumberInName> numbers;
    std::int64_t value(std::size_t k) const { return numbers[k].value; }
};
using Family = std::vector<NumberedFile>;  // files whose names differ in nothing but numbers

// The first frame of a file that has grains; none where it cannot be read.
std::optional<RawFrame> first_frame(const fs::path& file) {
    try {
        const RawFormat* const format = raw_format_of(file);
        if (format == nullptr) return std::nullopt;
        const std::unique_ptr<RawFile> opened = format->open(file);
        const std::vector<RawMoment>& moments = opened->moments();
        const auto one = std::find_if(moments.begin(), moments.end(),
                                      [](const RawMoment& moment) { return moment.grains > 0; });
        if (one == moments.end()) return std::nullopt;
        return opened->read(static_cast<std::size_t>(one - moments.begin()));
    } catch (const UserError&) {
        return std::nullopt;
    }
}

std::optional<double> clock_of(const RawFrame& frame) {
    if (frame.step) return static_cast<double>(*frame.step);
    return frame.time;
}

// The values of a number in the names of a family.
std::set<std::int64_t> values_of(const Family& family, std::size_t number) {
    std::set<std::int64_t> values;
    for (const NumberedFile& file : family) values.insert(file.value(number));
    return values;
}

// Whether `step` numbers the steps and `process` the processes, 0, 1, ... for each step, by the names alone.
bool is_grid(const Family& family, std::size_t step, std::size_t process) {
    const std::set<std::int64_t> steps = values_of(family, step), processes = values_of(family, process);
    return *processes.begin() == 0 && *processes.rbegin() + 1 == std::ssize(processes) &&
           steps.size() * processes.size() == family.size();
}

// Whether the files say so too: the step of a frame is that of its name, and files of one step have different
// grains. process: none where only the steps vary.
bool files_agree(const Family& sorted, std::size_t step, std::optional<std::size_t> process) {
    const NumberedFile& first = sorted.front();
    const auto says_its_step = [&](const NumberedFile& file, const std::optional<RawFrame>& frame) {
        return frame && frame->step == file.value(step);
    };
    const std::optional<RawFrame> frame = first_frame(first.path);
    if (!says_its_step(first, frame)) return false;
    const auto later = std::find_if(sorted.begin(), sorted.end(), [&](const NumberedFile& file) {
        return file.value(step) != first.value(step);
    });
    if (later != sorted.end() && !says_its_step(*later, first_frame(later->path))) return false;
    if (!process) return true;
    const std::optional<RawFrame> other = first_frame(sorted[1].path);
    return says_its_step(sorted[1], other) && !share_ids(frame->grains, other->grains);
}

// The family as one group, where two numbers vary and one of them counts processes, or where one number
// varies that is not the last.
std::optional<FileGroup> group_by_steps(Family family) {
    std::vector<std::size_t> varying;
    for (std::size_t k = 0; k < family.front().numbers.size(); ++k)
        if (values_of(family, k).size() > 1) varying.push_back(k);
    const auto try_one = [&](std::size_t step, std::optional<std::size_t> process) {
        std::sort(family.begin(), family.end(), [&](const NumberedFile& a, const NumberedFile& b) {
            if (a.value(step) != b.value(step)) return a.value(step) < b.value(step);
            return process && a.value(*process) < b.value(*process);
        });
        return (!process || is_grid(family, step, *process)) && files_agree(family, step, process);
    };
    const bool two = varying.size() == 2;
    const bool one_before_last = varying.size() == 1 && varying[0] + 1 < family.front().numbers.size();
    const bool taken = two ? try_one(varying[0], varying[1]) || try_one(varying[1], varying[0])
                           : one_before_last && try_one(varying[0], std::nullopt);
    if (!taken) return std::nullopt;
    FileGroup group;
    group.pattern = with_stars(family.front().path, family.front().numbers, {varying.begin(), varying.end()});
    for (NumberedFile& file : family) group.files.push_back(std::move(file.path));
    return group;
}

// The groups of a family by the last number.
void group_by_last(const Family& family, std::vector<FileGroup>& groups) {
    std::map<std::string, Family> by_pattern;
    for (const NumberedFile& file : family)
        by_pattern[with_stars(file.path, file.numbers, {file.numbers.size() - 1})].push_back(file);
    for (auto& [pattern, members] : by_pattern) {
        std::sort(members.begin(), members.end(), [](const NumberedFile& a, const NumberedFile& b) {
            const std::int64_t one = a.numbers.back().value, other = b.numbers.back().value;
            return one != other ? one < other : a.path < b.path;
        });
        FileGroup& group = groups.emplace_back();
        group.pattern = members.size() > 1 ? pattern : members.front().path.string();
        for (NumberedFile& file : members) group.files.push_back(std::move(file.path));
    }
}

std::string skeleton_of(const NumberedFile& file) {
    std::set<std::size_t> all;
    for (std::size_t k = 0; k < file.numbers.size(); ++k) all.insert(k);
    return with_stars(file.path, file.numbers, all);
}

}  // namespace

std::optional<std::int64_t> number_in_name(const fs::path& file) {
    const std::vector<NumberInName> numbers = numbers_in(file.filename().string());
    if (numbers.empty()) return std::nullopt;
    return numbers.back().value;
}

std::vector<FileGroup> grouped(const std::vector<fs::path>& files) {
    std::map<std::string, Family> families;
    std::vector<FileGroup> groups;
    for (const fs::path& path : files) {
        NumberedFile file{path, numbers_in(path.filename().string())};
        if (file.numbers.empty())
            groups.push_back({path.string(), {path}});
        else
            families[skeleton_of(file)].push_back(std::move(file));
    }
    for (const auto& [skeleton, family] : families) {
        const bool may_have_two = family.size() > 1 && family.front().numbers.size() > 1;
        if (std::optional<FileGroup> all = may_have_two ? group_by_steps(family) : std::nullopt)
            groups.push_back(std::move(*all));
        else
            group_by_last(family, groups);
    }
    std::sort(groups.begin(), groups.end(),
              [](const FileGroup& a, const FileGroup& b) { return a.pattern < b.pattern; });
    return groups;
}

FileGroup series_of(const fs::path& file) {
    const NumberedFile named{file, numbers_in(file.filename().string())};
    if (named.numbers.empty()) return {file.string(), {file}};
    const std::string skeleton = skeleton_of(named);
    std::vector<fs::path> alike;
    for (const fs::path& other : files_in(folder_around(file))) {
        const fs::path path = file.has_parent_path() ? other : other.filename();
        const NumberedFile one{path, numbers_in(path.filename().string())};
        if (!one.numbers.empty() && skeleton_of(one) == skeleton) alike.push_back(path);
    }
    for (FileGroup& group : grouped(alike))
        if (contains(group.files, file)) return std::move(group);
    return {file.string(), {file}};
}

bool are_different_runs(const FileGroup& group) {
    if (group.files.size() < 2) return false;
    const std::optional<RawFrame> one = first_frame(group.files[0]), other = first_frame(group.files[1]);
    if (!one || !other || !clock_of(*one) || clock_of(*one) != clock_of(*other)) return false;
    const bool with_ids = one->grains.find("id") != nullptr && other->grains.find("id") != nullptr;
    return with_ids && share_ids(one->grains, other->grains);
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
        throw UserError("{}: no file has such a name; quote the pattern so that the shell leaves it alone",
                        pattern.string());
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
