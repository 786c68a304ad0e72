#include "render/page/bed/all_moments.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/same_run.hpp"
#include "engine/files/run_names.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/run/resume/kept_files.hpp"
#include "engine/state/body.hpp"
#include "engine/state/container_faces.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

std::unique_ptr<FrameArchive> open_moments(const fs::path& file) {
    return open_frames(file, {.format = "trajectory"});
}

}  // namespace

AllMoments::AllMoments(const RunArchive& run, bool with_contacts)
    : run_(run), with_contacts_(with_contacts), moments_(run.moments()) {
    for (std::size_t k = 0; k < moments_.size(); ++k) places_.push_back({k, {}, {}});
    const fs::path film = run.folder() / kFilmMoments, keys = run.folder() / kKeyMoments;
    try {
        if (is_there(film)) merge(*(film_ = open_moments(film)), &Place::film, film.string());
    } catch (const UserError& problem) {
        film_.reset();
        news_.push_back(fmt::format("{}; its moments are not on the page", problem.what()));
    }
    try {
        if (!is_there(keys)) return;
        const fs::path contacts = run.folder() / kKeyContacts;
        if (key_contacts_.emplace(contacts).cut_off())
            news_.push_back(
                fmt::format("{}: was cut off; the forces of the last key moments are not on the page",
                            contacts.string()));
        merge(*(keys_ = open_moments(keys)), &Place::key, keys.string());
    } catch (const UserError& problem) {
        keys_.reset();
        news_.push_back(fmt::format("{}; the forces of key moments are not on the page", problem.what()));
    }
}

// Merges all moments of a file into the list, or none of them.
void AllMoments::merge(const FrameArchive& file, std::optional<std::size_t> Place::*of,
                       const std::string& name) {
    std::vector<Frame> moments;
    std::vector<Place> places;
    std::size_t next = 0;  // index among the moments that are there already
    const auto take_until = [&](std::int64_t step) {
        for (; next < moments_.size() && moments_[next].step <= step; ++next) {
            moments.push_back(moments_[next]);
            places.push_back(places_[next]);
        }
    };
    const Scene& scene = *run_.scene();
    const std::vector<std::string> damage = file.damage();
    if (!file.moments().empty() && file.place(0) == 0)
        check_grains(scene, file.world(), file.grains(0), name);
    if (!damage.empty()) throw UserError(damage.front());
    for (std::size_t index = 0; index < file.moments().size(); ++index) {
        Frame moment = file.moments()[index];
        take_until(moment.step);
        if (moments.empty() || moments.back().step < moment.step) {
            add_planes(scene.walls, moment.time, moment.bodies);
            check_drive(scene, run_.clock(), moment, name);
            moments.push_back(std::move(moment));
            places.emplace_back();
        }
        if (moments.back().step == moment.step) places.back().*of = index;
    }
    take_until(std::numeric_limits<std::int64_t>::max());
    moments_ = std::move(moments);
    places_ = std::move(places);
}

Frame AllMoments::grains(std::size_t index) const {
    const Place& place = places_.at(index);
    if (place.trajectory) return run_.grains(*place.trajectory);
    Frame frame = place.film ? film_->grains(*place.film) : keys_->grains(*place.key);
    add_planes(run_.scene()->walls, frame.time, frame.bodies);
    return frame;
}

bool AllMoments::has_touches(std::size_t index) const {
    const Place& place = places_.at(index);
    return (place.key && key_contacts_->has_all(*place.key)) || (place.trajectory && with_contacts_);
}

std::optional<std::vector<Touch>> AllMoments::touches(std::size_t index) const {
    const Place& place = places_.at(index);
    if (place.key && key_contacts_->has_all(*place.key)) return key_contacts_->touches(*place.key);
    if (place.trajectory && with_contacts_) return run_.touches(*place.trajectory);
    return std::nullopt;
}

FilmColours::FilmColours(const FilmedScene& scene, const FrameArchive& run, const Clock& clock, double start)
    : run_(run),
      clock_(clock),
      by_(scene.film.shows.colour.by),
      depth_(period_of_depth(scene.container)),
      frequency_(scene.drive.present ? scene.drive.highest_frequency() : 0),
      scale_(scene.film.shows.colour),
      quantities_(scene, by_) {
    if (by_ == GrainValue::start_height) quantities_.start_from(run.grains(run.nearest(start)));
}

// Adds the displacement since the moment run_.periods() periods of the drive earlier. Returns false when the
// run kept no such moment.
bool FilmColours::add_displacement(std::size_t index, Shot& frame) const {
    const Frame& now = run_.moments()[index];
    if (frequency_ <= 0 || clock_.step <= 0) return false;
    const int periods = run_.periods();
    const double time = clock_.time(clock_.step_at(clock_.cycles(now.step) - periods));
    const std::size_t before = run_.nearest(time);
    constexpr double some_periods = 1e-3, some_steps = 1.01;
    if (std::abs(run_.moments()[before].time - time) >
        std::max(some_periods / frequency_, some_steps * clock_.step))
        return false;
    frame.displacement = displacement_since(run_.grains(before), frame, periods, depth_);
    return true;
}

std::uint8_t FilmColours::byte_of(double value) const {
    if (std::isnan(value)) return 0;
    double share = std::clamp(scale_.share_of(value), 0.0, 1.0);
    if (const int bands = scale_.bands(); bands > 0)
        share = (std::min(std::floor(share * bands), bands - 1.0) + 0.5) / bands;
    return static_cast<std::uint8_t>(1 + std::lround(254 * share));
}

std::vector<std::uint8_t> FilmColours::of(std::size_t index, Shot& frame,
                                          const std::optional<std::vector<Touch>>& touches) {
    std::vector<std::uint8_t> bytes(frame.size(), 0);
    const bool of_period = by_ == GrainValue::displacement || by_ == GrainValue::rise;
    if (of_period && !add_displacement(index, frame)) return bytes;
    if (wants_touches()) {
        if (by_ == GrainValue::coordination && !frame.contact_number.empty()) {
            for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = byte_of(frame.contact_number[i]);
            return bytes;
        }
        if (!touches) return bytes;
        frame.touches = *touches;
    }
    if (frame.spin.size() != frame.size()) frame.spin.assign(frame.size(), Vec3::Constant(std::nan("")));
    const std::vector<double>& values = quantities_.of(frame);
    std::transform(values.begin(), values.end(), bytes.begin(), [&](double value) { return byte_of(value); });
    return bytes;
}

}  // namespace grainreel
