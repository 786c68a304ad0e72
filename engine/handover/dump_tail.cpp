#include "engine/handover/dump_tail.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <fstream>
#include <numeric>
#include <string_view>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/handover/decks.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kPiece = std::size_t{16} << 20;  // bytes read at once
constexpr std::int64_t kShortestRow = 24;              // characters: twelve numbers of one digit
// The columns of the dump that both decks ask for; next() takes the numbers in this order.
constexpr const char* kColumns = "ITEM: ATOMS id type radius x y z vx vy vz omegax omegay omegaz";
constexpr std::size_t kNumbers = 12;

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    return text;
}

bool whole_number(std::string_view text, std::int64_t& value) {
    text = without_blanks(text);
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    return end.ec == std::errc() && end.ptr == text.data() + text.size();
}

bool numbers_in(std::string_view row, double (&values)[kNumbers]) {
    for (double& value : values) {
        row = without_blanks(row);
        const std::size_t end = std::min(row.find(' '), row.size());
        const std::optional<double> number = number_in(row.substr(0, end));
        if (!number) return false;
        value = *number;
        row.remove_prefix(end);
    }
    return without_blanks(row).empty();
}

void sort_by_id(DumpRows& rows) {
    if (std::is_sorted(rows.id.begin(), rows.id.end())) return;
    std::vector<std::size_t> order(rows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return rows.id[a] < rows.id[b]; });
    const auto arrange = [&](auto& list) {
        auto sorted = list;
        for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = list[order[i]];
        list = std::move(sorted);
    };
    arrange(rows.type);
    arrange(rows.radius);
    arrange(rows.position);
    arrange(rows.velocity);
    arrange(rows.spin);
    arrange(rows.id);
}

}  // namespace

void DumpTail::wrong(std::int64_t line, const std::string& what) const {
    throw UserError(fmt::format("{}:{}: {}; the dump is to be that of the deck as it was written",
                                file_.string(), line, what));
}

bool DumpTail::is_shorter() const {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file_, error);
    return !error && size < place_;
}

void DumpTail::read_anew() {
    text_.clear();
    place_ = 0;
    line_ = 1;
}

// Reads more of the file. Returns whether there was more.
bool DumpTail::read_more() {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file_, error);
    if (error) return false;
    if (size < place_)
        throw RunError(
            fmt::format("{}: got shorter while it was read; it was truncated or replaced", file_.string()));
    if (size == place_) return false;
    std::ifstream file(file_, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(place_));
    const std::size_t before = text_.size();
    text_.resize(before + static_cast<std::size_t>(std::min<std::uintmax_t>(size - place_, kPiece)));
    file.read(text_.data() + before, static_cast<std::streamsize>(text_.size() - before));
    const auto got = static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount()));
    text_.resize(before + got);
    place_ += got;
    return got > 0;
}

// The line that begins at `at`, which moves to the next line; none while the line's end is missing.
std::optional<std::string> DumpTail::line(std::size_t& at, std::int64_t& number) const {
    const std::size_t end = text_.find('\n', at);
    if (end == std::string::npos) return std::nullopt;
    const std::string_view found = without_blanks(std::string_view(text_).substr(at, end - at));
    at = end + 1;
    ++number;
    return std::string(found);
}

std::optional<DumpRows> DumpTail::next() {
    while (true) {
        std::size_t at = 0;
        std::int64_t number = line_ - 1, rows = -1;
        DumpRows frame;
        bool whole = true;
        for (int k = 0; k < 9 && whole; ++k) {
            const std::optional<std::string> head = line(at, number);
            if (!(whole = head.has_value())) break;
            if (k == 0 && *head != "ITEM: TIMESTEP") wrong(number, "no frame begins here");
            if (k == 1 && !whole_number(*head, frame.step)) wrong(number, "is no step");
            if (k == 2 && *head != "ITEM: NUMBER OF ATOMS") wrong(number, "says no number of atoms");
            if (k == 3 && (!whole_number(*head, rows) || rows < 0)) wrong(number, "is no number of atoms");
            if (k == 8 && *head != kColumns) wrong(number, "has other columns");
        }
        // The rows are looked at only once the text is long enough to have them all.
        if (whole && static_cast<std::int64_t>(text_.size() - at) / kShortestRow >= rows) {
            const auto count = static_cast<std::size_t>(rows);
            for (std::vector<Vec3>* list : {&frame.position, &frame.velocity, &frame.spin})
                list->reserve(count);
            frame.id.reserve(count);
            for (std::int64_t row = 0; row < rows && whole; ++row) {
                const std::size_t end = text_.find('\n', at);
                if (!(whole = end != std::string::npos)) break;
                double v[kNumbers];
                ++number;
                if (!numbers_in(std::string_view(text_).substr(at, end - at), v))
                    wrong(number, "is no row of twelve finite numbers");
                at = end + 1;
                frame.id.push_back(static_cast<std::int64_t>(v[0]));
                frame.type.push_back(static_cast<int>(v[1]));
                frame.radius.push_back(v[2]);
                frame.position.emplace_back(v[3], v[4], v[5]);
                frame.velocity.emplace_back(v[6], v[7], v[8]);
                frame.spin.emplace_back(v[9], v[10], v[11]);
            }
            if (whole) {
                text_.erase(0, at);
                line_ = number + 1;
                sort_by_id(frame);
                return frame;
            }
        }
        if (!read_more()) return std::nullopt;
    }
}

namespace fs = std::filesystem;

std::optional<std::int64_t> newest_restart(const fs::path& folder, PeerEngine engine) {
    const std::string begin = restart_name(engine) + ".";
    std::optional<std::int64_t> newest;
    std::error_code missing;
    for (const fs::directory_entry& one : fs::directory_iterator(folder, missing)) {
        const std::string name = one.path().filename().string();
        if (!name.starts_with(begin)) continue;
        std::int64_t step = 0;
        const char* const end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + begin.size(), end, step);
        if (read.ec == std::errc() && read.ptr == end) newest = std::max(newest.value_or(0), step);
    }
    return newest;
}

void take_forced_restarts(const fs::path& folder, const fs::path& output) {
    bool whole = false;
    std::ifstream said(output);
    for (std::string line; !whole && std::getline(said, line);)
        whole = line.find(forced_words) != std::string::npos;
    std::vector<fs::path> forced;
    std::error_code missing;
    for (const fs::directory_entry& one : fs::directory_iterator(folder, missing))
        if (one.path().filename().string().starts_with(forced_begin)) forced.push_back(one.path());
    const std::string begin = forced_begin, end = forced_end;
    for (const fs::path& one : forced) {
        const std::string name = one.filename().string();
        if (whole && name.ends_with(end))
            fs::rename(
                one,
                folder / fmt::format("{}.{}", restart_name(PeerEngine::liggghts),
                                     name.substr(begin.size(), name.size() - begin.size() - end.size())),
                missing);
        else
            fs::remove(one, missing);
    }
}

void trim_dump(const fs::path& dump, std::int64_t step) {
    DumpTail tail(dump);
    std::uintmax_t kept = 0;
    while (const std::optional<DumpRows> rows = tail.next()) {
        if (rows->step > step) break;
        kept = tail.taken();
    }
    std::error_code failed;
    fs::resize_file(dump, kept, failed);
    if (failed) throw RunError(fmt::format("{}: cannot be cut: {}", dump.string(), failed.message()));
}

namespace {

constexpr double kSlack = 1.5;  // factor on the way in free fall, because other grains may push

}  // namespace

// Whether the grain can reach an exit in that time. Other grains push it, but not far.
bool GrainCount::may_leave(const Frame& before, std::size_t row, double seconds) const {
    const Vec3& at = before.position[row];
    const double way = before.velocity[row].norm() * seconds + scene_.gravity.norm() * seconds * seconds / 2;
    const double reach = kSlack * way + 4 * before.radius[row];
    const Container& container = scene_.container;
    if (container.outlet && !container.tray && at.z() + container.outlet->exit_depth <= reach) return true;
    for (const ExitBox& exit : scene_.exits) {
        const double inside = std::min((at - exit.low).minCoeff(), (exit.high - at).minCoeff());
        const double outside = (exit.low - at).cwiseMax(at - exit.high).cwiseMax(0).norm();
        if (exit.outside ? inside <= reach : outside <= reach) return true;
    }
    return false;
}

GrainCount::Change GrainCount::compare(const Frame* before, const Frame& now) const {
    Change change;
    if (before == nullptr) {
        const std::int64_t wanted = scene_.grains_at_start();
        if (static_cast<std::int64_t>(now.size()) < wanted)
            throw RunError(fmt::format("{}: step {}: has {}, but the scene begins with {}", file_, now.step,
                                       counted(now.size(), "grain"), wanted));
        return change;
    }
    std::size_t k = 0;
    for (std::size_t i = 0; i < before->size(); ++i) {
        while (k < now.size() && now.id[k] < before->id[i]) ++k, ++change.came;
        if (k < now.size() && now.id[k] == before->id[i]) {
            ++k;
            continue;
        }
        if (!may_leave(*before, i, now.time - before->time)) {
            const Vec3& at = before->position[i];
            throw RunError(
                fmt::format("{}: step {}: grain {} is missing; it was last at ({:.4g}, {:.4g}, {:.4g}) m "
                            "in step {}, where it could not leave: it broke through a wall, which is "
                            "too soft for its speed, or left the box of the run",
                            file_, now.step, before->id[i], at.x(), at.y(), at.z(), before->step));
        }
        change.left.push_back(i);
    }
    change.came += static_cast<std::int64_t>(now.size() - k);
    if (change.came > 0 && scene_.feeds.empty())
        throw RunError(
            fmt::format("{}: step {}: has {} grains that the frame before lacks, and the scene feeds "
                        "none; is it the dump of another run?",
                        file_, now.step, change.came));
    return change;
}

}  // namespace grainreel
