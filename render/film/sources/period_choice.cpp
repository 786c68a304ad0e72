#include "render/film/sources/period_choice.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/numbers.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/scene/bed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

PeriodChoice::PeriodChoice(const FilmedScene& scene, const Clock& clock, const std::vector<Due>& shots,
                           const std::vector<FilmSegment>& segments, bool may_leave_out)
    : clock_(clock),
      wanted_(scene.film.periods),
      may_leave_out_(may_leave_out),
      diameter_(mean_diameter(scene)) {
    for (const Due& shot : shots) first_.emplace(shot.segment, shot.step);
    for (const auto& [number, step] : first_) {
        const FilmSegment& segment = segments.at(static_cast<std::size_t>(number));
        locks_ = locks_ || segment.kind == FilmSegment::Kind::locked;
        means_ = means_ || segment.average > 0;
    }
    means_ = means_ || (!shots.empty() && needs_displacement(scene.film.shows));
}

void PeriodChoice::note(std::int64_t step, int periods, double difference) {
    if (periods == found_ || periods < 1) return;
    found_ = periods;
    const bool as_wanted = wanted_ > 0 && wanted_ % found_ == 0;
    if (!as_wanted) news_.push_back(news_of(step, difference));
}

std::vector<int> PeriodChoice::possible() const {
    if (wanted_ > 0) return {wanted_};
    std::vector<int> all{1};
    for (int periods = 2; periods <= PeriodMultiple::kMost && clock_.steps_per_period > 0; ++periods)
        all.push_back(periods);
    return all;
}

bool PeriodChoice::shows(const FilmSegment& rule, const Due& shot) const {
    if (!may_leave_out_ || rule.kind != FilmSegment::Kind::locked || clock_.steps_per_period == 0)
        return true;
    const std::int64_t periods =
        std::llround(clock_.cycles(shot.step) - clock_.cycles(first_.at(shot.segment)));
    return periods % spanning(rule, shown()).every == 0;
}

std::string PeriodChoice::news_of(std::int64_t step, double difference) const {
    const int periods = found_;
    const double time = clock_.time(step);
    if (periods == 1)
        return fmt::format("from {:.3g} s on the bed repeats itself every period of the drive again", time);
    std::string text = fmt::format(
        "from {:.3g} s on the bed repeats itself only every {} periods of the drive (from one period to the "
        "next its centre of mass differs by {:.2g} grain diameters)",
        time, periods, difference / diameter_);
    // Names the parts of the film that depend on the bed's periods; the other parts do not change.
    const std::string means = means_ ? "displacements and means" : "";
    if (!locks_ && !means_) return text;
    if (wanted_ == 0 && !may_leave_out_) {
        if (means_) text += fmt::format("; {} go by {} periods", means, periods);
        if (locks_)
            text += fmt::format("{} locked frames jump; with every = 2 or 4 they may not",
                                means_ ? ", but" : ";");
        return text;
    }
    if (wanted_ == 0)
        return text + fmt::format("; {}{}{} go by {} periods; film.periods = 1 lets them go by one",
                                  locks_ ? "locked frames" : "", locks_ && means_ ? ", " : "", means,
                                  periods);
    return text + fmt::format(", but film.periods is {}: {}{}{}", wanted_, locks_ ? "locked frames jump" : "",
                              locks_ && means_ ? ", and " : "",
                              means_ ? means + " show the bed's flight" : "");
}

MeasuredPeriods::MeasuredPeriods(const MeasureTable& table) {
    const std::vector<double> steps = table.all("step"), periods = table.all("bed_periods"),
                              differences = table.all("period_difference_m");
    if (periods.size() != steps.size() || differences.size() != steps.size()) return;
    for (std::size_t k = 0; k < steps.size(); ++k)
        rows_.push_back({steps[k], static_cast<int>(periods[k]), differences[k]});
}

int MeasuredPeriods::at(std::int64_t step) const {
    const auto after = std::upper_bound(rows_.begin(), rows_.end(), static_cast<double>(step),
                                        [](double wanted, const Row& row) { return wanted < row.step; });
    return after == rows_.begin() ? 1 : std::max(1, std::prev(after)->periods);
}

namespace {

// The displacement from `from` to `to`, the short way round a periodic container.
Vec3 way(const Vec3& from, const Vec3& to, double depth) {
    Vec3 between = to - from;
    between.x() = nearest_image(between.x(), depth);
    return between;
}

}  // namespace

void set_mean(State& frame, const std::vector<StatePtr>& moments, double span, double depth) {
    const bool same_bodies = std::all_of(moments.begin(), moments.end(), [&](const StatePtr& then) {
        return then->bodies.size() == frame.bodies.size();
    });
    if (!same_bodies) return;
    const std::vector<Vec3> now = frame.position;
    std::vector<Vec3> ways(frame.size(), Vec3::Zero());
    std::vector<bool> throughout(frame.size(), true);
    std::vector<Vec3> places(frame.bodies.size(), Vec3::Zero());
    for (std::size_t k = 1; k < moments.size(); ++k) {
        const State& then = *moments[k];
        const std::vector<std::size_t> rows = rows_in(then, frame);
        for (std::size_t i = 0; i < ways.size(); ++i) {
            if (rows[i] == kNoRow)
                throughout[i] = false;
            else
                ways[i] += way(now[i], then.position[rows[i]], depth);
        }
        for (std::size_t b = 0; b < places.size(); ++b) places[b] += then.bodies[b].place;
    }
    const State& before = *moments.front();
    const double share = 1 / static_cast<double>(moments.size() - 1);
    const std::vector<std::size_t> first = rows_in(before, frame);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        if (!throughout[i] || first[i] == kNoRow) continue;
        frame.position[i] = now[i] + share * ways[i];
        frame.position[i].x() = nearest_image(frame.position[i].x(), depth);
        frame.velocity[i] = way(before.position[first[i]], now[i], depth) / span;
    }
    for (std::size_t b = 0; b < places.size(); ++b) {
        frame.bodies[b].velocity = (frame.bodies[b].place - before.bodies[b].place) / span;
        frame.bodies[b].place = share * places[b];
    }
}

void set_on_way(State& frame, const State& before, double share, double depth) {
    if (before.bodies.size() != frame.bodies.size()) return;
    const std::vector<std::size_t> rows = rows_in(before, frame);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i] == kNoRow) continue;
        const Vec3 back = way(frame.position[i], before.position[rows[i]], depth);
        frame.position[i] += (1 - share) * back;
        frame.position[i].x() = nearest_image(frame.position[i].x(), depth);
    }
    for (std::size_t b = 0; b < frame.bodies.size(); ++b)
        frame.bodies[b].place += (1 - share) * (before.bodies[b].place - frame.bodies[b].place);
}

}  // namespace grainreel
