#include "engine/files/foreign/series/raw_series.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/foreign/series/file_groups.hpp"

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
    if (ids == nullptr || known.empty()) return true;  // rows without ids cannot be told apart
    return std::any_of(ids->values.begin(), ids->values.end(),
                       [&](double id) { return known.count(id) > 0; });
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
    if (open_ && open_file_ == file) return *open_;
    const fs::path& path = files_[file];
    const RawFormat* format = raw_format_of(path);
    if (format == nullptr || std::string(format->name) != format_->name)
        throw UserError(fmt::format("{}: is {}, but {} is {}; files of one run have one format",
                                    path.string(), format ? format->about : "in no format that is read",
                                    files_.front().string(), format_->about));
    open_.reset();
    open_ = format->open(path);
    open_file_ = file;
    return *open_;
}

void RawSeries::list_moments() {
    std::vector<std::pair<RawMoment, Part>> all;
    for (std::size_t file = 0; file < files_.size(); ++file) {
        RawFile& one = opened(file);
        if (file == 0) facts_ = one.facts();
        for (std::string& line : one.news()) news_.push_back(std::move(line));
        const std::vector<RawMoment>& moments = one.moments();
        for (std::size_t frame = 0; frame < moments.size(); ++frame) {
            RawMoment moment = moments[frame];
            // The number in the name of a file with one frame is the step.
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
        auto& moment = each.first;  // no structured binding: clang 14 lets no lambda take one
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
        moments_.back().has_walls = moments_.back().has_walls || moment.has_walls;
        moments_.back().has_contacts = moments_.back().has_contacts || moment.has_contacts;
    }
    if (twice > 0)
        news_.push_back(fmt::format("{}: {} twice, as after a restart; the later frame counts",
                                    files_.front().string(),
                                    twice == 1 ? "1 moment comes" : fmt::format("{} moments come", twice)));
}

RawFrame RawSeries::read(std::size_t index) const {
    RawFrame frame;
    bool first = true;
    for (const Part& part : parts_.at(index)) {
        RawFrame more = opened(part.file).read(part.frame);
        if (first) {
            frame = std::move(more);
            first = false;
            continue;
        }
        // Processes have different grains. A file that goes on with a run has the same ones again.
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

}  // namespace grainreel
