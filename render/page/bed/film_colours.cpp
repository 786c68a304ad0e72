#include "render/page/bed/film_colours.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/lists.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

FilmColours::FilmColours(const FilmedScene& scene, const StateArchive& run, const Clock& clock, double start)
    : run_(run),
      clock_(clock),
      by_(scene.film.shows.colour.by),
      depth_(period_of_depth(scene.container)),
      frequency_(scene.drive.present ? scene.drive.highest_frequency() : 0),
      scale_(scene.film.shows.colour),
      species_(scene.film.shows.colour.species),
      quantities_(scene, by_) {
    if (by_ == GrainValue::start_height) quantities_.start_from(run.grains(run.nearest(start)));
}

// Adds the displacement since the moment run_.periods() periods of the drive earlier. Returns false when the
// run kept no such moment.
bool FilmColours::add_displacement(std::size_t index, Shot& frame) const {
    const State& now = run_.moments()[index];
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
                                          const std::optional<std::vector<Link>>& touches) {
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
    for (std::size_t i = 0; i < bytes.size() && !species_.empty(); ++i)
        if (!contains(species_, frame.species[i])) bytes[i] = 0;
    return bytes;
}

}  // namespace grainreel
