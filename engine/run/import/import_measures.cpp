#include "engine/run/import/import_measures.hpp"

#include <algorithm>
#include <cmath>

#include "engine/measure/bed/bed_observers.hpp"
#include "engine/measure/drive_observers.hpp"
#include "engine/measure/observers.hpp"
#include "engine/measure/segregation/segregation_observers.hpp"
#include "engine/plan/plan.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/wall_motion.hpp"

namespace grainreel {

namespace {

// Those that work on a state that was put together by hand. Energies are left out: stiffness and mass of
// another program's contacts are not known.
std::vector<ObserverEntry> entries(const FrameSupply& supply) {
    std::vector<ObserverEntry> all{
        entry_of<observers::Times>(),         entry_of<observers::CentreOfMass>(),
        entry_of<observers::SpeciesPlaces>(), entry_of<observers::HeightDifference>(),
        entry_of<observers::BigAboveSmall>(), entry_of<observers::BigInQuarters>(),
        entry_of<observers::Mixing>()};
    if (supply.contacts) {
        all.push_back(entry_of<observers::ContactNumber>());
        all.push_back(entry_of<observers::ContactFabric>());
    }
    all.push_back(entry_of<observers::FloorPosition>());
    return all;
}

Grains grains_of(const Frame& frame, const Scene& scene) {
    Grains grains;
    grains.reserve(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto species = static_cast<std::size_t>(frame.species[i]);
        grains.add(frame.id[i], frame.species[i], frame.position[i], frame.radius[i],
                   scene.species[species].density);
        grains.motion[i].velocity = frame.velocity[i];
        grains.motion[i].spin = frame.spin[i];
    }
    return grains;
}

std::int32_t row_of(const Frame& frame, std::int32_t id) {
    const auto found = std::lower_bound(frame.id.begin(), frame.id.end(), id);
    if (found == frame.id.end() || *found != id) return -1;
    return static_cast<std::int32_t>(found - frame.id.begin());
}

void show(const Frame& frame, const std::vector<Touch>& touches,
          const std::function<void(const ContactView&)>& see) {
    for (const Touch& touch : touches) {
        ContactView view{};
        view.first = row_of(frame, touch.first);
        view.second = touch.second < 0 ? touch.second : row_of(frame, touch.second);
        if (view.first < 0 || (touch.second >= 0 && view.second < 0)) continue;
        const auto first = static_cast<std::size_t>(view.first);
        view.glued = view.triangle = -1;
        view.normal_force = touch.force;
        view.smaller_radius = frame.radius[first];
        view.normal = Vec3(0, 0, -1);
        view.tangential = view.torque_on_first = view.torque_on_second = Vec3(0, 0, 0);
        view.point = frame.position[first];
        if (touch.second >= 0) {
            const auto second = static_cast<std::size_t>(view.second);
            const Vec3 between = frame.position[second] - frame.position[first];
            const double distance = between.norm();
            if (!(distance > 0)) continue;
            view.normal = between / distance;
            view.overlap = frame.radius[first] + frame.radius[second] - distance;
            view.smaller_radius = std::min(frame.radius[first], frame.radius[second]);
            view.point += view.normal * frame.radius[first];
        }
        see(view);
    }
}

// The plan of a start from a file asks for that file, and there is none.
Scene as_layers(Scene scene) {
    if (scene.start.method == Start::Method::file) scene.start = Start();
    return scene;
}

}  // namespace

struct ImportMeasures::Impl {
    Impl(const Scene& scene_in, const Clock& clock_in, const FrameSupply& supply)
        : scene(scene_in),
          clock(clock_in),
          plan(make_plan(as_layers(scene))),
          observers(entries(supply), scene, plan),
          faces(faces_of(scene)) {}

    const Scene scene;
    const Clock clock;
    const Plan plan;
    Observers observers;
    const std::vector<Face> faces;
    const Traffic traffic{};
};

ImportMeasures::ImportMeasures(const Scene& scene, const Clock& clock, const FrameSupply& supply)
    : impl_(std::make_unique<Impl>(scene, clock, supply)) {}

ImportMeasures::~ImportMeasures() = default;

const std::vector<std::string>& ImportMeasures::names() const {
    return impl_->observers.names();
}

Measures ImportMeasures::row(const Frame& frame, const std::vector<Touch>& touches) {
    const Impl& m = *impl_;
    const Grains grains = grains_of(frame, m.scene);
    const double depth = m.scene.container.periodic_depth ? m.scene.container.depth : 0;
    const Moment moment{m.scene,
                        m.clock,
                        grains,
                        frame.step,
                        m.scene.gravity,
                        depth,
                        WallMotion(m.scene.drive, m.clock).at(frame.step),
                        0,
                        m.traffic,
                        m.faces};
    return impl_->observers.look(moment, [&](const auto& see) { show(frame, touches, see); });
}

}  // namespace grainreel
