#include "engine/files/foreign/raw_series.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
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
            throw UserError(fmt::format("{}: has other columns than the files beside it ({} is missing)",
                                        file, column.name));
        column.values.insert(column.values.end(), other->values.begin(), other->values.end());
    }
    to.rows += more.rows;
}

}  // namespace

RawSeries::RawSeries(std::vector<fs::path> files) : files_(std::move(files)) {
    GRAINREEL_CHECK(!files_.empty());
    format_ = raw_format_of(files_.front());
    if (format_ == nullptr)
        throw UserError(fmt::format("{}: is in no format that is read", files_.front().string()));
    list_moments();
}

RawFile& RawSeries::opened(std::size_t file) const {
    constexpr std::size_t most_open = 16;
    const auto known =
        std::find_if(open_.begin(), open_.end(), [&](const auto& one) { return one.first == file; });
    if (known != open_.end()) {
        std::rotate(known, known + 1, open_.end());
        return *open_.back().second;
    }
    const fs::path& path = files_[file];
    const RawFormat* format = file == 0 ? format_ : raw_format_of(path);
    if (format == nullptr || std::string(format->name) != format_->name)
        throw UserError(fmt::format("{}: is {}, but {} is {}; files of one run have one format",
                                    path.string(), format ? format->about : "in no format that is read",
                                    files_.front().string(), format_->about));
    std::erase_if(open_, [](const auto& one) { return one.second->moments().size() < 2; });
    if (open_.size() == most_open) open_.erase(open_.begin());
    open_.emplace_back(file, format->open(path));
    return *open_.back().second;
}

void RawSeries::list_moments() {
    std::vector<PlacedMoment> all;
    for (std::size_t file = 0; file < files_.size(); ++file) {
        RawFile& one = opened(file);
        if (file == 0) facts_ = one.facts();
        for (std::string& line : one.news()) news_.push_back(std::move(line));
        const std::vector<RawMoment>& moments = one.moments();
        for (std::size_t frame = 0; frame < moments.size(); ++frame) {
            RawMoment moment = moments[frame];
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
            moment.has_walls = moment.has_walls || more.has_walls;
            moment.has_contacts = moment.has_contacts || more.has_contacts;
        }
    }
    tell_of_return(ordered.returned);
    tell_of_equal_files();
}

void RawSeries::tell_of_return(const OrderedMoments::Returned& returned) {
    const std::string name = files_.front().string();
    if (returned.twice > 0)
        news_.push_back(fmt::format(
            "{}: {} twice, as after a restart; the later frame counts", name,
            returned.twice == 1 ? "1 moment comes" : fmt::format("{} moments come", returned.twice)));
    if (returned.given_up > 0)
        news_.push_back(
            fmt::format("{}: goes back from {:.10g} to {:.10g}, as after a restart; {} that the "
                        "run gave up there {} left out",
                        name, returned.from, returned.to, counted(returned.given_up, "frame"),
                        returned.given_up == 1 ? "is" : "are"));
}

bool RawSeries::are_parts(const PlacedMoment& one, const PlacedMoment& other) const {
    try {
        const RawTable grains = opened(one.file).read(one.frame).grains;
        return !share_ids(grains, opened(other.file).read(other.frame).grains);
    } catch (const UserError&) {
        return false;  // whoever reads the frame is told what is wrong
    }
}

// Files of one moment are parts of it if they have different grains. If the first such files have the same
// grains, read() takes the later one, and this says so.
void RawSeries::tell_of_equal_files() {
    const auto several = [](const Parts& parts) { return parts.size() > 1; };
    const auto found = std::find_if(parts_.begin(), parts_.end(), several);
    if (found == parts_.end()) return;
    const PlacedMoment &one = found->front(), &other = found->back();
    try {
        const RawTable before = opened(one.file).read(one.frame).grains;
        const RawTable after = opened(other.file).read(other.frame).grains;
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
        RawFrame more = opened(part.file).read(part.frame);
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
