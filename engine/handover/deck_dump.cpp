#include "engine/handover/deck_dump.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/foreign/dumps/text_index.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// The columns that both decks ask for, in this order.
constexpr std::array kColumns = {"id", "type", "radius", "x",      "y",      "z",
                                 "vx", "vy",   "vz",     "omegax", "omegay", "omegaz"};

RawFormat text_format() {
    for (const RawFormat& format : raw_formats())
        if (std::string(format.name) == "lammps-dump") return format;
    throw std::logic_error("there is no reader of dumps");
}

}  // namespace

bool DeckDump::is_shorter() const {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file_, error);
    return !error && size < size_;
}

void DeckDump::read_anew() {
    dump_.reset();
    size_ = 0;
    next_ = 0;
}

// Opens the file or looks what was added to it. Returns whether there is something to read.
bool DeckDump::look() {
    if (!is_plain(file_)) return false;
    if (is_shorter())
        throw RunError("{}: got shorter while it was read; it was truncated or replaced", file_.string());
    std::error_code error;
    size_ = std::max(size_, fs::file_size(file_, error));
    try {
        if (dump_)
            dump_->grow();
        else
            dump_ = text_format().open(file_);
    } catch (const NotYetWhole&) {
        return false;
    }
    return true;
}

std::optional<State> DeckDump::next() {
    const auto is_known = [&] {
        return dump_ && next_ < dump_->moments().size() && !dump_->moments()[next_].open;
    };
    if (!is_known() && (!look() || !is_known())) return std::nullopt;
    while (is_given_up(next_)) ++next_;
    if (!is_known()) return std::nullopt;
    const RawFrame raw = dump_->read(next_);
    if (!std::exchange(checked_, true)) check_columns(raw.grains);
    State frame = frame_of(raw);
    ++next_;
    return frame;
}

// Whether the run went on from a moment before this one and wrote this or later steps again further on.
bool DeckDump::is_given_up(std::size_t frame) const {
    const std::vector<RawMoment>& moments = dump_->moments();
    if (least_after_.size() != moments.size()) {
        least_after_.assign(moments.size(), std::numeric_limits<std::int64_t>::max());
        for (std::size_t k = moments.size(); k-- > 1;)
            least_after_[k - 1] = moments[k].open
                                      ? least_after_[k]
                                      : std::min(least_after_[k], moments[k].step.value_or(least_after_[k]));
    }
    return frame < moments.size() && least_after_[frame] <= moments[frame].step.value_or(0);
}

void DeckDump::check_columns(const RawTable& table) const {
    const bool same = std::equal(table.columns.begin(), table.columns.end(), kColumns.begin(), kColumns.end(),
                                 [](const RawColumn& one, const char* name) { return one.name == name; });
    if (!same)
        throw UserError("{}: has other columns; the dump is to be that of the deck as it was written",
                        file_.string());
}

State DeckDump::frame_of(const RawFrame& raw) const {
    const std::vector<RawColumn>& columns = raw.grains.columns;
    for (std::size_t row = 0; row < raw.grains.rows; ++row)
        for (const RawColumn& column : columns)
            if (!std::isfinite(column.values[row]))
                throw UserError(
                    "{}: step {}: atom {} has {} as {}, which is no finite number; the dump is to be "
                    "that of the deck as it was written",
                    file_.string(), raw.step.value_or(0), columns[0].values[row], column.values[row],
                    column.name);
    State frame;
    frame.step = raw.step.value_or(0);
    const auto whole = [](double value) {  // the nearest that fits
        constexpr double least = std::numeric_limits<std::int32_t>::min(),
                         most = std::numeric_limits<std::int32_t>::max();
        return static_cast<std::int32_t>(std::clamp(value, least, most));
    };
    for (const std::size_t row : rows_by_id(columns[0].values)) {
        const auto vector = [&](std::size_t first) {
            return Vec3(columns[first].values[row], columns[first + 1].values[row],
                        columns[first + 2].values[row]);
        };
        frame.id.push_back(whole(columns[0].values[row]));
        frame.species.push_back(whole(columns[1].values[row] - 1));
        frame.radius.push_back(columns[2].values[row]);
        frame.position.push_back(vector(3));
        frame.velocity.push_back(vector(6));
        frame.spin.push_back(vector(9));
    }
    return frame;
}

void trim_dump(const fs::path& dump, std::int64_t step) {
    LineReader lines(dump);
    TextIndex index;
    index.go_on(lines, dump);
    if (index.unended) index.frames.pop_back();
    std::uintmax_t kept = 0;
    for (const DumpFrame& frame : index.frames) {
        if (frame.step > step) break;
        kept = frame.end;
    }
    std::error_code failed;
    fs::resize_file(dump, kept, failed);
    if (failed) throw RunError("{}: cannot be cut: {}", dump.string(), failed.message());
}

}  // namespace grainreel
