// A box with grains that a test puts there, and the answers of observers about it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/measure/columns.hpp"
#include "engine/measure/observers.hpp"

namespace grainreel::test {

// There is a row every 125 steps, and a period has 1000 steps.
struct BedByHand {
    Scene scene;
    Plan plan;
    Grains grains;
    Traffic traffic;
    DrivePose pose;
    double period = 0;  // m, of x
    Vec3 gravity{0, 0, -10};
    std::optional<WallSums> walls;
    std::vector<std::int64_t> given;  // number of grains that each feed has given
    std::function<void(const std::function<void(const ContactView&)>&)> contacts = [](const auto&) {};

    explicit BedByHand(const std::string& instrument = "") {
        scene.container.shape = Container::Shape::box;
        scene.container.half_width = 20;
        scene.container.depth = 4;
        scene.container.height = 30;
        scene.species.resize(2);
        scene.species[0].name = "small";
        scene.species[0].diameter.mean = 1;
        scene.species[0].count = 1;
        scene.species[1].name = "big";
        scene.species[1].diameter.mean = 3;
        scene.output.instruments = {instrument};
        plan.clock = {1e-3, 1000, 0};
        plan.measures_every = 125;
    }
    void add(std::int32_t species, const Vec3& place, double radius, double density = 1) {
        grains.add(static_cast<std::int32_t>(grains.size()), species, place, radius, density);
    }
    // Adds stacks of grains of diameter 1, whose topmost grains end at top(y).
    void fill(const std::function<double(double y)>& top) {
        grains = {};
        for (int j = 0; j < 40; ++j)
            for (int i = 0; i < 4; ++i)
                for (double z = top(j - 19.5) - 0.5; z > 0; z -= 1) add(0, {i - 1.5, j - 19.5, z}, 0.5);
    }
    ObservedState moment(std::int64_t step) const {
        return {scene,
                plan.clock,
                grains,
                step,
                gravity,
                period,
                pose,
                0,
                traffic,
                {},
                walls ? &*walls : nullptr,
                nullptr,
                nullptr,
                given};
    }
    void start() { observers().start(moment(0), contacts); }
    void gather(std::int64_t step) { observers().gather(moment(step), contacts); }
    double look(std::int64_t step, const std::string& column) {
        return observers().look(moment(step), contacts, column);
    }

  private:
    // The observers are made when they are first asked for, from what the test has set until then.
    Observers& observers() {
        if (!observers_) observers_ = std::make_unique<Observers>(all_observers(), scene, plan);
        return *observers_;
    }
    std::unique_ptr<Observers> observers_;
};

}  // namespace grainreel::test
