#include "engine/scene/motion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "engine/base/counted.hpp"
#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/rotation.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/mesh/load_mesh.hpp"

namespace grainreel {

namespace {

Quaternion quaternion_of(const Eigen::Vector4d& w_first) {
    return {w_first[0], w_first[1], w_first[2], w_first[3]};
}

// The spin of the spline's quaternion p, scaled to length 1. With n = norm(p): q = p / n, q' = (p' - q
// (q.p')) / n, and the spin is 2 q' q*.
Vec3 spin_of(const Eigen::Vector4d& raw, const Eigen::Vector4d& slope) {
    const double length = raw.norm();
    const Eigen::Vector4d unit = raw / length;
    const Eigen::Vector4d change = (slope - unit.dot(slope) * unit) / length;
    return 2 * (quaternion_of(change) * quaternion_of(unit).conjugate()).vec();
}

// The mesh stands still at its place in the scene until the run begins, so a path that begins elsewhere would
// make it jump.
void check_start(const MotionPath& path, const PathRows& rows, const std::filesystem::path& file) {
    constexpr double same = 1e-6;  // as a share of the path's size, and in rad
    const PathPose start = path.at(0);
    Vec3 low(0, 0, 0), high(0, 0, 0);
    for (const Vec3& place : rows.places) low = low.cwiseMin(place), high = high.cwiseMax(place);
    const Vec3 place = start.place - path.pivot() + start.rotation * path.pivot();
    const bool turned = rotation_vector(start.rotation).norm() > same;
    if (place.norm() <= same * (high - low).norm() && !turned) return;
    throw UserError(
        "{}: at 0 s the path is at ({:.6g}, {:.6g}, {:.6g}) m{}, but places count from where the mesh rests, "
        "and it rests until then; {}",
        file.string(), place.x(), place.y(), place.z(), turned ? ", turned" : "",
        turned
            ? "let the path begin at 0, 0, 0 with the quaternion 1, 0, 0, 0, and place the mesh by position "
              "and rotation"
            : "subtract that from all rows, and add it to the mesh's position");
}

}  // namespace

std::shared_ptr<const MotionPath> MotionPath::read(const std::filesystem::path& file, const Vec3& pivot) {
    const PathRows rows = read_path_rows(file);
    auto path = std::make_shared<MotionPath>();
    path->times_ = rows.times;
    path->pieces_ = natural_spline(rows.times, rows.places);
    if (!rows.turns.empty()) path->turns_ = natural_spline(rows.times, rows.turns);
    path->pivot_ = pivot;
    path->hash_ = hash_of_file(file);
    path->find_tops();
    check_start(*path, rows, file);
    return path;
}

MotionPath::Moment MotionPath::moment_at(double time) const {
    if (time < first()) return {0, 0, true};
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    if (after == times_.end()) return {pieces_.size() - 1, last() - times_[times_.size() - 2], time > last()};
    const auto piece = static_cast<std::size_t>(after - times_.begin()) - 1;
    return {piece, time - times_[piece], false};
}

// The pivot moves along the path, and the rest of the body turns about it.
PathPose MotionPath::at(double time) const {
    const Moment moment = moment_at(time);
    const CubicPiece<Vec3>& piece = pieces_[moment.piece];
    PathPose pose;
    pose.place = piece.value(moment.since);
    if (!moment.still) pose.velocity = piece.slope(moment.since);
    if (turns_.empty()) return pose;
    const CubicPiece<Eigen::Vector4d>& turning = turns_[moment.piece];
    const Eigen::Vector4d raw = turning.value(moment.since);
    pose.rotation = quaternion_of(raw.normalized());
    if (!moment.still) pose.spin = spin_of(raw, turning.slope(moment.since));
    const Vec3 arm = pose.rotation * pivot_;
    pose.place += pivot_ - arm;
    pose.velocity -= pose.spin.cross(arm);
    return pose;
}

void MotionPath::find_tops() {
    constexpr int kTimes = 16;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const double width = times_[i + 1] - times_[i];
        for (int k = 0; k <= kTimes; ++k) {
            const double since = width * k / kTimes;
            top_speed_ = std::max(top_speed_, pieces_[i].slope(since).norm());
            if (!turns_.empty())
                top_spin_ =
                    std::max(top_spin_, spin_of(turns_[i].value(since), turns_[i].slope(since)).norm());
        }
    }
}

namespace {

constexpr std::size_t fewest_rows = 4;
constexpr double off_unit = 0.01;  // by which the length of a quaternion may differ from 1 through rounding

// The columns of a path's file, each with the names that the file may give it.
enum Column { of_time, of_x, of_y, of_z, of_qw, of_qx, of_qy, of_qz, columns };
const std::array<std::vector<std::string_view>, columns> column_names{
    {{"time_s", "t", "time"}, {"x_m", "x"}, {"y_m", "y"}, {"z_m", "z"}, {"qw"}, {"qx"}, {"qy"}, {"qz"}}};

class PathReader {
  public:
    PathReader(std::istream& text, const std::filesystem::path& file)
        : file_(file), table_(text, file, {.quotes = true, .remarks = "#"}) {
        if (table_.next()) take_header();
        while (table_.next()) take_row();
        check_whole();
    }

    PathRows rows;

  private:
    [[noreturn]] void fail_at(std::int64_t line, const std::string& what) const {
        refuse_line(file_, line, what);
    }

    void take_header() {
        header_ = table_.line();
        const std::vector<CsvCell>& cells = table_.cells();
        width_ = cells.size();
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const auto found = std::find_if(column_names.begin(), column_names.end(), [&](const auto& names) {
                return contains(names, cells[c].text);
            });
            if (found == column_names.end())
                table_.fail(
                    fmt::format("the column \"{}\" means nothing in a path; the first line must name its "
                                "columns: time_s, x_m, y_m, z_m and, if it turns, qw, qx, qy, qz",
                                excerpt(cells[c].text)));
            const auto column = static_cast<std::size_t>(found - column_names.begin());
            if (at_[column] >= 0)
                table_.fail(fmt::format("there are two columns \"{}\"; take one out", cells[c].text));
            at_[column] = static_cast<int>(c);
        }
        turns_ = std::any_of(at_.begin() + of_qw, at_.end(), [](int at) { return at >= 0; });
        for (std::size_t column = 0; column < (turns_ ? columns : of_qw); ++column)
            if (at_[column] < 0)
                table_.fail(
                    fmt::format("lacks the column \"{}\"; a path has time_s, x_m, y_m, z_m and, if it "
                                "turns, qw, qx, qy, qz",
                                column_names[column].front()));
    }

    double number(Column column) const {
        const std::string_view cell = table_.cells()[at_[column]].text;
        const std::optional<double> value = number_in(cell);
        if (!value)
            table_.fail(
                fmt::format("\"{}\" in the column {} is no finite number; correct it or remove the row",
                            excerpt(cell), column_names[column].front()));
        return *value;
    }

    void take_row() {
        const std::size_t cells = table_.cells().size();
        if (cells != width_)
            table_.fail(fmt::format("has {}, but line {} names {} columns; is the file cut off?",
                                    counted(cells, "value"), header_, width_));
        const double time = number(of_time);
        if (!rows.times.empty() && !(time > rows.times.back()))
            table_.fail(
                fmt::format("the time is {:.9g} s, not later than {:.9g} s in line {}; sort the rows, and "
                            "remove those of equal times",
                            time, rows.times.back(), rows.lines.back()));
        rows.lines.push_back(table_.line());
        rows.times.push_back(time);
        rows.places.emplace_back(number(of_x), number(of_y), number(of_z));
        if (turns_) take_turn();
    }

    // q and -q are the same rotation; the one nearer to the row before is taken.
    void take_turn() {
        Eigen::Vector4d turn(number(of_qw), number(of_qx), number(of_qy), number(of_qz));
        const double length = turn.norm();
        if (std::abs(length - 1) > off_unit)
            table_.fail(
                fmt::format("qw, qx, qy, qz have the length {:.6g}, and a rotation has 1; write 1, 0, 0, 0 "
                            "for none",
                            length));
        turn /= length;
        if (!rows.turns.empty() && turn.dot(rows.turns.back()) < 0) turn = -turn;
        rows.turns.push_back(turn);
    }

    void check_whole() const {
        if (header_ == 0) fail_at(1, "is empty; write time_s, x_m, y_m, z_m, and rows below");
        if (rows.times.size() < fewest_rows)
            table_.fail(fmt::format("the path ends after {} rows, and {} are the fewest; add rows",
                                    rows.times.size(), fewest_rows));
        if (rows.times.front() > 0)
            fail_at(rows.lines.front(),
                    fmt::format("the path begins at {:.6g} s, but the run begins at 0 s; add a row of time 0",
                                rows.times.front()));
        check_places();
        check_turns();
    }

    double step(std::size_t i) const { return (rows.places[i + 1] - rows.places[i]).norm(); }
    double speed(std::size_t i) const { return step(i) / (rows.times[i + 1] - rows.times[i]); }

    [[noreturn]] void fail_for_jump(std::size_t to) const {
        fail_at(
            rows.lines[to],
            fmt::format("the path jumps by {:.4g} m within {:.4g} s, more than 20 times as fast as before "
                        "and after; correct the row, or add rows in between where that is meant",
                        step(to - 1), rows.times[to] - rows.times[to - 1]));
    }

    // Refuses jumps. In a well sampled motion no single step is so much faster than its neighbours.
    void check_places() const {
        constexpr double share = 0.05, faster = 20;
        const std::size_t steps = rows.places.size() - 1;
        Vec3 low = rows.places.front(), high = low;
        for (const Vec3& place : rows.places) low = low.cwiseMin(place), high = high.cwiseMax(place);
        const double size = (high - low).norm();
        // The speed of the step before `first` or of the step after `last`, whichever is faster.
        const auto beside = [&](std::size_t first, std::size_t last) {
            return std::max(first > 0 ? speed(first - 1) : 0.0, last + 1 < steps ? speed(last + 1) : 0.0);
        };
        constexpr std::size_t enough = 8;  // rows; shorter files were written by hand, and each row is meant
        if (rows.places.size() < enough) return;
        for (std::size_t i = 0; i < steps; ++i) {
            if (step(i) <= share * size) continue;
            if (speed(i) > faster * beside(i, i)) fail_for_jump(i + 1);
            if (i + 1 == steps || step(i + 1) <= share * size) continue;
            const double back = (rows.places[i + 2] - rows.places[i]).norm();
            if (back < 0.2 * step(i) && std::min(speed(i), speed(i + 1)) > faster * beside(i, i + 1))
                fail_for_jump(i + 1);
        }
    }

    void check_turns() const {
        constexpr double most = 2;  // rad, from row to row
        for (std::size_t i = 1; i < rows.turns.size(); ++i) {
            const double angle = 2 * math::acos(std::min(1.0, rows.turns[i].dot(rows.turns[i - 1])));
            if (angle > most)
                fail_at(rows.lines[i],
                        fmt::format("the path turns by {:.4g} rad since line {}, which might go either way "
                                    "round; add rows in between",
                                    angle, rows.lines[i - 1]));
        }
    }

    const std::filesystem::path& file_;
    CsvRows table_;
    std::int64_t header_ = 0;  // number of the line that names the columns
    std::size_t width_ = 0;
    std::array<int, columns> at_{-1, -1, -1, -1, -1, -1, -1, -1};
    bool turns_ = false;
};

}  // namespace

PathRows read_path_rows(const std::filesystem::path& file) {
    if (const std::string other = other_than_file(file, true); !other.empty())
        throw UserError("{}: is {}, not a path's file (.csv)", file.string(), other);
    std::ifstream text = read_plain(file);
    if (!text)
        throw UserError("{}: there is no such file, or it cannot be read; give a path's file (.csv)",
                        file.string());
    return std::move(PathReader(text, file).rows);
}

namespace {

// The share (0 to 1) that a smooth rise of `over` seconds, starting at `begin`, has reached at `time`; and
// the integral of this share over time (s).
double share_at(double begin, double over, double time) {
    if (time < begin) return 0;
    return over > 0 ? smooth_step::value(std::min(1.0, (time - begin) / over)) : 1;
}
double integral_at(double begin, double over, double time) {
    const double passed = std::max(0.0, time - begin);
    if (passed >= over) return passed - 0.5 * over;
    return over * smooth_step::area(passed / over);
}

}  // namespace

double BodyTurn::rate_at(double time) const {
    return rate * (share_at(from, over, time) - share_at(until, over, time));
}

double BodyTurn::angle_at(double time) const {
    return rate * (integral_at(from, over, time) - integral_at(until, over, time));
}

}  // namespace grainreel
