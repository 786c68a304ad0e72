// The frames of another program's run: its moments and its grains in SI. The files are chosen in
// foreign_files.cpp, what they hold is found out in foreign_survey.cpp, and walls are followed in
// foreign_walls.cpp.
#include "engine/files/foreign/foreign_archive.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/foreign/names.hpp"

namespace grainreel {

namespace fs = std::filesystem;

ForeignArchive::ForeignArchive(const fs::path& path, const ReadingOptions& options, Looks looks)
    : path_(path), options_(options), looks_(looks) {
    choose_files();
    for (std::string& line : grains_->news()) news_.push_back(std::move(line));
    list_moments();
    survey();
    read_walls();
    make_world();
    match_walls();
    name_walls();
    decide_velocities();
}

bool ForeignArchive::grow() {
    behind_ = grains_->grow(files_now(grains_->files())) || behind_;
    if (contacts_)
        behind_ =
            contacts_->grow(options_.contacts.empty() ? files_now(contacts_->files()) : contact_files()) ||
            behind_;
    if (!behind_) return false;
    const std::vector<std::string> news = news_;  // what was told once is not told again
    const bool had_contacts = has_contacts_, had_pairs = moments_.size() > 1;
    for (auto& frame : last_) frame.reset();
    list_moments();
    count_grains();
    survey_contacts();
    if (has_contacts_ && !had_contacts) check_contact_columns();
    if (options_.walls.empty())
        for (std::vector<fs::path>& files : wall_files_) files = files_now(files);
    else
        find_walls();
    if (walls_come()) read_walls();
    match_walls();
    name_walls();
    if (!had_pairs) decide_velocities();
    news_ = news;
    behind_ = false;
    return true;
}

namespace {

// Throws UserError where the times that a length of a step (s) gives could be those of no run.
void check_time_step(double step, const std::vector<double>& times) {
    constexpr double shortest = 1e-20, longest = 1e9;  // s
    double last = 0;
    for (const double time : times) last = std::max(last, std::abs(time));
    if (step < shortest || last > longest)
        throw UserError(
            "--time-step {:g}: gives times up to {:.3g} s; a step is {:g} s at least, and "
            "times are {:g} s at most",
            step, last, shortest, longest);
}

}  // namespace

// Makes the moments, in each of which the time is the step times a constant length. If the files' steps and
// times do not fit this, steps are counted in ticks of a millionth of the shortest interval.
void ForeignArchive::list_moments() {
    moments_.clear();
    raw_steps_.clear();
    const std::vector<RawMoment>& raw = grains_->moments();
    const UnitSystem units = [&] {
        UnitSystem system;
        const std::string name = options_.units.empty() ? grains_->facts().units : options_.units;
        if (const auto known = unit_system(name)) system = *known;
        if (options_.units.empty() && grains_->facts().time_unit) system.time = *grains_->facts().time_unit;
        return system;
    }();
    const auto all = [&](auto member) {
        return std::all_of(raw.begin(), raw.end(),
                           [&](const RawMoment& one) { return (one.*member).has_value(); });
    };
    const bool timed = all(&RawMoment::time), stepped = all(&RawMoment::step);
    std::vector<double> times;
    for (std::size_t k = 0; k < raw.size(); ++k) {
        const double step = stepped ? static_cast<double>(*raw[k].step) : static_cast<double>(k);
        times.push_back(timed                ? *raw[k].time * units.time
                        : options_.time_step ? step * *options_.time_step
                                             : step);
        raw_steps_.push_back(stepped ? *raw[k].step : static_cast<std::int64_t>(k));
    }
    world_.time_known = timed || options_.time_step.has_value();
    check_clock(timed ? times : std::vector<double>());
    if (options_.time_step && !timed) check_time_step(*options_.time_step, times);
    if (options_.time_step && timed)
        news_.push_back(
            fmt::format("{}: says its times, so --time-step has no effect; leave it out", path_.string()));
    world_.steps_known = stepped;
    std::vector<double> intervals;
    for (std::size_t k = 1; k < times.size(); ++k) intervals.push_back(times[k] - times[k - 1]);
    if (!world_.time_known) {
        std::vector<double> sorted = intervals;
        std::sort(sorted.begin(), sorted.end());
        const double median =
            sorted.empty() || !(sorted[sorted.size() / 2] > 0) ? 1 : sorted[sorted.size() / 2];
        // With a single frame there is no interval.
        for (double& time : times) time = times.size() == 1 ? 0 : time / (median * kUntimedRate);
        for (double& interval : intervals) interval /= median * kUntimedRate;
        news_.push_back(fmt::format("{}: says no times; its frames are taken as {} a second{}",
                                    path_.string(), kUntimedRate,
                                    stepped ? "; --time-step 1e-6 (s) gives them" : ""));
    }
    // Do all moments have steps of the same length?
    double tick = 0;
    bool even = stepped;
    for (std::size_t k = 0; k < times.size(); ++k)
        if (raw_steps_[k] != 0) tick = times[k] / static_cast<double>(raw_steps_[k]);
    for (std::size_t k = 0; k < times.size(); ++k)
        even = even &&
               std::abs(times[k] - static_cast<double>(raw_steps_[k]) * tick) <= 1e-9 * std::abs(times[k]);
    if (times.size() == 1 && !world_.time_known) {
        State& moment = moments_.emplace_back();
        moment.step = raw_steps_.front();
        return;
    }
    if (!even || !(tick > 0)) {
        double shortest = std::numeric_limits<double>::infinity();
        for (const double interval : intervals)
            if (interval > 0) shortest = std::min(shortest, interval);
        tick = std::isfinite(shortest) ? 1e-6 * shortest : 1e-6;
        even = false;
    }
    for (std::size_t k = 0; k < times.size(); ++k) {
        State moment;
        moment.step = even ? raw_steps_[k] : std::llround(times[k] / tick);
        moment.time = static_cast<double>(moment.step) * tick;
        moments_.push_back(moment);
    }
    for (std::size_t k = 1; k < moments_.size(); ++k)
        if (moments_[k].time < moments_[k - 1].time)
            throw UserError("{}: its time falls from {:.6g} to {:.6g} s; is it of two runs?",
                            grains_->place(k), moments_[k - 1].time, moments_[k].time);
}

// Refuses steps and times (s) that no run reaches, because a damaged file has them.
void ForeignArchive::check_clock(const std::vector<double>& times) const {
    constexpr std::int64_t most_steps = 9'000'000'000'000'000;  // whole numbers that a double holds
    for (std::size_t k = 0; k < raw_steps_.size(); ++k)
        if (raw_steps_[k] <= -most_steps || raw_steps_[k] >= most_steps)
            throw UserError("{}: has the step {}, which no run reaches; is the file damaged?",
                            grains_->place(k), raw_steps_[k]);
    for (std::size_t k = 0; k < times.size(); ++k)
        if (!(std::abs(times[k]) <= kLongestTime))
            throw UserError("{}: has the time {:.6g} s, which no run reaches; is the file damaged?",
                            grains_->place(k), times[k]);
}

const RawFrame& ForeignArchive::raw(std::size_t index) const {
    auto& slot = last_[derived_ ? index % last_.size() : 0];
    if (!slot || slot->first != index) {
        slot.reset();  // so that two frames need not fit into memory
        slot.emplace(index, grains_->read(index));
    }
    return slot->second;
}

bool ForeignArchive::take_types(std::size_t index) {
    const std::size_t had = types_.words().size();
    const std::size_t first = derived_ && index > 0 ? index - 1 : index;
    const std::size_t last = derived_ ? std::min(index + 1, moments_.size() - 1) : index;
    for (std::size_t k = first; k <= last; ++k)
        if (const RawFrame& frame = raw(k); frame.grains.rows > 0) meaning_->add_types(frame, types_);
    const bool more = types_.words().size() > had;
    if (more) make_species();
    return more;
}

std::optional<std::int64_t> ForeignArchive::written_step(std::size_t index) const {
    if (!world_.steps_known) return std::nullopt;
    return raw_steps_.at(index);
}

State ForeignArchive::read(std::size_t index) const {
    Gaps gaps;
    State frame = meaning_->frame(raw(index), types_, grains_->place(index), gaps);
    keep_gaps(index, gaps);
    for (std::size_t i = 0; i < frame.mass.size(); ++i)
        if (std::isnan(frame.mass[i])) frame.mass[i] = usual_mass(frame, i);
    const State& moment = moments_.at(index);
    frame.step = moment.step;
    frame.time = moment.time;
    frame.bodies = moment.bodies;
    return frame;
}

// The mass of a grain with the density of its species.
double ForeignArchive::usual_mass(const State& frame, std::size_t grain) const {
    const double density = world_.species.at(static_cast<std::size_t>(frame.species[grain])).density;
    State sphere;
    sphere.radius = {frame.radius[grain]};
    return mass_of(sphere, 0, std::isfinite(density) ? density : kGlassDensity);
}

void ForeignArchive::keep_gaps(std::size_t index, const Gaps& gaps) const {
    if (gaps.any()) gaps_[index] = gaps;
}

State ForeignArchive::grains(std::size_t index) const {
    State frame = read(index);
    if (!derived_) return frame;
    derive_velocities(index, frame);
    Gaps gaps;
    if (const auto known = gaps_.find(index); known != gaps_.end()) gaps = known->second;
    gaps.velocities = std::count_if(frame.velocity.begin(), frame.velocity.end(),
                                    [](const Vec3& velocity) { return velocity.hasNaN(); });
    keep_gaps(index, gaps);
    return frame;
}

bool ForeignArchive::keeps_steps() const {
    for (std::size_t k = 0; k < moments_.size(); ++k)
        if (written_step(k) != moments_[k].step) return false;
    return true;
}

bool ForeignArchive::has_contacts_of(std::size_t index) const {
    if (!has_contacts_) return false;
    return contacts_ ? contacts_at_.contains(raw_steps_.at(index)) : grains_->moments()[index].has_contacts;
}

std::optional<std::vector<Link>> ForeignArchive::touches(std::size_t index) const {
    if (!has_contacts_of(index)) return std::nullopt;
    const auto read = [&](const RawFrame& frame, const std::string& place) {
        std::optional<std::vector<Link>> all = touches_of(frame, options_, meaning_->units(), place);
        if (all) contacts_passed_over_ += frame.contacts.rows - all->size();
        if (all && rows_of_contacts_from_0_)
            for (Link& link : *all) {
                ++link.first;
                link.second += link.second >= 0 ? 1 : 0;
            }
        return all;
    };
    if (!contacts_) return read(raw(index), grains_->place(index));
    const std::size_t moment = contacts_at_.at(raw_steps_.at(index));
    return read(contacts_->read(moment), contacts_->place(moment));
}

std::vector<std::string> ForeignArchive::news_of_frames() const {
    Gaps all;
    std::string first;  // where the first grain is
    for (const auto& [index, gaps] : gaps_) {
        if (all.first < 0 && gaps.first >= 0) first = grains_->place(index);
        all.add(gaps);
    }
    return all.words(path_.string(), first);
}

StateSupply ForeignArchive::supply() const {
    StateSupply supply;
    supply.velocities = meaning_->has_velocities() || derived_;
    supply.spins = meaning_->has_spins();
    supply.masses = meaning_->has_masses();
    supply.orientations = meaning_->has_orientations();
    supply.shapes = meaning_->has_shapes();
    supply.contacts = has_contacts_;
    return supply;
}

namespace {

// The displacement of a grain between two frames; in a periodic box the shortest one.
Vec3 way(const Vec3& from, const Vec3& to, const std::optional<WorldCell>& cell) {
    Vec3 between = to - from;
    if (!cell) return between;
    for (std::size_t edge = 3; edge-- > 0;) {
        const double length = cell->edges[edge].norm();
        if (!cell->periodic[edge] || !(length > 0)) continue;
        const auto axis = static_cast<Eigen::Index>(edge);
        const double turns = std::round(between[axis] / cell->edges[edge][axis]);
        if (std::isfinite(turns)) between -= turns * cell->edges[edge];
    }
    return between;
}

}  // namespace

// Velocities are computed if nearly all grains move less than their diameter from one moment to the next.
void ForeignArchive::decide_velocities() {
    if (meaning_->has_velocities() || !world_.time_known || !meaning_->has_ids() || moments_.size() < 2)
        return;
    const std::size_t middle = (moments_.size() - 1) / 2;
    take_types(middle);
    const State before = read(middle);
    take_types(middle + 1);
    const State after = read(middle + 1);
    constexpr double fastest = 1e6;  // m/s; a run's files hold no larger speeds
    const double interval = after.time - before.time;
    const std::optional<WorldCell> box = cell(middle + 1);
    std::size_t near = 0, both = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const std::optional<std::size_t> row = after.row_of(before.id[i]);
        if (!row) continue;
        ++both;
        const double moved = way(before.position[i], after.position[*row], box).norm();
        near += moved < 2 * before.radius[i];
        if (options_.time_step && interval > 0 && moved / interval > fastest)
            throw UserError("--time-step {:g}: with it, grain {} moves at {:.3g} m/s; give a longer one",
                            *options_.time_step, before.id[i], moved / interval);
    }
    derived_ = both > 0 && static_cast<double>(near) >= 0.95 * static_cast<double>(both);
    news_.push_back(
        derived_ ? fmt::format("{}: says no velocities; they come from the places of neighbouring frames",
                               path_.string())
                 : fmt::format("{}: says no velocities, and its frames are too far apart for them; what "
                               "needs them is left out",
                               path_.string()));
}

// Velocities by central differences. At the first and last moment of a grain, one neighbour is used.
void ForeignArchive::derive_velocities(std::size_t index, State& frame) const {
    const bool has_before = index > 0, has_after = index + 1 < moments_.size();
    const State before = has_before ? read(index - 1) : State(),
                after = has_after ? read(index + 1) : State();
    const std::optional<WorldCell> box = cell(index);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const std::optional<std::size_t> was = before.row_of(frame.id[i]), will = after.row_of(frame.id[i]);
        Vec3 ways(0, 0, 0);
        double time = 0;
        if (was) {
            ways += way(before.position[*was], frame.position[i], box);
            time += frame.time - before.time;
        }
        if (will) {
            ways += way(frame.position[i], after.position[*will], box);
            time += after.time - frame.time;
        }
        const bool known = time > 0 && ways.norm() < 4 * frame.radius[i];
        frame.velocity[i] = known ? Vec3(ways / time) : Vec3::Constant(kUnknown);
    }
}

}  // namespace grainreel
