#include "engine/handover/handed_grains.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {

namespace {

constexpr double kShown = 1e-8;  // dumps have nine digits

// The numbers of a row, as many as there must be.
std::vector<double> numbers_of(const std::string& line, std::size_t count, const std::string& place) {
    std::vector<double> numbers;
    WordReader words(line);
    for (std::string_view word = words.next_in_line(); !word.empty(); word = words.next_in_line())
        if (const std::optional<double> number = number_in(word)) numbers.push_back(*number);
    if (numbers.size() != count)
        throw UserError("{}: is no row of {} numbers; hand the scene over again", place, count);
    return numbers;
}

bool same(double a, double b) {
    return std::abs(a - b) <= kShown * std::max(std::abs(a), std::abs(b));
}

bool same(const Vec3& a, const Vec3& b, double slack) {
    return (a - b).norm() <= kShown * (a.norm() + b.norm()) + slack;
}

std::string text_of(const Vec3& v) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z());
}

}  // namespace

HandedGrains::HandedGrains(const std::filesystem::path& data, std::string dump)
    : dump_(std::move(dump)), data_(data.string()) {
    if (is_plain(data)) read(data);
}

void HandedGrains::read(const std::filesystem::path& data) {
    std::ifstream in = read_plain(data);
    enum class Part { head, atoms, velocities } part = Part::head;
    std::size_t moving = 0;
    std::string line;
    for (std::int64_t number = 1; std::getline(in, line); ++number) {
        if (line.empty()) continue;
        const std::string place = fmt::format("{}:{}", data_, number);
        if (line == "Atoms") {
            part = Part::atoms;
        } else if (line == "Velocities") {
            part = Part::velocities;
        } else if (part == Part::atoms) {
            const std::vector<double> n = numbers_of(line, 7, place);
            grains_.push_back({.id = std::llround(n[0]),
                               .species = static_cast<std::int32_t>(std::lround(n[1]) - 1),
                               .radius = n[2] / 2,
                               .position = Vec3(n[4], n[5], n[6])});
        } else if (part == Part::velocities) {
            const std::vector<double> n = numbers_of(line, 7, place);
            if (moving == grains_.size() || grains_[moving].id != std::llround(n[0]))
                throw UserError(
                    "{}: is of atom {:.0f}, and its place is not in this order; hand "
                    "the scene over again",
                    place, n[0]);
            grains_[moving].velocity = Vec3(n[1], n[2], n[3]);
            grains_[moving++].spin = Vec3(n[4], n[5], n[6]);
        }
    }
    std::sort(grains_.begin(), grains_.end(), [](const Grain& a, const Grain& b) { return a.id < b.id; });
}

void HandedGrains::refuse(const State& first, std::size_t row, const std::string& what) const {
    throw UserError("{}: step {}: atom {} has {}; is it the dump of another run?", dump_, first.step,
                    first.id[row], what);
}

void HandedGrains::check_first(const State& first, double period) const {
    for (std::size_t row = 0; row < first.size(); ++row) {
        const auto grain = std::lower_bound(grains_.begin(), grains_.end(), std::int64_t{first.id[row]},
                                            [](const Grain& one, std::int64_t id) { return one.id < id; });
        if (grain == grains_.end() || grain->id != first.id[row]) continue;  // it was fed
        if (grain->species != first.species[row])
            refuse(first, row,
                   fmt::format("type {}, and type {} in {}", std::int64_t{first.species[row]} + 1,
                               std::int64_t{grain->species} + 1, data_));
        if (!same(grain->radius, first.radius[row]))
            refuse(first, row,
                   fmt::format("radius {:.6g}, and {:.6g} in {}", first.radius[row], grain->radius, data_));
        if (first.step == 0) check_moving(first, row, *grain, period);
    }
}

void HandedGrains::check_moving(const State& first, std::size_t row, const Grain& grain,
                                double period) const {
    Vec3 position = first.position[row];
    if (period > 0) position.x() -= period * std::round((position.x() - grain.position.x()) / period);
    const double radius = grain.radius;
    if (!same(position, grain.position, kShown * (radius + std::abs(period))))
        refuse(first, row,
               fmt::format("the place {} m, and {} in {}", text_of(first.position[row]),
                           text_of(grain.position), data_));
    constexpr double least_speed = 1e-12;  // m/s, at the grain's surface too
    if (!same(first.velocity[row], grain.velocity, least_speed))
        refuse(first, row,
               fmt::format("the velocity {} m/s, and {} in {}", text_of(first.velocity[row]),
                           text_of(grain.velocity), data_));
    if (!same(first.spin[row], grain.spin, least_speed / radius))
        refuse(first, row,
               fmt::format("the spin {} rad/s, and {} in {}", text_of(first.spin[row]), text_of(grain.spin),
                           data_));
}

void check_unchanged(const State& before, const State& now, const std::string& dump) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        while (k < before.size() && before.id[k] < now.id[i]) ++k;
        if (k == before.size() || before.id[k] != now.id[i]) continue;
        if (now.species[i] != before.species[k])
            throw RunError(
                "{}: step {}: grain {} has type {}, and had type {} in step {}; grains keep "
                "their type, so the dump is damaged or of several runs",
                dump, now.step, now.id[i], std::int64_t{now.species[i]} + 1,
                std::int64_t{before.species[k]} + 1, before.step);
        if (!same(now.radius[i], before.radius[k]))
            throw RunError(
                "{}: step {}: grain {} has radius {:.6g}, and had {:.6g} in step {}; grains "
                "keep their radius, so the dump is damaged or of several runs",
                dump, now.step, now.id[i], now.radius[i], before.radius[k], before.step);
    }
}

}  // namespace grainreel
