#include "engine/files/foreign/raw_series.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <exception>
#include <iterator>
#include <map>
#include <utility>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/file_groups.hpp"

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
            throw UserError("{}: has other columns than the files beside it ({} is missing)", file,
                            column.name);
        column.values.insert(column.values.end(), other->values.begin(), other->values.end());
    }
    to.rows += more.rows;
}

}  // namespace

RawSeries::RawSeries(std::vector<fs::path> files) : files_(std::move(files)) {
    GRAINREEL_CHECK(!files_.empty());
    format_ = raw_format_of(files_.front());
    if (format_ == nullptr) throw UserError("{}: is in no format that is read", files_.front().string());
    for (const fs::path& file : files_) {
        looked_.push_back(look(file));
        RawFile& one = *open_.back().second;
        if (looked_.size() == 1) facts_ = one.facts();
        for (std::string& line : one.news()) news_.push_back(std::move(line));
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
        const auto kept_open = std::find_if(open_.begin(), open_.end(), [&](const auto& one) {
            return one.first == file && one.second->grows();
        });
        try {
            const bool same =
                is_known && kept_open == open_.end() && FileBytes(file).state() == before->second->state;
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
    list_moments();
    news_ = news;  // what was told once is not told again
    const auto whole = before.end() - (before.back().open ? 1 : 0);
    const auto same = [](const RawMoment& one, const RawMoment& now) {
        return (!one.step || !now.step || one.step == now.step) &&
               (!one.time || !now.time || one.time == now.time);
    };
    if (std::mismatch(before.begin(), whole, moments_.begin(), moments_.end(), same).first != whole)
        throw RunError(
            "{}: has {}, and the first of them are not the {} that were read before; it was truncated or "
            "replaced, or its run went on from an earlier moment",
            files_.front().string(), counted(moments_.size(), "frame"), whole - before.begin());
    return true;
}

RawSeries::Looked RawSeries::look(const fs::path& file) const {
    // The state comes first, so that the next look sees what is written meanwhile.
    const FileState state = FileBytes(file).state();
    const auto kept_open =
        std::find_if(open_.begin(), open_.end(), [&](const auto& one) { return one.first == file; });
    bool is_current = false;
    try {
        if (kept_open != open_.end() && kept_open->second->grows()) {
            kept_open->second->grow();
            is_current = true;
        }
    } catch (const UserError&) {  // another file is there now, perhaps a longer copy
    }
    if (kept_open != open_.end() && !is_current) open_.erase(kept_open);
    return {state, opened(file).moments()};
}

RawFile& RawSeries::opened(const fs::path& file) const {
    constexpr std::size_t most_open = 16;
    const auto known =
        std::find_if(open_.begin(), open_.end(), [&](const auto& one) { return one.first == file; });
    if (known != open_.end()) {
        std::rotate(known, known + 1, open_.end());
        return *open_.back().second;
    }
    const RawFormat* format = file == files_.front() ? format_ : raw_format_of(file);
    if (format == nullptr || std::string(format->name) != format_->name)
        throw UserError("{}: is {}, but {} is {}; files of one run have one format", file.string(),
                        format ? format->about : "in no format that is read", files_.front().string(),
                        format_->about);
    std::erase_if(open_, [](const auto& one) { return one.second->moments().size() < 2; });
    if (open_.size() == most_open) open_.erase(open_.begin());
    open_.emplace_back(file, format->open(file));
    return *open_.back().second;
}

void RawSeries::list_moments() {
    std::vector<PlacedMoment> all;
    for (std::size_t file = 0; file < files_.size(); ++file) {
        const std::vector<RawMoment>& moments = looked_[file].moments;
        for (std::size_t frame = 0; frame < moments.size(); ++frame) {
            RawMoment moment = moments[frame];
            moment.open = moment.open && file + 1 == files_.size();
            // For a file with one frame and no step, the number in its name is the step.
            if (!moment.step && moments.size() == 1 && files_.size() > 1)
                moment.step = number_in_name(files_[file]);
            all.push_back({moment, file, frame});
        }
    }
    OrderedMoments ordered = in_order(
        all, [this](const PlacedMoment& one, const PlacedMoment& other) { return are_parts(one, other); });
    parts_ = std::move(ordered.moments);
    for (const Parts& parts : parts_) {
        RawMoment& moment = moments_.emplace_back(parts.front().moment);
        for (const auto& [more, file, frame] : parts) {
            moment.grains = std::max(moment.grains, more.grains);
            moment.open = moment.open || more.open;
            moment.has_walls = moment.has_walls || more.has_walls;
            moment.has_contacts = moment.has_contacts || more.has_contacts;
        }
    }
    tell_of_return(ordered.gone_back);
}

void RawSeries::tell_of_return(const OrderedMoments::GoneBack& gone_back) {
    const std::string name = files_.front().string();
    if (gone_back.twice > 0)
        news_.push_back(fmt::format(
            "{}: {} twice, as after a restart; the later frame counts", name,
            gone_back.twice == 1 ? "1 moment comes" : fmt::format("{} moments come", gone_back.twice)));
    if (gone_back.given_up > 0)
        news_.push_back(
            fmt::format("{}: goes back from {:.10g} to {:.10g}, as after a restart; {} that the "
                        "run gave up there {} left out",
                        name, gone_back.from, gone_back.to, counted(gone_back.given_up, "frame"),
                        gone_back.given_up == 1 ? "is" : "are"));
}

bool RawSeries::are_parts(const PlacedMoment& one, const PlacedMoment& other) const {
    try {
        const RawTable grains = opened(files_[one.file]).read(one.frame).grains;
        return !share_ids(grains, opened(files_[other.file]).read(other.frame).grains);
    } catch (const UserError&) {
        return false;  // whoever reads the frame is told what is wrong
    }
}

// Files of one moment are parts of it if they have different grains. If the first such files have the same
// grains, read() takes the later one, and this says so.
void RawSeries::tell_of_equal_files() {
    const auto several = [](const Parts& parts) { return parts.size() > 1; };
    const auto part = std::find_if(parts_.begin(), parts_.end(), several);
    if (part == parts_.end()) return;
    const PlacedMoment &one = part->front(), &other = part->back();
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
    for (const PlacedMoment& part : parts_.at(index)) {
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
    const PlacedMoment& part = parts_.at(index).front();
    if (files_.size() > 1 && parts_.size() <= files_.size()) return files_[part.file].string();
    return fmt::format("{}: frame {}", files_[part.file].string(), part.frame);
}

}  // namespace grainreel
