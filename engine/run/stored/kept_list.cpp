#include "engine/run/stored/kept_list.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/run_names.hpp"
#include "engine/state/body.hpp"

namespace grainreel {

namespace {

std::size_t first_from(const std::vector<State>& moments, std::int64_t step) {
    const auto place =
        std::lower_bound(moments.begin(), moments.end(), step,
                         [](const State& moment, std::int64_t wanted) { return moment.step < wanted; });
    return static_cast<std::size_t>(place - moments.begin());
}

std::unique_ptr<StateArchive> open_moments(const std::filesystem::path& file) {
    return open_frames(file, {.format = "trajectory"});
}

}  // namespace

KeptList::KeptList(const StateArchive& trajectory, const Scene& scene, const Clock& clock, bool with_keys)
    : trajectory_(trajectory), scene_(scene), clock_(clock), moments_(trajectory.moments()) {
    for (std::size_t k = 0; k < moments_.size(); ++k) places_.push_back({k, {}, {}});
    read_film();
    if (with_keys) read_keys();
}

void KeptList::read_film() {
    const std::filesystem::path film = file(kFilmMoments);
    if (!is_there(film)) return;
    try {
        film_ = open_moments(film);
        check(*film_, film.string());
        merge(*film_, &Place::film);
        for (std::string& line : film_->damage()) film_faults_.push_back({std::move(line), false});
    } catch (const UserError& problem) {
        film_.reset();
        film_faults_.push_back({problem.what(), true});
    }
}

void KeptList::read_keys() {
    const std::filesystem::path keys = file(kKeyMoments), contacts = file(kKeyContacts);
    if (!is_there(keys)) return;
    try {
        if (key_contacts_.emplace(contacts).cut_off())
            key_faults_.push_back({fmt::format("{}: was cut off", contacts.string()), false});
        keys_ = open_moments(keys);
        check(*keys_, keys.string());
        merge(*keys_, &Place::key);
        for (std::string& line : keys_->damage()) key_faults_.push_back({std::move(line), false});
    } catch (const UserError& problem) {
        keys_.reset();
        key_faults_.push_back({problem.what(), true});
    }
}

// Throws UserError where the file is of another run.
void KeptList::check(const StateArchive& file, const std::string& name) const {
    check_species(scene_, file.world(), name);
    for (std::size_t k = 0; k < file.moments().size(); ++k) {
        State moment = file.moments()[k];
        add_planes(scene_.walls, moment.time, moment.bodies);
        check_drive(scene_, clock_, moment, fmt::format("{}: frame {}", name, file.place(k)));
    }
    try {
        if (!file.moments().empty()) check_grains(scene_, file.world(), file.grains(0), name);
    } catch (const DamagedFrame&) {
        // The reader of this frame reports the damage.
    }
    check_grains_at_common_step(file, name);
}

void KeptList::check_grains_at_common_step(const StateArchive& file, const std::string& name) const {
    const std::vector<State>& kept = trajectory_.moments();
    for (std::size_t k = 0; k < file.moments().size(); ++k) {
        const std::int64_t step = file.moments()[k].step;
        const std::size_t both = first_from(kept, step);
        if (both == kept.size() || kept[both].step != step) continue;
        try {
            if (same_grains(trajectory_.grains(both), file.grains(k))) return;
        } catch (const DamagedFrame&) {
            continue;  // the reader of this frame reports the damage
        }
        throw UserError(
            "{}: has other grains at step {} than the trajectory.nc beside it; they are of two "
            "runs",
            name, step);
    }
}

void KeptList::merge(const StateArchive& file, std::optional<std::size_t> Place::*in_file) {
    std::vector<State> moments;
    std::vector<Place> places;
    std::size_t next = 0;  // index among the moments that are in the list already
    const auto take_until = [&](std::int64_t step) {
        for (; next < moments_.size() && moments_[next].step <= step; ++next) {
            moments.push_back(std::move(moments_[next]));
            places.push_back(places_[next]);
        }
    };
    for (std::size_t k = 0; k < file.moments().size(); ++k) {
        State moment = file.moments()[k];
        take_until(moment.step);
        if (moments.empty() || moments.back().step < moment.step) {
            add_planes(scene_.walls, moment.time, moment.bodies);
            moments.push_back(std::move(moment));
            places.emplace_back();
        }
        if (moments.back().step == file.moments()[k].step) places.back().*in_file = k;
    }
    take_until(std::numeric_limits<std::int64_t>::max());
    moments_ = std::move(moments);
    places_ = std::move(places);
}

std::optional<std::size_t> KeptList::find(std::int64_t step) const {
    const std::size_t index = first_from(moments_, step);
    if (index == moments_.size() || moments_[index].step != step) return std::nullopt;
    return index;
}

std::int64_t KeptList::nearest_step(std::int64_t step, bool of_trajectory) const {
    std::int64_t nearest = trajectory_.moments()[trajectory_.nearest(clock_.time(step))].step;
    if (of_trajectory) return nearest;
    const auto try_one = [&](std::size_t index) {
        const std::int64_t one = moments_[index].step;
        if (std::abs(one - step) < std::abs(nearest - step)) nearest = one;
    };
    const std::size_t after = first_from(moments_, step);
    if (after < moments_.size()) try_one(after);
    if (after > 0) try_one(after - 1);
    return nearest;
}

State KeptList::grains(std::size_t index) const {
    const Place& place = places_.at(index);
    std::optional<DamagedFrame> damage;
    const std::pair<const StateArchive*, std::optional<std::size_t>> files[] = {
        {&trajectory_, place.trajectory}, {film_.get(), place.film}, {keys_.get(), place.key}};
    for (const auto& [file, number] : files) {
        if (!number) continue;
        try {
            State frame = file->grains(*number);
            if (file != &trajectory_) add_planes(scene_.walls, frame.time, frame.bodies);
            return frame;
        } catch (const DamagedFrame& problem) {
            if (!damage) damage = problem;
        }
    }
    throw *damage;
}

bool KeptList::has_contacts_of(std::size_t index) const {
    const Place& place = places_.at(index);
    return (place.key && key_contacts_->has_all(*place.key)) ||
           (place.trajectory && trajectory_.has_contacts_of(*place.trajectory));
}

std::optional<std::vector<Link>> KeptList::touches(std::size_t index) const {
    const Place& place = places_.at(index);
    if (place.key && key_contacts_->has_all(*place.key)) return key_contacts_->touches(*place.key);
    return place.trajectory ? trajectory_.touches(*place.trajectory) : std::nullopt;
}

bool same_grains(const State& kept, const State& other) {
    constexpr double same_place = 1e-4;  // as a share of a grain's radius
    bool same = kept.id == other.id;
    for (std::size_t i = 0; same && i < kept.size(); ++i)
        same = (kept.position[i] - other.position[i]).norm() <= same_place * other.radius[i];
    return same;
}

}  // namespace grainreel
