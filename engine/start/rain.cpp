#include "engine/start/rain.hpp"

#include <algorithm>
#include <functional>
#include <numbers>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/measure/health.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/plan/plan_bed.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/start/fallen.hpp"

namespace grainreel {

namespace {

constexpr double kPoured = 0.5;  // solid share of a bed while grains still fall on it

// The grains to come, in a random order of species.
class Cloud {
  public:
    explicit Cloud(const Scene& scene)
        : scene_(scene),
          order_(scene.run.seed, Stream::rain_species),
          diameters_(scene.run.seed, Stream::diameters) {
        for (const Species& species : scene.species)
            left_.push_back(species.count), all_left_ += species.count;
    }

    // Returns the next grain; its place is still to be found.
    ComingGrain next() {
        auto drawn = static_cast<std::int64_t>(order_.uniform() * static_cast<double>(all_left_--));
        std::size_t s = 0;
        while (drawn >= left_[s]) drawn -= left_[s++];
        --left_[s];
        ComingGrain grain;
        grain.species = static_cast<std::int32_t>(s);
        grain.radius = 0.5 * draw_diameter(scene_.species[s].diameter, diameters_);
        grain.density = scene_.species[s].density;
        return grain;
    }

  private:
    const Scene& scene_;
    Random order_, diameters_;
    std::vector<std::int64_t> left_;
    std::int64_t all_left_ = 0;
};

// The box in which grains appear once so much solid volume (m3) has come.
class RisingLayer {
  public:
    explicit RisingLayer(const Scene& scene)
        : space_(scene),
          layer_(rain_layer(scene)),
          fits_box_(scene.meshes.empty() && !scene.start.region),
          box_(fits_box_ ? extent_of(scene) : Extent{space_.low(), space_.high()}),
          lowest_(fits_box_ ? 0 : box_.low.z()) {}

    // A condition on places, needed where the box is larger than the room: a grain outside the room is wrong
    // even if it touches nothing.
    std::function<bool(const Vec3&)> where() const {
        if (fits_box_) return {};
        return [this](const Vec3& place) { return space_.holds(place, 0); };
    }

    Extent at(double solid) const {
        const double share = std::min(1.0, solid / kPoured / space_.volume());
        const double bed = space_.height_of_share(share);
        Extent box = box_;
        box.high.z() = std::min(box_.high.z(), bed + layer_.high);
        box.low.z() = std::max(lowest_, box.high.z() - (layer_.high - layer_.low));
        return box;
    }

  private:
    const FreeSpace space_;
    const RainLayer layer_;
    const bool fits_box_;  // the room lies between faces: a place in the box that touches none of them is in
                           // the room
    const Extent box_;
    const double lowest_;  // m
};

// Finds places for the grains, in the order of the cloud.
class Shower {
  public:
    Shower(const Scene& scene, const Surroundings& around)
        : scene_(scene),
          around_(around),
          cloud_(scene),
          layer_(scene),
          places_(scene.run.seed, Stream::rain_places),
          largest_(0.5 * largest_diameter(scene)),
          next_(cloud_.next()) {}

    // The grains that come now: until `due` have come, or until the next one finds no place.
    std::vector<ComingGrain> fall(const Grains& there, double due) {
        const Extent box = layer_.at(solid_);
        FreePlaces free(around_, around_.motion.at(-1), there, box.low, box.high, largest_);
        free.only_where(layer_.where());
        std::vector<ComingGrain> more;
        while (static_cast<double>(come_ + 1) <= due) {
            const auto place = free.take(next_.radius, places_);
            if (!place) break;
            next_.position = *place;
            more.push_back(next_);
            solid_ += 4.0 / 3 * std::numbers::pi * math::cube(next_.radius);
            if (++come_ < scene_.grains_at_start()) next_ = cloud_.next();
        }
        return more;
    }

    std::int64_t come() const { return come_; }

  private:
    const Scene& scene_;
    const Surroundings& around_;
    Cloud cloud_;
    const RisingLayer layer_;
    Random places_;
    const double largest_;  // m, radius
    ComingGrain next_;
    double solid_ = 0;  // m3 of grains that have come
    std::int64_t come_ = 0;
};

}  // namespace

RainReport rain(const Scene& scene, const Plan& plan, const Surroundings& around, Grains& grains,
                StepLoop& loop, const std::function<bool(double, std::int64_t)>& watcher) {
    if (scene.grains_at_start() == 0) return {};
    const HealthLimits limits = health_limits(scene, plan);
    const auto all = static_cast<double>(scene.grains_at_start());
    const double rate = rain_rate(scene), step = plan.clock.step;
    // Rain ends before settling begins, or with it: walls stand still until step 0.
    const std::int64_t first = -plan.settle_steps_limit - plan.rain_steps_limit;
    Shower shower(scene, around);
    const FallenGrains fallen(scene, around);
    RainReport report;
    std::int64_t last = 0;  // step in which the last grain came
    while (true) {
        const double looked = step * static_cast<double>(report.steps + kStepsPerLook);
        const std::vector<ComingGrain> more = shower.fall(grains, std::min(all, rate * looked));
        if (!more.empty()) last = report.steps;
        loop.insert(more);
        if (shower.come() == scene.grains_at_start()) return report;
        const double waited = step * static_cast<double>(report.steps - last);
        if (waited > rain_patience(scene) + 1 / rate || report.steps + kStepsPerLook > plan.rain_steps_limit)
            throw RunError(
                "{}: {} grains of {} have come as rain, and the next finds no room above them; use fewer "
                "or smaller grains, a higher container, or method = \"layers\"",
                scene.where("start.method"), shower.come(), all);
        loop.run(first + report.steps, kStepsPerLook, step, 0);
        report.steps += kStepsPerLook;
        fallen.stop(grains);
        check_state(limits, around, grains, loop, first + report.steps);
        if (!watcher(static_cast<double>(shower.come()) / all, report.steps)) {
            report.finished = false;
            return report;
        }
    }
}

namespace {

constexpr int kDraws = 200;
constexpr double kGap = 1e-3;  // as a share of the radius

}  // namespace

FreePlaces::FreePlaces(const Surroundings& around, const DrivePose& pose, const Grains& grains,
                       const Vec3& low, const Vec3& high, double largest)
    : around_(around), pose_(pose), low_(low), high_(high) {
    const auto take = [&](const Place& place) {
        const double reach = place.radius + largest * (1 + kGap);
        const Vec3& centre = place.position;
        const bool outside = centre.y() < low.y() - reach || centre.y() > high.y() + reach ||
                             centre.z() < low.z() - reach || centre.z() > high.z() + reach;
        if (!outside) near_.push_back(place);
    };
    for (const Place& place : grains.place) take(place);
    for (std::size_t g = 0; g < around.glued.size(); ++g)
        take({around.glued.centre(g, around.faces, pose), around.glued.place[g].radius});
    for (const MeshWall& mesh : around.meshes) meshes_.push_back(mesh.body.at(pose));
}

bool FreePlaces::is_free(const Vec3& place, double radius) const {
    const double wide = radius * (1 + kGap);
    for (const Face& face : around_.faces)
        if (distance_at(face, pose_, place).distance < wide) return false;
    for (std::size_t m = 0; m < meshes_.size(); ++m)
        if (around_.meshes[m].surface->any_within(meshes_[m].at_rest(place), wide)) return false;
    if (holds_ && !holds_(place)) return false;
    return std::none_of(near_.begin(), near_.end(), [&](const Place& other) {
        Vec3 between = place - other.position;
        between.x() = wrapped(between.x(), around_.period);
        return between.squaredNorm() < (other.radius + wide) * (other.radius + wide);
    });
}

std::optional<Vec3> FreePlaces::take(double radius, Random& random) {
    for (int draw = 0; draw < kDraws; ++draw) {
        Vec3 place;
        for (int axis = 0; axis < 3; ++axis) place[axis] = random.between(low_[axis], high_[axis]);
        if (!is_free(place, radius)) continue;
        near_.push_back({place, radius});
        return place;
    }
    return std::nullopt;
}

}  // namespace grainreel
