// The frames of another program's run: its moments, its world and its grains in SI. The files are chosen in
// foreign_files.cpp, and walls are followed in foreign_walls.cpp.
#include "engine/files/foreign/foreign_archive.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

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
            fmt::format("--time-step {:g}: gives times up to {:.3g} s; a step is {:g} s at least, and "
                        "times are {:g} s at most",
                        step, last, shortest, longest));
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
            throw UserError(fmt::format("{}: its time falls from {:.6g} to {:.6g} s; is it of two runs?",
                                        grains_->place(k), moments_[k - 1].time, moments_[k].time));
}

// Refuses steps and times (s) that no run reaches, because a damaged file has them.
void ForeignArchive::check_clock(const std::vector<double>& times) const {
    constexpr std::int64_t most_steps = 9'000'000'000'000'000;  // whole numbers that a double holds
    for (std::size_t k = 0; k < raw_steps_.size(); ++k)
        if (raw_steps_[k] <= -most_steps || raw_steps_[k] >= most_steps)
            throw UserError(fmt::format("{}: has the step {}, which no run reaches; is the file damaged?",
                                        grains_->place(k), raw_steps_[k]));
    for (std::size_t k = 0; k < times.size(); ++k)
        if (!(std::abs(times[k]) <= kLongestTime))
            throw UserError(
                fmt::format("{}: has the time {:.6g} s, which no run reaches; is the file damaged?",
                            grains_->place(k), times[k]));
}

const RawFrame& ForeignArchive::raw(std::size_t index) const {
    auto& slot = last_[derived_ ? index % last_.size() : 0];
    if (!slot || slot->first != index) {
        slot.reset();  // so that two frames need not fit into memory
        slot.emplace(index, grains_->read(index));
    }
    return slot->second;
}

// The frames in which types are looked for; of many frames only some.
std::vector<std::size_t> ForeignArchive::looks() const {
    constexpr std::uintmax_t small = 32 << 20;  // bytes; so many are read in a moment
    constexpr std::size_t most = 64;
    std::uintmax_t bytes = 0;
    std::error_code ignored;
    for (const fs::path& file : grains_->files()) bytes += fs::file_size(file, ignored);
    const std::size_t frames = moments_.size();
    const bool all = bytes <= small || looks_ == Looks::first;
    const std::size_t stride = all ? 1 : std::max<std::size_t>(1, (frames + most - 1) / most);
    std::vector<std::size_t> looks;
    for (std::size_t k = 0; k < frames; k += stride) looks.push_back(k);
    if (frames > 0 && looks.back() != frames - 1) looks.push_back(frames - 1);
    return looks;
}

// Takes types and number of grains from a frame, and from the first with grains what its columns mean.
// Returns whether it has grains.
bool ForeignArchive::look_at(std::size_t index) {
    const RawFrame& frame = raw(index);
    world_.most_grains = std::max(world_.most_grains, frame.grains.rows);
    if (frame.grains.rows == 0) return false;
    if (!meaning_) {
        meaning_.emplace(grains_->facts(), frame, options_, grains_->files().front().string());
        first_with_grains_ = index;
    }
    meaning_->add_types(frame, types_);
    if (meaning_->least_id(frame) == 0) world_.first_id = 0;
    return true;
}

// Finds out which types there are, how many grains, and what the columns mean.
void ForeignArchive::survey() {
    const std::size_t frames = moments_.size();
    world_.first_id = 1;  // until a grain has the id 0
    for (const std::size_t k : looks())
        if (look_at(k) && looks_ == Looks::first) break;
    count_grains();
    for (const auto& [word, name] : options_.species) types_.add(word);
    if (!meaning_) {
        // No frame has a grain, so the columns get the meaning of an empty table.
        RawFrame empty;
        empty.grains.columns = {{"id", {}}, {"x", {}}, {"y", {}}, {"z", {}}, {"radius", {}}};
        meaning_.emplace(grains_->facts(), empty, ReadingOptions(), path_.string());
        const bool contacts = std::any_of(grains_->moments().begin(), grains_->moments().end(),
                                          [](const RawMoment& one) { return one.has_contacts; });
        news_.push_back(contacts
                            ? fmt::format("{}: has contacts and no grains; open the file of the grains, and "
                                          "name this one by --contacts",
                                          path_.string())
                            : fmt::format("{}: has no grain in any frame", path_.string()));
    }
    for (const std::string& line : meaning_->guesses()) news_.push_back(line);
    if (!meaning_->has_ids() && frames > 1)
        news_.push_back(fmt::format("{}: has no ids; its grains are counted by their rows", path_.string()));
    survey_contacts();
    if (has_contacts_) check_contact_columns();
}

void ForeignArchive::count_grains() {
    for (const RawMoment& moment : grains_->moments()) {
        world_.most_grains = std::max(world_.most_grains, static_cast<std::size_t>(moment.grains));
        world_.traffic = world_.traffic || moment.grains != grains_->moments().front().grains;
    }
}

void ForeignArchive::survey_contacts() {
    contacts_at_.clear();
    const std::size_t frames = moments_.size();
    for (std::size_t k = 0; k < frames && !has_contacts_; ++k)
        has_contacts_ = grains_->moments()[k].has_contacts;
    if (!contacts_) return;
    const std::vector<RawMoment>& moments = contacts_->moments();
    for (std::size_t k = 0; k < moments.size(); ++k) {
        std::optional<std::int64_t> step = moments[k].step;
        if (!step && moments[k].time) {
            // If grains and contacts have only times and no steps, they are matched by time.
            for (std::size_t f = 0; f < frames; ++f)
                if (grains_->moments()[f].time && std::abs(*grains_->moments()[f].time - *moments[k].time) <=
                                                      1e-6 * std::abs(*moments[k].time) + 1e-12)
                    step = raw_steps_[f];
        }
        if (step) contacts_at_.emplace(*step, k);
    }
    const auto matched =
        static_cast<std::size_t>(std::count_if(raw_steps_.begin(), raw_steps_.end(), [&](std::int64_t step) {
            return contacts_at_.contains(step);
        }));
    has_contacts_ = matched > 0;
    const std::string name = contacts_->files().front().string();
    if (matched == 0)
        news_.push_back(
            fmt::format("{}: its contacts are left out: none of its moments is one of the grains", name));
    else if (matched < frames)
        news_.push_back(fmt::format("{}: has contacts of {} of the {} frames; the others are shown without",
                                    name, matched, frames));
}

// Columns of a dump local may have any names. If they do not tell which grains touch, contacts are left out.
void ForeignArchive::check_contact_columns() {
    const RawSeries& from = contacts_ ? *contacts_ : *grains_;
    for (std::size_t k = 0; k < from.moments().size(); ++k) {
        if (!from.moments()[k].has_contacts) continue;
        const RawTable contacts = from.read(k).contacts;
        if (contacts.rows == 0) continue;
        const std::string name = from.files().front().string();
        has_contacts_ =
            column_for("id1", contacts, options_, name) && column_for("id2", contacts, options_, name);
        if (!has_contacts_)
            news_.push_back(fmt::format(
                "{}: its contacts are left out: no columns say who touches whom; name them as in --columns "
                "id1=c_1[1],id2=c_1[2],force=c_2[1]; it has {}",
                name, names_in(contacts)));
        return;
    }
}

void ForeignArchive::make_world() {
    world_.title = path_.filename().string();
    world_.program_version = grains_->facts().program;
    make_species();
    add_box();
}

// Makes the bodies of the world, which have different names.
void ForeignArchive::name_walls() {
    world_.bodies = {{"container", {}, {}}, {"floor", {}, {}}};
    std::set<std::string> names;
    for (MovingWall& wall : walls_) {
        std::string name = wall.name.empty() ? "wall" : wall.name;
        for (int k = 2; names.count(name) > 0; ++k)
            name = fmt::format("{} {}", wall.name.empty() ? "wall" : wall.name, k);
        names.insert(name);
        wall.name = name;
        world_.bodies.push_back({name, {}, wall.shape});
    }
}

// The species of the types, with sizes, densities and box of the first frame that has grains.
void ForeignArchive::make_species() {
    world_.species.clear();
    for (const std::string& word : types_.words()) {
        WorldSpecies& species = world_.species.emplace_back();
        const auto named = options_.species.find(word);
        const bool number = word.find_first_not_of("0123456789.+-e") == std::string::npos;
        species.name = named != options_.species.end() ? named->second : number ? "type " + word : word;
    }
    if (world_.species.empty()) world_.species.emplace_back().name = "grains";
    std::size_t first = 0;
    while (first + 1 < moments_.size() && grains_->moments()[first].grains == 0) ++first;
    if (!moments_.empty() && types_.words().size() > 0) {
        const RawFrame& frame = raw(first);
        const std::vector<double> densities = meaning_->densities(frame, types_);
        Gaps ignored;
        const State grains = meaning_->frame(frame, types_, grains_->place(first), ignored);
        std::vector<double> sums(types_.words().size(), 0);
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const auto species = static_cast<std::size_t>(grains.species[i]);
            sums[species] += 2 * grains.radius[i];
            ++world_.species[species].count;
        }
        for (std::size_t s = 0; s < sums.size(); ++s) {
            if (world_.species[s].count > 0)
                world_.species[s].diameter = sums[s] / static_cast<double>(world_.species[s].count);
            world_.species[s].density = densities[s];
        }
        world_.cell = meaning_->cell(frame);
    }
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
        return all;
    };
    if (!contacts_) return read(raw(index), grains_->place(index));
    const std::size_t found = contacts_at_.at(raw_steps_.at(index));
    return read(contacts_->read(found), contacts_->place(found));
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
            throw UserError(
                fmt::format("--time-step {:g}: with it, grain {} moves at {:.3g} m/s; give a longer one",
                            *options_.time_step, before.id[i], moved / interval));
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
