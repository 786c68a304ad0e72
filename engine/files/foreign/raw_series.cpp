#include "engine/files/foreign/raw_series.hpp"

#include <fmt/format.h>
#include <glob.h>
#include <algorithm>
#include <cctype>
#include <exception>
#include <map>
#include <set>
#include <utility>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// Appends the rows of one table to another with the same columns.
void append_rows(RawTable& to, RawTable&& more, const std::string& file) {
    if (more.rows == 0) return;
    if (to.rows == 0) {
        to = std::move(more);
        return;
    }
    for (RawColumn& column : to.columns) {
        const RawColumn* other = more.find(column.name);
        if (other == nullptr || other->words != column.words)
            throw UserError(fmt::format("{}: has other columns than the files beside it ({} is missing)",
                                        file, column.name));
        column.values.insert(column.values.end(), other->values.begin(), other->values.end());
    }
    to.rows += more.rows;
}

std::set<double> ids_of(const RawTable& table) {
    const RawColumn* ids = table.find("id");
    return ids ? std::set<double>(ids->values.begin(), ids->values.end()) : std::set<double>();
}

bool share_ids(const RawTable& a, const RawTable& b) {
    const std::set<double> known = ids_of(a);
    const RawColumn* ids = b.find("id");
    if (ids == nullptr || known.empty()) return true;  // without ids, rows of two files cannot be compared
    return std::any_of(ids->values.begin(), ids->values.end(),
                       [&](double id) { return known.count(id) > 0; });
}

}  // namespace

RawSeries::RawSeries(std::vector<fs::path> files) : files_(std::move(files)) {
    GRAINREEL_CHECK(!files_.empty());
    format_ = raw_format_of(files_.front());
    if (format_ == nullptr)
        throw UserError(fmt::format("{}: is in no format that is read", files_.front().string()));
    for (const fs::path& file : files_) {
        looked_.push_back(look(file));
        if (looked_.size() == 1) facts_ = open_->facts();
        for (std::string& line : open_->news()) news_.push_back(std::move(line));
    }
    list_moments();
    tell_of_equal_files();
}

bool RawSeries::grow(std::vector<fs::path> files) {
    std::map<fs::path, const Looked*> known;
    for (std::size_t file = 0; file < files_.size(); ++file) known.emplace(files_[file], &looked_[file]);
    std::vector<fs::path> whole_files;
    std::vector<Looked> looked;
    std::exception_ptr not_yet;  // why a new file cannot be read; those behind it wait too
    bool changed = false;
    for (fs::path& file : files) {
        const auto before = known.find(file);
        const bool is_known = before != known.end();
        if (not_yet && !is_known) continue;
        const bool kept_open = open_ && open_file_ == file && open_->grows();
        try {
            const bool same = is_known && !kept_open && FileBytes(file).state() == before->second->state;
            looked.push_back(same ? *before->second : look(file));
        } catch (const UserError&) {
            if (is_known) throw;
            not_yet = std::current_exception();
            continue;
        }
        changed = changed || !is_known || looked.back().moments != before->second->moments;
        whole_files.push_back(std::move(file));
    }
    changed = changed || whole_files.size() < files_.size();
    if (not_yet && !changed) std::rethrow_exception(not_yet);
    files_ = std::move(whole_files);
    looked_ = std::move(looked);
    if (!changed) return false;
    const std::vector<RawMoment> before = std::exchange(moments_, {});
    const std::vector<std::string> news = news_;
    parts_.clear();
    list_moments();
    news_ = news;  // what was told once is not told again
    const auto whole = before.end() - (before.back().open ? 1 : 0);
    const auto same = [](const RawMoment& one, const RawMoment& now) {
        return (!one.step || !now.step || one.step == now.step) &&
               (!one.time || !now.time || one.time == now.time);
    };
    if (std::mismatch(before.begin(), whole, moments_.begin(), moments_.end(), same).first != whole)
        throw RunError(fmt::format(
            "{}: has {}, and the first of them are not the {} that were read before; it was truncated or "
            "replaced",
            files_.front().string(), counted(moments_.size(), "frame"), whole - before.begin()));
    return true;
}

RawFile& RawSeries::opened(const fs::path& file) const {
    if (open_ && open_file_ == file) return *open_;
    const RawFormat* format = file == files_.front() ? format_ : raw_format_of(file);
    if (format == nullptr || std::string(format->name) != format_->name)
        throw UserError(fmt::format("{}: is {}, but {} is {}; files of one run have one format",
                                    file.string(), format ? format->about : "in no format that is read",
                                    files_.front().string(), format_->about));
    open_.reset();
    open_ = format->open(file);
    open_file_ = file;
    return *open_;
}

RawSeries::Looked RawSeries::look(const fs::path& file) const {
    // The state comes first, so that the next look sees what is written meanwhile.
    const FileState state = FileBytes(file).state();
    if (open_ && open_file_ == file) {
        try {
            if (open_->grows())
                open_->grow();
            else
                open_.reset();
        } catch (const UserError&) {
            open_.reset();  // another file is there now, perhaps a longer copy
        }
    }
    return {state, opened(file).moments()};
}

void RawSeries::list_moments() {
    std::vector<std::pair<RawMoment, Part>> all;
    for (std::size_t file = 0; file < files_.size(); ++file) {
        const std::vector<RawMoment>& moments = looked_[file].moments;
        for (std::size_t frame = 0; frame < moments.size(); ++frame) {
            RawMoment moment = moments[frame];
            moment.open = moment.open && file + 1 == files_.size();
            // For a file with one frame and no step, the number in its name is the step.
            if (!moment.step && moments.size() == 1 && files_.size() > 1)
                moment.step = number_in_name(files_[file]);
            all.emplace_back(moment, Part{file, frame});
        }
    }
    const auto has = [&](auto member) {
        return std::all_of(all.begin(), all.end(),
                           [&](const auto& one) { return (one.first.*member).has_value(); });
    };
    if (has(&RawMoment::step))
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return *a.first.step < *b.first.step; });
    else if (has(&RawMoment::time))
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return *a.first.time < *b.first.time; });
    join_equal_steps(all);
}

void RawSeries::join_equal_steps(std::vector<std::pair<RawMoment, Part>>& all) {
    std::size_t twice = 0;
    for (auto& each : all) {
        auto& moment = each.first;  // not a structured binding, which lambdas of clang 14 cannot capture
        auto& part = each.second;
        const auto same_time = [&] {
            const RawMoment& before = moments_.back();
            return !moment.step && !before.step && moment.time && before.time == moment.time;
        };
        const bool again =
            !moments_.empty() && ((moment.step && moments_.back().step == moment.step) || same_time());
        if (!again) {
            moments_.push_back(moment);
            parts_.push_back({part});
            continue;
        }
        std::vector<Part>& parts = parts_.back();
        const auto same_file =
            std::find_if(parts.begin(), parts.end(), [&](const Part& one) { return one.file == part.file; });
        if (same_file != parts.end()) {
            *same_file = part;
            ++twice;
        } else {
            parts.push_back(part);
        }
        moments_.back().grains = std::max(moments_.back().grains, moment.grains);
        moments_.back().open = moments_.back().open || moment.open;
        moments_.back().has_walls = moments_.back().has_walls || moment.has_walls;
        moments_.back().has_contacts = moments_.back().has_contacts || moment.has_contacts;
    }
    if (twice > 0)
        news_.push_back(fmt::format("{}: {} twice, as after a restart; the later frame counts",
                                    files_.front().string(),
                                    twice == 1 ? "1 moment comes" : fmt::format("{} moments come", twice)));
}

// Files of one moment are parts of it if they have different grains. If the first such files have the same
// grains, read() takes the later one, and this says so.
void RawSeries::tell_of_equal_files() {
    const auto several = [](const std::vector<Part>& parts) { return parts.size() > 1; };
    const auto found = std::find_if(parts_.begin(), parts_.end(), several);
    if (found == parts_.end()) return;
    const Part one = found->front(), other = found->back();
    try {
        const RawTable before = opened(files_[one.file]).read(one.frame).grains;
        const RawTable after = opened(files_[other.file]).read(other.frame).grains;
        if (before.rows == 0 || after.rows == 0 || !share_ids(before, after)) return;
    } catch (const UserError&) {
        return;  // whoever reads the frame is told what is wrong
    }
    const auto moments = std::count_if(parts_.begin(), parts_.end(), several);
    news_.push_back(fmt::format("{}: has the moment of {} again; the later file counts{}",
                                files_[other.file].string(), files_[one.file].string(),
                                moments > 1 ? fmt::format(", as for {} more moments", moments - 1) : ""));
}

RawFrame RawSeries::read(std::size_t index) const {
    RawFrame frame;
    bool first = true;
    for (const Part& part : parts_.at(index)) {
        RawFrame more = opened(files_[part.file]).read(part.frame);
        if (first) {
            frame = std::move(more);
            first = false;
            continue;
        }
        // Files of several processes have different grains, which are joined. The file of a continued run has
        // the same grains again and replaces the former one.
        if (frame.grains.rows > 0 && more.grains.rows > 0 && share_ids(frame.grains, more.grains)) {
            frame = std::move(more);
            continue;
        }
        append_rows(frame.grains, std::move(more.grains), files_[part.file].string());
        append_rows(frame.contacts, std::move(more.contacts), files_[part.file].string());
        std::move(more.walls.begin(), more.walls.end(), std::back_inserter(frame.walls));
        if (!frame.box) frame.box = more.box;
    }
    if (!frame.step) frame.step = moments_[index].step;
    return frame;
}

std::string RawSeries::place(std::size_t index) const {
    const Part& part = parts_.at(index).front();
    if (files_.size() > 1 && parts_.size() <= files_.size()) return files_[part.file].string();
    return fmt::format("{}: frame {}", files_[part.file].string(), part.frame);
}

namespace fs = std::filesystem;

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// The place of the number in a name; empty where there is none. Digits in a suffix like ".mp4" do not count.
struct NumberAt {
    std::size_t from = 0, size = 0;
};
NumberAt number_at(const std::string& name) {
    std::size_t end = name.size();
    // A suffix that begins with a letter is skipped; a packed file has two of them (".dump.gz").
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
