#include "engine/measure/bed/bed_formulas.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/measure/measures.hpp"
#include "engine/measure/segregation/segregation.hpp"
#include "engine/measure/surface/surface.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

double solid_fraction(const Container& container, const Grains& grains, double floor, double top) {
    const double height = std::min(top - floor, container.height);
    if (container.shape == Container::Shape::none || !(height > container.base())) return kUnknown;
    double solid = 0;
    for (const Place& p : grains.place) {
        const double r = p.radius, cap = std::clamp(floor + height - (p.position.z() - r), 0.0, 2 * r);
        solid += std::numbers::pi * cap * cap * (3 * r - cap) / 3;
    }
    return solid / container.volume_below(height);
}

double Fabric::anisotropy() const {
    if (contacts_ == 0) return kUnknown;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.compute(tensor(), Eigen::EigenvaluesOnly);
    const Vec3 rising = solver.eigenvalues();
    return rising[2] - rising[0];
}

std::optional<std::size_t> find_intruder(const Scene& scene, const Grains& grains) {
    if (scene.species.size() < 2) return std::nullopt;
    const auto big = static_cast<std::int32_t>(big_and_small(scene.species).big);
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        if (grains.species[i] != big) continue;
        if (found) return std::nullopt;
        found = i;
    }
    return found;
}

double intruder_height(const Scene& scene, const Grains& grains, std::size_t intruder, double floor) {
    const double period = period_of_depth(scene.container);
    const Place& own = grains.place[intruder];
    double diameters = 0;
    for (const Place& p : grains.place) diameters += 2 * p.radius;
    const double mean = (diameters - 2 * own.radius) / static_cast<double>(grains.size() - 1);
    const double reach = own.radius + 2 * mean;
    std::vector<Place> around;  // places relative to the intruder's in x and y
    for (std::size_t i = 0; i < grains.size(); ++i) {
        Place p = grains.place[i];
        p.position.x() = nearest_image(p.position.x() - own.position.x(), period);
        p.position.y() -= own.position.y();
        const bool near = std::abs(p.position.x()) < reach && std::abs(p.position.y()) < reach;
        if (i != intruder && near) around.push_back(p);
    }
    if (around.empty()) return kUnknown;
    const BedOutline surface = surface_of(around, {-reach, reach, -reach, reach, 0, mean});
    return (own.position.z() + own.radius - floor) / (surface.mean() - floor);
}

void Flight::add(std::int64_t from, double carried) {
    if (!state_.flying && carried < kLeaves) {
        state_.flying = true;
        state_.since = from;
    } else if (state_.flying && carried > kLands) {
        state_.flying = false;
        if (from - state_.since < least_) return;
        state_.last = {state_.since, from};
        state_.any = true;
    }
}

void PeriodMultiple::add(std::int64_t number, double height) {
    if (number != next_) heights_.clear();
    if (heights_.empty() && number % kPhases != 0)
        return;  // heights are stored from the first whole period on
    next_ = number + 1;
    heights_.push_back(height);
    if (next_ % kPhases == 0) end_period();
}

void PeriodMultiple::end_period() {
    constexpr std::size_t wanted = kPhases * (kWindow + kMost);
    while (heights_.size() > wanted) heights_.pop_front();
    if (heights_.size() < wanted) return;
    difference_ = difference_to(1);
    const int now = multiple_now();
    confirmed_ = now == other_ ? confirmed_ + 1 : 1;
    other_ = now;
    if (confirmed_ >= (value_ == 1 ? kConfirm : kChange)) value_ = now;
}

double PeriodMultiple::difference_to(int periods_before) const {
    double sum = 0;
    for (std::size_t i = kPhases * kMost; i < heights_.size(); ++i)
        sum += math::square(heights_[i] - heights_[i - static_cast<std::size_t>(periods_before * kPhases)]);
    return std::sqrt(sum / (kPhases * kWindow));
}

// Finds the number of periods after which the bed repeats itself. A multiple counts if its difference is at
// most half of the difference of the multiple found before it, which is one period at first. A drift grows
// with the number of periods and noise stays as it is, so neither makes a multiple. A larger multiple is
// looked for only while the difference is more than a quarter of that of one period.
int PeriodMultiple::multiple_now() const {
    int multiple = 1;
    double left = difference_;
    const double settled = std::max(least_, 0.25 * difference_);
    for (int periods = 2; periods <= kMost && left > settled; ++periods) {
        const double difference = difference_to(periods);
        if (difference > 0.5 * left) continue;
        multiple = periods;
        left = difference;
    }
    return multiple;
}

void PeriodMultiple::save(std::ostream& out) const {
    const Writing each{out};
    each(std::vector<double>(heights_.begin(), heights_.end()));
    each(next_), each(value_), each(other_), each(confirmed_), each(difference_);
}

void PeriodMultiple::load(Bytes& in) {
    const Reading each{in};
    std::vector<double> heights;
    each(heights), each(next_), each(value_), each(other_), each(confirmed_), each(difference_);
    heights_.assign(heights.begin(), heights.end());
    const auto is_multiple = [](int periods) { return periods >= 1 && periods <= kMost; };
    if (heights_.size() >= kPhases * (kWindow + kMost + 1) || next_ < -1 || !is_multiple(value_) ||
        !is_multiple(other_) || confirmed_ < 0)
        in.fail();
}

}  // namespace grainreel
